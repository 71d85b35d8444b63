"""Fading memory of a cubic path: the integral that every relaxing element needs.

Between two samples the displacement is the cubic through both positions and both velocities, so its velocity is
v(u) = v0 (1 - u) + v1 u + 6 u (1 - u) q with u = time/step and q = travel/step - (v0 + v1)/2.
"""

from __future__ import annotations

from math import factorial
from typing import Any

import numpy as np

from dashpot.model.element import Motion

SERIES_BELOW = 0.5
LAST = tuple((-1.0) ** j / (factorial(j) * (j + 3)) for j in range(14))


def fading_travel(x: Motion, dt: Any, time: Any) -> Any:
    """The travel of a step as it is remembered at its end, in m.

    integral of exp(-(dt - s)/time) v(s) ds over the step, exact for the cubic path and for every ratio dt/time.
    ``dt`` and ``time`` in s.
    """
    none, one, two = _moments(dt / time)
    bow = x.travel / dt - 0.5 * (x.velocity_old + x.velocity_new)
    return x.velocity_old * (dt * one) + x.velocity_new * (dt * (none - one)) + bow * (6.0 * dt * (one - two))


def _moments(z: Any) -> tuple[Any, Any, Any]:
    """integral of w^order exp(-z w) over w = 0..1, for the orders 0, 1 and 2.

    By the recurrence order M(order - 1) = z M(order) + exp(-z): upwards where z is large, downwards from the series of
    the last one where z is small.
    """
    near, far = np.minimum(z, SERIES_BELOW), np.maximum(z, SERIES_BELOW)
    left, gone = np.exp(-near), np.exp(-far)
    two = _series(near)
    one = 0.5 * (near * two + left)
    low = near * one + left, one, two
    none = (1.0 - gone) / far
    one = (none - gone) / far
    high = none, one, (2.0 * one - gone) / far
    few, more, most = (np.where(z < SERIES_BELOW, *pair) for pair in zip(low, high, strict=True))
    return few, more, most


def _series(z: Any) -> Any:
    """The moment of order 2: the sum of (-z)^j / (j! (j + 3))."""
    total: Any = LAST[-1]
    for factor in reversed(LAST[:-1]):
        total = factor + z * total
    return total
