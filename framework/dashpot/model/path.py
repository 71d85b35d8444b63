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
TERMS = 14


def fading_travel(x: Motion, dt: Any, time: Any) -> Any:
    """The travel of a step as it is remembered at its end, in m.

    integral of exp(-(dt - s)/time) v(s) ds over the step, exact for the cubic path and for every ratio dt/time.
    ``dt`` and ``time`` in s.
    """
    z = dt / time
    none, one, two = (_moment(order, z) for order in range(3))
    bow = x.travel / dt - 0.5 * (x.velocity_old + x.velocity_new)
    return x.velocity_old * (dt * one) + x.velocity_new * (dt * (none - one)) + bow * (6.0 * dt * (one - two))


def _moment(order: int, z: Any) -> Any:
    """integral of w^order exp(-z w) over w = 0..1, by recurrence where z is large, by its series where z is small."""
    series = sum((-z) ** j / (factorial(j) * (j + order + 1)) for j in range(1, TERMS)) + 1.0 / (order + 1)
    far = np.maximum(z, SERIES_BELOW)
    closed = (1.0 - np.exp(-far)) / far
    for power in range(1, order + 1):
        closed = (power * closed - np.exp(-far)) / far
    return np.where(z < SERIES_BELOW, series, closed)
