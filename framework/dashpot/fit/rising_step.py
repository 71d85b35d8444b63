"""The best step of a quadratic model where knots of a law must not fall below those before them.

The step without that condition, brought back to the nearest one that keeps it, is not the best one that keeps it: what
the other numbers do beside the knots is right for the knots that were taken back. A fit with such knots then creeps.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
# matrix (p, p), right side (p,), limits (p,) below and above -> the least of s.matrix.s/2 - right.s within the limits
Solve = Callable[[Array, Array, Array, Array], Array]

FALLS = 1e-9  # of the largest distance of knots


def rising_step(
    solve: Solve,
    matrix: Array,
    right: Array,
    limits: tuple[Array, Array],
    place: tuple[Array, Array],
    rising: Sequence[Sequence[int]],
) -> Array:
    """The least (p,) of s.matrix.s/2 - right.s within its limits with every group of ``rising`` knots in order.

    ``place`` are where the numbers are, and how far a step of 1 moves each. It is that of ``solve`` wherever this keeps
    the order. Otherwise distances between neighbouring knots take the place of the knots, so that the order is a limit
    as others are; of the limits of the knots themselves only that of one end of each group is seen to.
    """
    low, high = limits
    step = solve(matrix, right, low, high)
    at, size = place
    falling = [knots for knots in rising if _falls((at + step * size)[list(knots)])]
    if not falling:
        return step
    change, low, high = np.diag(1.0 / size), low * size, high * size
    for knots in falling:
        change, low, high = _by_distances(change, low, high, at, list(knots), size)
    inner = change.T @ matrix @ change
    scale = np.sqrt(np.maximum(np.diag(inner), np.finfo(float).tiny))
    found = solve(inner / np.outer(scale, scale), change.T @ right / scale, low * scale, high * scale)
    return np.asarray(change @ (found / scale))


def _falls(knots: Array) -> bool:
    return bool(np.any(np.diff(knots) < -FALLS * np.ptp(knots)))


def _by_distances(
    change: Array, low: Array, high: Array, at: Array, knots: list[int], size: Array
) -> tuple[Array, Array, Array]:
    """With the distances of some knots in place of all but the end that is nearest to its limit."""
    change, low, high = change.copy(), low.copy(), high.copy()
    upwards = -low[knots[0]] < high[knots[-1]]
    chain = knots if upwards else knots[::-1]
    gaps = np.abs(np.diff(at[chain]))
    for number, inner in enumerate(chain[1:]):
        # a distance that grows moves all knots behind it, away from the end that stays a number
        change[:, inner] = 0.0
        behind = chain[number + 1 :]
        change[behind, inner] = (1.0 if upwards else -1.0) / size[behind]
        low[inner], high[inner] = -gaps[number], np.inf
    first = chain[0]
    change[:, first] = 0.0
    change[chain, first] = 1.0 / size[chain]
    return change, low, high
