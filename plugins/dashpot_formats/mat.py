"""MATLAB files: version 5 to 7 with scipy, 7.3 (which is HDF5) with h5py."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from dashpot.contract.reader import Reader, ReadingError, Table
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

    def read(self, path: Path, options: Mapping[str, object]) -> Table:
        check_options(options, ("variable", "transpose"))
        variables = _read_hdf5(path) if _is_hdf5(path) else _read_version_5(path)
        name = get_option(options, "variable", str, None)
        if name is not None:
            matrix = choose_variable(variables, name)
            return Table(numbered_columns(matrix, get_option(options, "transpose", bool, False)))
        columns = columns_of(variables)
        if not columns:
            raise ReadingError("it holds no vector or matrix of numbers", "check that this is the right file")
        return Table(columns)


def _is_hdf5(path: Path) -> bool:
    """MATLAB puts 512 bytes of its own before the HDF5 signature."""
    with path.open("rb") as stream:
        head = stream.read(520)
    return head.startswith(_HDF5) or head[512:] == _HDF5


def _read_version_5(path: Path) -> dict[str, np.ndarray]:
    from scipy.io import loadmat

    try:
        content = loadmat(path, simplify_cells=True)
    except Exception as error:
        # a damaged file makes scipy raise whatever its parser stumbles over, from OSError to zlib.error
        raise ReadingError(f"it is not a sound MATLAB file: {error}", "save it again with 'save -v7'") from error
    return _flat({key: value for key, value in content.items() if not key.startswith("__")})


def _flat(content: Mapping[str, Any], above: str = "", depth: int = 0) -> dict[str, np.ndarray]:
    variables: dict[str, np.ndarray] = {}
    for key, value in content.items():
        if isinstance(value, np.ndarray):
            variables[above + key] = value
        elif isinstance(value, dict) and depth < _DEEPEST:
            variables.update(_flat(value, f"{above}{key}.", depth + 1))
    return variables


def _read_hdf5(path: Path) -> dict[str, np.ndarray]:
    try:
        import h5py
    except ImportError:
        raise ReadingError(
            "MATLAB 7.3 files need the package h5py", "pip install 'dashpot[matlab73]', or save it with 'save -v7'"
        ) from None
    variables: dict[str, np.ndarray] = {}

    def keep(name: str, item: Any) -> None:
        # MATLAB counts the first index fastest, HDF5 the last
        if isinstance(item, h5py.Dataset) and item.dtype.kind in "iuf" and not name.startswith("#"):
            if item.attrs.get("MATLAB_class", b"double") not in (b"char", b"cell", b"logical"):
                variables[name.replace("/", ".")] = item[()].T

    try:
        with h5py.File(path, "r") as file:
            file.visititems(keep)
    except OSError as error:
        raise ReadingError(f"it is not a sound MATLAB 7.3 file: {error}", "save it again") from None
    return variables
