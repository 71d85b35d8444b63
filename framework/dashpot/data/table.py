"""What a reader of measurement files hands over: columns of numbers, as they stand in the file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

import numpy as np

from dashpot.text.problem import nearest


class ReadingError(Exception):
    """A measurement file cannot be read: what was expected and got, what to do, and the line if there is one.

    What the message quotes from the file is made printable.

    Examples:
        >>> raise dp.ReadingError("expected 3 numbers", "cut the line off", 7)
        Traceback (most recent call last):
        dashpot.data.table.ReadingError: ...
    """

    def __init__(self, message: str, hint: str = "", line: int | None = None):
        self.message = "".join(sign if sign.isprintable() else "?" for sign in message)
        super().__init__(self.message)
        self.hint = hint
        self.line = line


@dataclass(frozen=True, eq=False)
class Table:
    """The columns of a file, in their order: column 1 is the first.

    columns:  name -> (n,) numbers. A column with texts in it is an object array that holds numbers and those texts.
    units:    name -> the unit that the file itself states, where it does.
    sampling: Hz, when the file states it.
    lines:    (n,) line in the file of every row, when the file has lines.

    Examples:
        >>> table = dp.Table({"t": np.arange(3.0), "F": np.ones(3)}, units={"F": "kN"})
        >>> table.find(2)
        'F'
    """

    columns: Mapping[str, np.ndarray]
    units: Mapping[str, str] = field(default_factory=dict)
    sampling: float | None = None
    lines: np.ndarray | None = None

    def find(self, column: str | int) -> str:
        """The name of a column given by its name or its 1-based number. ReadingError when there is none."""
        names = list(self.columns)
        if isinstance(column, int):
            if not 1 <= column <= len(names):
                raise ReadingError(f"it has {len(names)} columns, there is no column {column}", "columns count from 1")
            return names[column - 1]
        if column in self.columns:
            return column
        shown = ", ".join(f"'{name}'" for name in names[:12]) + (", ..." if len(names) > 12 else "")
        raise ReadingError(f"it has no column '{column}'", nearest(column, names) or f"its columns are {shown}")

    def where(self, row: int) -> str:
        """A row (from 0) in words: its line in the file, or its number counted from 1."""
        return f"row {row + 1}" if self.lines is None else f"line {self.lines[row]} (row {row + 1})"


class FileReader(Protocol):
    """What is asked of a reader here; plugins derive theirs from `dashpot.contract.reader.Reader`."""

    @property
    def suffixes(self) -> tuple[str, ...]:
        """Endings of file names that it reads unasked."""

    def read(self, path: Path, options: Mapping[str, object]) -> Table:
        """The columns of a file. Raises ReadingError."""

    def parts(self, path: Path) -> Sequence[Mapping[str, object]]:
        """The options with which each of the measurements in a file is read. Raises ReadingError."""
