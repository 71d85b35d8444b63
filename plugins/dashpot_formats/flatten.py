"""Named arrays as columns: vectors by their name, matrices column by column."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from dashpot.contract.reader import ReadingError
from dashpot.text.problem import nearest

# a matrix with more columns than this is taken for something else, a picture say, unless it is asked for
_WIDEST = 256


def columns_of(variables: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Columns from variables: a vector (n,), (n, 1) or (1, n) under its name, a matrix (n, k) as `name(1)`, ...

    Single values, texts and arrays of higher dimension are left out.
    """
    columns: dict[str, np.ndarray] = {}
    for name, values in variables.items():
        if not _is_numeric(values) or values.size < 2 or values.ndim > 2:
            continue
        if values.ndim == 1 or 1 in values.shape:
            columns[name] = values.ravel().astype(float)
        elif values.shape[1] <= _WIDEST:
            columns.update({f"{name}({index + 1})": values[:, index].astype(float) for index in range(values.shape[1])})
    return columns


def choose_variable(variables: Mapping[str, np.ndarray], name: str) -> np.ndarray:
    """The array of this name. Raises ReadingError when there is none."""
    if name not in variables or not _is_numeric(variables[name]):
        known = [key for key, values in variables.items() if _is_numeric(values)]
        hint = nearest(name, known) or f"there are: {', '.join(known[:12]) or 'none'}"
        raise ReadingError(f"it has no variable '{name}' of numbers", hint)
    return variables[name]


def numbered_columns(matrix: np.ndarray, transpose: bool) -> dict[str, np.ndarray]:
    """The columns of a matrix (samples, k) as `1` to `k`; a vector of either shape is one column.

    Raises ReadingError when it is no matrix, or clearly lies on its side.
    """
    if matrix.ndim > 2 or matrix.ndim == 0:
        raise ReadingError(f"expected a matrix, got an array of shape {matrix.shape}", "name another variable")
    if matrix.ndim == 1 or 1 in matrix.shape:
        return {"1": matrix.ravel().astype(float)}
    matrix = matrix.T if transpose else matrix
    if matrix.shape[1] > _WIDEST and matrix.shape[1] > matrix.shape[0]:
        message = f"it has {matrix.shape[0]} rows and {matrix.shape[1]} columns, expected a row for each sample"
        raise ReadingError(message, "write 'transpose: true' under file_options")
    return {str(index + 1): matrix[:, index].astype(float) for index in range(matrix.shape[1])}


def _is_numeric(values: object) -> bool:
    return isinstance(values, np.ndarray) and values.dtype.kind in "iuf"
