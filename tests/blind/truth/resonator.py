"""A mass on a spring that is dragged along: an inner resonance within or near the sweep."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numba import njit

from .form import Proportional, log_uniform
from .motion import STEP, Motion


class Resonator(Proportional):
    """Either form; the size is the stiffness of the spring."""

    kind = "resonance"
    unit = "N/m"


@dataclass(frozen=True)
class Dragged(Resonator):
    """e = x - y, y'' = w^2 e + 2 D w e': force w^2 e + 2 D w e' over w^2."""

    frequency: float
    ratio: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 6.0, 40.0), rng.uniform(0.03, 0.3))

    def shape(self, motion: Motion) -> np.ndarray:
        speed = 2 * np.pi * self.frequency
        return _drag(motion.acceleration, speed**2, 2 * self.ratio * speed, 0.0, STEP) / speed**2


@dataclass(frozen=True)
class Orifice(Resonator):
    """The same with damping of the square of the stretch's rate."""

    frequency: float
    ratio: float
    turbulence: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 6.0, 30.0), rng.uniform(0.03, 0.15), log_uniform(rng, 5.0, 100.0))

    def shape(self, motion: Motion) -> np.ndarray:
        speed = 2 * np.pi * self.frequency
        return _drag(motion.acceleration, speed**2, 2 * self.ratio * speed, self.turbulence, STEP) / speed**2


@njit(cache=True)
def _drag(acceleration, stiffness, damping, turbulence, step):
    """Pull on the mass per mass, by Heun."""
    stretch, rate = 0.0, 0.0
    force = np.zeros(acceleration.size)
    for i in range(1, acceleration.size):
        pull = stiffness * stretch + (damping + turbulence * abs(rate)) * rate
        bend = acceleration[i - 1] - pull
        far, fast = stretch + step * rate, rate + step * bend
        there = acceleration[i] - stiffness * far - (damping + turbulence * abs(fast)) * fast
        stretch += 0.5 * step * (rate + fast)
        rate += 0.5 * step * (bend + there)
        force[i] = stiffness * stretch + (damping + turbulence * abs(rate)) * rate
    return force


FORMS = (Dragged, Orifice)
