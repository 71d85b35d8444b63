"""Arrays saved by numpy: several in a .npz, one in a .npy."""

from __future__ import annotations

import math
import warnings
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import IO

import numpy as np

from dashpot.contract.reader import Reader, ReadingError, Table
from dashpot_formats.flatten import choose_variable, columns_of, numbered_columns
from dashpot_formats.option import check_options, get_option

_LARGEST = 1024**3  # bytes, as numbers of eight bytes, which they become
_NUMBER = 8


class Npz(Reader):
    """Reads arrays of numbers; pickled objects are refused.

    The columns of a .npz are its arrays: vectors by name, matrices as `name(1)`, `name(2)`, ...; those of a .npy, or of
    the array chosen by `variable`, are 1, 2, ...; `transpose` where the rows are the channels.
    """

    word = "npz"
    suffixes = (".npz", ".npy")
    options = {
        "variable": "the one array that is read",
        "transpose": "true where its rows are the channels",
    }

    def read(self, path: Path, options: Mapping[str, object]) -> Table:
        check_options(options, self.options)
        name = get_option(options, "variable", str, None)
        transpose = get_option(options, "transpose", bool, False)
        content = _load(path)
        if isinstance(content, np.ndarray):
            return Table(numbered_columns(content, transpose))
        if name is not None:
            return Table(numbered_columns(choose_variable(content, name), transpose))
        columns = columns_of(content)
        if not columns:
            raise ReadingError("it holds no vector or matrix of numbers", "check that this is the right file")
        return Table(columns)


def _load(path: Path) -> np.ndarray | dict[str, np.ndarray]:
    try:
        _refuse_bomb(path)
        with warnings.catch_warnings(action="ignore"):
            content = np.load(path, allow_pickle=False)
            if isinstance(content, np.ndarray):
                return content
            with content:
                return dict(content)
    except ReadingError:
        raise
    except Exception as error:
        # a damaged archive makes zipfile, zlib and numpy raise whatever they stumble over
        told = " ".join(str(error).split()) or type(error).__name__
        message = f"it is not a sound file of numpy arrays: {told[:200]}"
        raise ReadingError(message, "save plain arrays of numbers") from error


def _refuse_bomb(path: Path) -> None:
    """Refuse, by the heads of the arrays, what would take too much memory: before any of it is taken."""
    if zipfile.is_zipfile(path):
        with zipfile.ZipFile(path) as archive:
            size = sum(_unpacked(archive, entry) for entry in archive.infolist())
    else:
        with path.open("rb") as stream:
            size = _size(stream)
    if size > _LARGEST:
        raise ReadingError(f"unpacked it would take {size / 1024**3:.1f} GiB", "save it in smaller pieces")


def _unpacked(archive: zipfile.ZipFile, entry: zipfile.ZipInfo) -> int:
    if not entry.filename.endswith(".npy"):
        return entry.file_size
    with archive.open(entry) as stream:
        return max(entry.file_size, _size(stream))


def _size(stream: IO[bytes]) -> int:
    read = {(1, 0): np.lib.format.read_array_header_1_0, (2, 0): np.lib.format.read_array_header_2_0}
    version = np.lib.format.read_magic(stream)
    if version not in read:
        raise ReadingError("its arrays have names of fields, expected plain numbers", "save plain arrays of numbers")
    shape, _, kind = read[version](stream)
    return math.prod(shape) * max(kind.itemsize, _NUMBER)
