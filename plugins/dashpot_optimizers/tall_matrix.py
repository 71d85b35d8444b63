"""The least-squares content of a matrix with very many rows in a small triangle."""

from __future__ import annotations

import numpy as np

SLICE = 8192


def triangle_of(values: np.ndarray, steps: np.ndarray) -> np.ndarray:
    """R (m, 1 + n) of the QR factors of [residuals, Jacobian] (samples, 1 + n), m = min(samples, 1 + n).

    values: (1 + n, samples), the residuals at a point and at its n neighbours, `steps` (n,) away. Any Gauss-Newton
    step from R is that from the whole matrix, because the missing factor is orthonormal. Slices of samples are
    folded into the triangle one after the other: no copy of the whole is made and nothing is squared.
    """
    triangle = np.zeros((0, len(values)))
    for first in range(0, values.shape[1], SLICE):
        triangle = _fold(triangle, values[:, first : first + SLICE], steps)
    return triangle


def _fold(triangle: np.ndarray, values: np.ndarray, steps: np.ndarray) -> np.ndarray:
    rows = len(triangle)
    columns = np.empty((len(values), rows + values.shape[1]))
    columns[:, :rows] = triangle.T
    columns[0, rows:] = values[0]
    np.subtract(values[1:], values[0], out=columns[1:, rows:])
    columns[1:, rows:] /= steps[:, None]
    return np.linalg.qr(columns.T, mode="r")  # type: ignore[return-value]  # the stubs know only one mode
