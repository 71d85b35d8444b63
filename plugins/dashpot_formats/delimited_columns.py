"""The columns of a text table, made of its rows block by block."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from dashpot.contract.reader import ReadingError
from dashpot_formats.delimited_numbers import numbers_and_texts, plain_numbers
from dashpot_formats.delimited_rows import LongRow, Rows, find_long_row
from dashpot_formats.time_stamps import is_stamp, seconds


class _Column:
    """The numbers of a column. It is read plainly until a block of texts cannot be; then all of it is read closely."""

    def __init__(self, size: int, decimal: str) -> None:
        self.values = np.full(size, np.nan)
        self._decimal = decimal
        # the rows before are read plainly
        self.plain_until = size

    def read(self, start: int, texts: Sequence[str]) -> None:
        """Take in the texts of the rows from ``start`` on; blocks come in order."""
        found = plain_numbers(texts, self._decimal) if start < self.plain_until else None
        if found is not None:
            self.values[start : start + found.size] = found
            return
        self.plain_until = min(start, self.plain_until)
        self.read_closely(start, texts)

    def read_closely(self, start: int, texts: Sequence[str]) -> None:
        """Take in texts of which not all are plain numbers."""
        found = numbers_and_texts(texts, self._decimal)
        if self.values.dtype != object and any(isinstance(value, str) for value in found):
            self.values = self.values.astype(object)
        self.values[start : start + len(found)] = found


def read_columns(rows: Rows, width: int) -> tuple[list[np.ndarray], set[int]]:
    """The columns of a table of this width, and which of them are times of day, now in seconds.

    Each has numbers (n,), or is an object array of numbers and of the texts that are none. Raises ReadingError for a
    row of numbers that is longer.
    """
    found = _read_stamps(rows, width)
    columns = {index: _Column(rows.size, rows.layout.decimal) for index in range(width) if index not in found}
    long = []
    for start, cells in rows.blocks(width):
        long += find_long_row(cells, start, width, rows.layout.decimal)
        for index, column in columns.items():
            column.read(start, cells[index])
    _refuse_long_row(long, rows, width)
    _read_again(rows, columns, width)
    stamps = set(found)
    found |= {index: column.values for index, column in columns.items()}
    return [found[index] for index in range(width)], stamps


def _read_stamps(rows: Rows, width: int) -> dict[int, np.ndarray]:
    """The columns of times of day, in seconds."""
    first = next(rows.blocks(width))[1]
    found = {index: seconds(_texts(rows, index, width)) for index in range(width) if is_stamp(first[index][0])}
    return {index: values for index, values in found.items() if values is not None}


def _texts(rows: Rows, index: int, width: int) -> Iterator[str]:
    for _, cells in rows.blocks(width):
        yield from cells[index]


def _read_again(rows: Rows, columns: dict[int, _Column], width: int) -> None:
    """Read closely what was read plainly in columns that are not plain throughout: some words mean less there."""
    left = {index: column for index, column in columns.items() if 0 < column.plain_until < rows.size}
    for start, cells in rows.blocks(width) if left else ():
        for index, column in left.items():
            if start < column.plain_until:
                column.read_closely(start, cells[index])


def _refuse_long_row(found: Sequence[LongRow], rows: Rows, width: int) -> None:
    if found:
        first = min(found)
        message = f"expected {width} values, got {first.values}"
        line = int(rows.numbers[first.row]) + 1
        raise ReadingError(message, "correct the line; or name 'delimiter' and 'decimal'", line)
