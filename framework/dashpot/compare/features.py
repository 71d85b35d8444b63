"""Functions of what is remembered of a motion, and of the conditions of a run: the columns of a general model."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations_with_replacement

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from dashpot.compare.motion import Memory

Array = NDArray[np.float64]

DEGREE = 6
KNOTS = np.linspace(-0.85, 0.85, 10)  # of the deflection, in half ranges
SPEEDS = np.array([-2.0, -1.0, -0.5, -0.2, 0.2, 0.5, 1.0, 2.0])  # knots of the velocity
POWERS = (0.25, 0.5, 1.5, 2.0, 3.0)
EVEN_POWERS = (0.5, 1.0, 2.0)
CONSTANT = 100.0  # so large that the penalty on its coefficient does not count


@dataclass(frozen=True, eq=False)
class Columns:
    """``values`` (n, p), and how many columns each of the ``families`` has, from the plainest to the richest."""

    values: Array
    families: tuple[int, ...]


def columns_of(memory: Memory, conditions: Array) -> Columns:
    """The columns at n samples; ``conditions`` (n, k) are standardised settings and measured channels.

    Families: rates and relaxing travel; stop operators; ringing; curves over deflection; powers of velocity; products;
    and the plain ones times the conditions.
    """
    parts = [_linear(memory), memory.stops, memory.ringing, _elastic(memory), _viscous(memory), _products(memory)]
    if conditions.shape[1]:
        parts.append(_conditional(memory, conditions))
    return Columns(np.hstack(parts), tuple(part.shape[1] for part in parts))


def _linear(memory: Memory) -> Array:
    ones = np.full(memory.deflection.size, CONSTANT)
    return np.column_stack([ones, memory.deflection, memory.velocity, memory.acceleration, memory.relaxing])


def _elastic(memory: Memory) -> Array:
    x = np.clip(memory.deflection, -1.2, 1.2)
    return np.hstack([legendre.legvander(x, DEGREE)[:, 2:], np.maximum(x[:, None] - KNOTS, 0.0)])


def _viscous(memory: Memory) -> Array:
    v = memory.velocity
    odd = [np.sign(v) * np.abs(v) ** power for power in POWERS]
    even = [np.abs(v) ** power for power in EVEN_POWERS]
    valves = np.maximum(np.sign(SPEEDS) * (v[:, None] - SPEEDS), 0.0)
    return np.column_stack([*odd, *even, valves, memory.lagging])


def _core(memory: Memory) -> list[Array]:
    v = memory.velocity
    few = (memory.stops[:, 3::4], memory.relaxing[:, 2::4])
    return [memory.deflection, v, np.sign(v) * np.sqrt(np.abs(v)), *np.hstack(few).T]


def _products(memory: Memory) -> Array:
    core = _core(memory)
    pairs = [one * other for one, other in combinations_with_replacement(core, 2)]
    x, wide = np.clip(memory.deflection, -1.2, 1.2)[:, None], memory.stops
    loaded = [x * wide, x**2 * wide, memory.velocity[:, None] * wide, x**2 * memory.velocity[:, None]]
    loaded += [x * np.abs(memory.velocity)[:, None] * memory.velocity[:, None], x * memory.relaxing]
    worn = [memory.wear * each[:, None] for each in core]
    return np.column_stack([*pairs, *loaded, memory.wear, *worn, _beyond(memory)])


def _beyond(memory: Memory) -> Array:
    """Hinges of the deflection times velocity: damping that comes and goes with the place."""
    return np.maximum(memory.deflection[:, None] - KNOTS[1::2], 0.0) * memory.velocity[:, None]


def _conditional(memory: Memory, conditions: Array) -> Array:
    x, v = np.clip(memory.deflection, -1.2, 1.2), memory.velocity
    powers = [np.sign(v) * np.abs(v) ** power for power in (0.5, 2.0)]
    own = np.column_stack([np.ones(x.size), x, x**2, x**3, v, *powers, memory.stops, memory.relaxing[:, 1::2]])
    grades = [grade for condition in conditions.T for grade in (condition, condition**2)]
    return np.hstack([own * grade[:, None] for grade in grades])
