"""MATLAB files: version 4 to 7 with scipy, 7.3 (which is HDF5) with h5py; both in a process of their own."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from dashpot.contract.reader import Reader, ReadingError, Table
from dashpot_formats.apart import read_apart
from dashpot_formats.extra import require
from dashpot_formats.flatten import choose_variable, columns_of, numbered_columns
from dashpot_formats.option import check_options, get_option

_HDF5 = b"\x89HDF\r\n\x1a\n"
_DEEPEST = 8


class Mat(Reader):
    """Reads vectors and matrices of numbers; fields of structs are `struct.field`.

    Without options all variables are offered: vectors by name, matrices as `name(1)`, `name(2)`, ... With `variable`
    the columns are those of that matrix, 1, 2, ...; `transpose` where its rows are the channels.
    """

    word = "mat"
    suffixes = (".mat",)
    options = {
        "variable": "the one matrix that is read",
        "transpose": "true where its rows are the channels",
    }

    def read(self, path: Path, options: Mapping[str, object]) -> Table:
        check_options(options, self.options)
        variables = _read_variables(path)
        name = get_option(options, "variable", str, None)
        if name is not None:
            matrix = choose_variable(variables, name)
            return Table(numbered_columns(matrix, get_option(options, "transpose", bool, False)))
        columns = columns_of(variables)
        if not columns:
            raise ReadingError("it holds no vector or matrix of numbers", "check that this is the right file")
        return Table(columns)


def _read_variables(path: Path) -> Mapping[str, np.ndarray]:
    if not _is_hdf5(path):
        return read_apart(read_version_5, path, "MATLAB file").arrays
    require("h5py", "matlab73", "MATLAB 7.3 files")
    return read_apart(read_hdf5, path, "MATLAB 7.3 file").arrays


def _is_hdf5(path: Path) -> bool:
    """MATLAB puts 512 bytes of its own before the HDF5 signature."""
    with path.open("rb") as stream:
        head = stream.read(520)
    return head.startswith(_HDF5) or head[512:] == _HDF5


def read_version_5(path: str) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """The arrays of numbers in a file of version 4 to 7, fields of structs as `struct.field`."""
    from scipy.io import loadmat

    content = loadmat(path, simplify_cells=True)
    return _flat({key: value for key, value in content.items() if not key.startswith("__")}), {}


def _flat(content: Mapping[str, Any], above: str = "", depth: int = 0) -> dict[str, np.ndarray]:
    variables: dict[str, np.ndarray] = {}
    for key, value in content.items():
        if isinstance(value, np.ndarray) and value.dtype.kind in "iuf":
            variables[above + key] = value
        elif isinstance(value, dict) and depth < _DEEPEST:
            variables.update(_flat(value, f"{above}{key}.", depth + 1))
    return variables


def read_hdf5(path: str) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """The arrays of numbers in a file of version 7.3, those in groups as `group.name`.

    Raises ReadingError for numbers that the file takes from other files: links are not followed either.
    """
    import h5py

    variables: dict[str, np.ndarray] = {}

    def keep(name: str, item: Any) -> None:
        # MATLAB counts the first index fastest, HDF5 the last
        if isinstance(item, h5py.Dataset) and item.dtype.kind in "iuf" and not name.startswith("#"):
            if item.external or item.is_virtual:
                raise ReadingError(f"'{name}' lies in other files", "save it with its numbers inside")
            if item.attrs.get("MATLAB_class", b"double") not in (b"char", b"cell", b"logical"):
                variables[name.replace("/", ".")] = item[()].T

    with h5py.File(path, "r") as file:
        file.visititems(keep)
    return variables, {}
