"""Readers of measurement files: what a plugin provides for one file format."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import ClassVar

from dashpot.data.table import ReadingError, Table

__all__ = ["Reader", "ReadingError", "Table"]


class Reader(ABC):
    """Reads the files of one format into columns. It never changes a file, and never unpickles.

    `word` names the format in a dataset (`reader: csv`); `suffixes` are the file names it reads unasked (`.csv`).
    `options` are the keys that may stand under `file_options`, each with its meaning; `extra` is what to install for a
    format that needs a library of its own: `dashpot[mdf]`.

    Examples:
        >>> class Pairs(dp.Reader):
        ...     '''Two columns with a blank between them.'''
        ...     word, suffixes = "pairs", (".pairs",)
        ...     def read(self, path, options):
        ...         return dp.Table(dict(zip("xF", np.loadtxt(path).T)))
        >>> Pairs.suffixes
        ('.pairs',)
    """

    word: ClassVar[str]
    suffixes: ClassVar[tuple[str, ...]]
    options: ClassVar[Mapping[str, str]] = {}
    extra: ClassVar[str] = ""

    @abstractmethod
    def read(self, path: Path, options: Mapping[str, object]) -> Table:
        """The columns of a file; `options` is what stands under `file_options` in the dataset.

        Raises ReadingError, with a line where there is one, when the file or an option is not as it should be.
        """

    def parts(self, path: Path) -> Sequence[Mapping[str, object]]:
        """The options with which each of the measurements in a file is read: one run each in `dashpot import`.

        A format with one measurement in a file need not say anything. Raises ReadingError as `read` does.
        """
        return [{}]
