"""Moving mass between the load cell and the driven end: rigid, or on a mount that is stiff for the test."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numba import njit

from .form import Proportional
from .motion import STEP, Motion


@dataclass(frozen=True)
class RigidMass(Proportional):
    """force = mass * acceleration."""

    kind = "moving_mass"
    unit = "kg"

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls()

    def shape(self, motion: Motion) -> np.ndarray:
        return motion.acceleration


@dataclass(frozen=True)
class MountedMass(Proportional):
    """A mass on a mount: y'' = w^2 (x - y) + 2 D w (x' - y'), force = mass * y''; w beyond 150 Hz."""

    kind = "moving_mass"
    unit = "kg"
    frequency: float
    damping_ratio: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(rng.uniform(160.0, 300.0), rng.uniform(0.02, 0.1))

    def shape(self, motion: Motion) -> np.ndarray:
        pull = 2 * np.pi * self.frequency
        return _integrate_mounted(motion.acceleration, pull**2, 2 * self.damping_ratio * pull, STEP)


@njit(cache=True)
def _integrate_mounted(acceleration, stiffness, damping, step):
    """Acceleration of the mass; the mount's stretch e = x - y by the trapezoidal rule, at rest to begin with."""
    stretch, rate, bend = 0.0, 0.0, acceleration[0]
    result = np.zeros(acceleration.size)
    inertia = 1.0 + 0.5 * step * damping + 0.25 * step * step * stiffness
    for i in range(1, acceleration.size):
        ahead = rate + 0.5 * step * bend
        reach = stretch + step * rate + 0.25 * step * step * bend
        bend = (acceleration[i] - damping * ahead - stiffness * reach) / inertia
        rate = ahead + 0.5 * step * bend
        stretch = reach + 0.25 * step * step * bend
        result[i] = acceleration[i] - bend
    return result


FORMS = (RigidMass, MountedMass)
