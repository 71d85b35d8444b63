"""Dry friction behind a spring: the force that both carry, by its own small steps with bisection.

The spring of stiffness k carries F = k (x - s); the slider, at its own place s, F = limit tanh(s'/creep velocity). In
every small step the slip velocity is the one root of a function that only rises. Backward Euler's rule, and its leading
error taken away by a second course with half the steps.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

FASTEST, BISECTIONS = 8.0, 62  # m/s; bounds closer than the digits of a velocity


@njit(cache=False)
def _course(x, h, every, k, limit, creep):
    slid, force = x[0], np.zeros((x.size - 1) // every + 1)
    for number in range(1, x.size):
        low, high = -FASTEST, FASTEST
        for _ in range(BISECTIONS):
            middle = 0.5 * (low + high)
            if limit * math.tanh(middle / creep) < k * (x[number] - slid - h * middle):
                low = middle
            else:
                high = middle
        slid += h * 0.5 * (low + high)
        if number % every == 0:
            force[number // every] = k * (x[number] - slid)
    return force


def slipping_force(place, samples, dt, stiffness, limit, creep, parts=32):
    """The force at every sample along ``place(t)``, with twice ``parts`` steps in a sample."""
    courses = []
    for fine in (parts, 2 * parts):
        times = dt / fine * np.arange((samples - 1) * fine + 1)
        courses.append(_course(place(times), dt / fine, fine, stiffness, limit, creep))
    return 2.0 * courses[1] - courses[0]
