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
        return _drag(motion.acceleration, speed**2, 2 * self.ratio * speed, STEP) / speed**2


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
        return _drag(motion.acceleration, speed**2, 2 * self.ratio * speed, STEP, self.turbulence) / speed**2


@dataclass(frozen=True)
class Hardening(Resonator):
    """The same on a spring that is twice as stiff at some stretch: its resonance rises with amplitude."""

    frequency: float
    ratio: float
    stretch: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 6.0, 30.0), rng.uniform(0.1, 0.3), log_uniform(rng, 2e-2, 2e-1))

    def shape(self, motion: Motion) -> np.ndarray:
        speed = 2 * np.pi * self.frequency
        return _drag(motion.acceleration, speed**2, 2 * self.ratio * speed, STEP, 0.0, 1 / self.stretch**2) / speed**2


@njit(cache=True)
def _drag(acceleration, stiffness, damping, step, turbulence=0.0, hardening=0.0):
    """Pull on the mass per mass, by Heun."""
    stretch, rate = 0.0, 0.0
    force = np.zeros(acceleration.size)
    for i in range(1, acceleration.size):
        bend = acceleration[i - 1] - _pull(stretch, rate, stiffness, damping, turbulence, hardening)
        far, fast = stretch + step * rate, rate + step * bend
        there = acceleration[i] - _pull(far, fast, stiffness, damping, turbulence, hardening)
        stretch += 0.5 * step * (rate + fast)
        rate += 0.5 * step * (bend + there)
        force[i] = _pull(stretch, rate, stiffness, damping, turbulence, hardening)
    return force


@njit(cache=True)
def _pull(stretch, rate, stiffness, damping, turbulence, hardening):
    elastic = stiffness * stretch * (1.0 + hardening * stretch * stretch)
    return elastic + (damping + turbulence * abs(rate)) * rate


FORMS = (Dragged, Orifice, Hardening)
