"""The least of a quadratic model within limits of every number.

Where the model is told in every direction, the numbers at their limits are found by block principal pivoting
(Portugal, Judice and Vicente 1994): all numbers on the wrong side change sides at once, and where that does not make
them fewer, one at a time, the last one first, which comes to an end for any such model (Murty 1974). There the
conditions of a minimum hold, and it has one minimum only. Anything else is left to a library.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

NOT_FELT = 1e-12  # of the largest eigenvalue
BLOCKS = 3  # of numbers changing sides that may not make the wrong ones fewer, as of Kim and Park (2011)
ROUNDS = 10  # for each number, after which rounding is taken to keep them from ending


def least_within(matrix: Array, right: Array, low: Array, high: Array) -> Array:
    """The least of s.matrix.s/2 - right.s within its limits, and of several such steps nearly the shortest."""
    values = np.linalg.eigvalsh(matrix)
    least = NOT_FELT * values.max(initial=0.0)
    if least == 0.0:
        return np.zeros(right.size)
    found = _by_pivots(matrix, right, low, high) if np.all(values > least) else None
    return _along_what_is_felt(matrix, right, low, high) if found is None else found


def _by_pivots(matrix: Array, right: Array, low: Array, high: Array) -> Array | None:
    """The least of s.matrix.s/2 - right.s within its limits; None where rounding keeps it from being found."""
    side = np.zeros(right.size, dtype=np.int64)  # -1 at the lower limit, 1 at the upper one, 0 between them
    fewest, blocks = right.size + 1, BLOCKS
    for _ in range(ROUNDS * right.size):
        step = _least_held(matrix, right, np.where(side < 0, low, np.where(side > 0, high, 0.0)), side == 0)
        outside = (step > high).astype(np.int64) - (step < low)
        kept = np.where(side * (matrix @ step - right) <= 0.0, side, 0)
        wanted = np.where(side == 0, outside, kept)
        wrong = np.flatnonzero(wanted != side)
        if not wrong.size:
            return step
        fewer = wrong.size < fewest
        fewest, blocks = (wrong.size, BLOCKS) if fewer else (fewest, blocks - 1)
        changed = wrong if blocks >= 0 else wrong[-1:]
        side[changed] = wanted[changed]
    return None


def _least_held(matrix: Array, right: Array, held: Array, free: NDArray[np.bool_]) -> Array:
    """The least of s.matrix.s/2 - right.s with all numbers ``held`` that are not ``free``."""
    step = held.copy()
    pull = right[free] - matrix[np.ix_(free, ~free)] @ held[~free]
    step[free] = np.linalg.solve(matrix[np.ix_(free, free)], pull)
    return step


def _along_what_is_felt(matrix: Array, right: Array, low: Array, high: Array) -> Array:
    """The same without the directions in which the model tells nothing."""
    values, vectors = np.linalg.eigh(matrix)
    least = NOT_FELT * values.max(initial=0.0)
    roots = np.sqrt(np.maximum(values, least))
    aim = np.where(values > least, vectors.T @ right / roots, 0.0)
    unlimited: Array = vectors @ (aim / roots)
    if np.all((unlimited >= low) & (unlimited <= high)):
        return unlimited
    return _by_library(roots[:, None] * vectors.T, aim, low, high)


def _by_library(rows: Array, aim: Array, low: Array, high: Array) -> Array:
    """The least of |rows.s - aim|^2 within its limits, some of which it comes to."""
    from scipy.optimize import lsq_linear

    wide = np.maximum(high, np.nextafter(low, np.inf))
    found = lsq_linear(rows, aim, (low, wide), "bvls", max_iter=10 * low.size)
    return np.clip(found.x, low, high)
