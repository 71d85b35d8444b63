"""Which values of a condition are one level: those that a rig would not tell apart."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.compare.strokes import Seen
from dashpot.fit.alike import SAME_MOTION
from dashpot.text.quantity import base_unit

Array = NDArray[np.float64]

ORDER = "order of tests"
ROUNDING = 1e-9


def scatter_of(name: str, values: Array, seen: Sequence[Seen]) -> float:
    """By how much values of a condition may differ that are one level: what a rig repeats, of the largest one.

    A preload scatters by so much of the stroke. A temperature has no size, and the order of the tests is counted.
    """
    units = {each.run.units.get(name) for each in seen}
    if name == ORDER or any(unit and base_unit(unit) == "K^1" for unit in units):
        return ROUNDING * float(np.abs(values).max())
    stroke = 2.0 * max(each.amplitude for each in seen)
    return SAME_MOTION * (stroke if name == "preload" else float(np.abs(values).max()))


def levelled(name: str, values: Array, seen: Sequence[Seen]) -> Array:
    """The values (n,) of a condition, those of one level as their middle one; a level begins at its lowest value."""
    known, place = np.unique(values, return_inverse=True)
    scatter, begin, levels = scatter_of(name, values, seen), 0, known.copy()
    for end in range(1, known.size + 1):
        if end == known.size or known[end] - known[begin] > scatter:
            levels[begin:end] = known[(begin + end - 1) // 2]
            begin = end
    return np.asarray(levels[place])
