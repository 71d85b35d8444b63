"""Dry friction whose limit is not constant: it grows with the load, or falls with speed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numba import njit

from .form import Proportional, log_uniform
from .motion import Motion


class Loaded(Proportional):
    """Any of the forms; the size is the sliding force at 20 mm."""

    kind = "load_dependent_friction"
    unit = "N"


@dataclass(frozen=True)
class Amontons(Loaded):
    """An elastic slider whose limit is in proportion to a power of the deflection."""

    travel: float
    power: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 0.05e-3, 1e-3), rng.uniform(0.8, 1.6))

    def shape(self, motion: Motion) -> np.ndarray:
        level = np.maximum(motion.displacement / 20e-3, 0.0) ** self.power
        return slide_under(motion.displacement, level, level, np.full(level.size, self.travel))


@dataclass(frozen=True)
class GrowingContact(Loaded):
    """An elastic slider whose limit grows by a logistic curve."""

    travel: float
    middle: float
    width: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 0.05e-3, 1e-3), rng.uniform(14e-3, 26e-3), log_uniform(rng, 2e-3, 6e-3))

    def shape(self, motion: Motion) -> np.ndarray:
        level = 2.0 / (1.0 + np.exp(-(motion.displacement - self.middle) / self.width))
        return slide_under(motion.displacement, level, level, np.full(level.size, self.travel))


class Fading(Proportional):
    """Any of the forms; the size is the sliding force at rest."""

    kind = "velocity_dependent_friction"
    unit = "N"


@dataclass(frozen=True)
class Stribeck(Fading):
    """An elastic slider with the limit share + (1 - share) exp(-|v| / speed)."""

    travel: float
    speed: float
    share: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 0.05e-3, 0.5e-3), log_uniform(rng, 10e-3, 80e-3), rng.uniform(0.1, 0.4))

    def shape(self, motion: Motion) -> np.ndarray:
        level = self.share + (1.0 - self.share) * np.exp(-np.abs(motion.velocity) / self.speed)
        return slide_under(motion.displacement, level, np.ones(level.size), np.full(level.size, self.travel))


@dataclass(frozen=True)
class Lubricated(Fading):
    """The limit 1 / (1 + (|v| / speed)^power)."""

    travel: float
    speed: float
    power: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 0.05e-3, 0.5e-3), log_uniform(rng, 15e-3, 80e-3), rng.uniform(1.0, 2.0))

    def shape(self, motion: Motion) -> np.ndarray:
        level = 1.0 / (1.0 + (np.abs(motion.velocity) / self.speed) ** self.power)
        return slide_under(motion.displacement, level, np.ones(level.size), np.full(level.size, self.travel))


@njit(cache=True)
def slide_under(path, limit, stiff, travel):
    """Force of an elastic slider of a stiffness stiff / travel whose limit changes along the path."""
    force = np.zeros(path.size)
    now = 0.0
    for i in range(1, path.size):
        now += stiff[i] / travel[i] * (path[i] - path[i - 1])
        now = min(max(now, -limit[i]), limit[i])
        force[i] = now
    return force


LOADED_FORMS = (Amontons, GrowingContact)
FADING_FORMS = (Stribeck, Lubricated)
