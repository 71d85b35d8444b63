"""Contacts: a stop near the end of the reach, and play."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numba import njit

from .form import Proportional, log_uniform
from .motion import Motion


class Stop(Proportional):
    """Any of the forms; the size is a stiffness or a force."""

    kind = "end_stop"
    unit = "N/m"


@dataclass(frozen=True)
class Hertz(Stop):
    """depth^power."""

    place: float
    power: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(rng.uniform(24e-3, 32e-3), rng.uniform(1.0, 1.8))

    def shape(self, motion: Motion) -> np.ndarray:
        return np.maximum(motion.displacement - self.place, 0.0) ** self.power


@dataclass(frozen=True)
class Bumper(Stop):
    """expm1(depth / length)."""

    place: float
    length: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(rng.uniform(24e-3, 31e-3), log_uniform(rng, 3e-3, 20e-3))

    def shape(self, motion: Motion) -> np.ndarray:
        return np.expm1(np.maximum(motion.displacement - self.place, 0.0) / self.length)


@dataclass(frozen=True)
class SoftBumper(Stop):
    """exp(r) - 1 - r with the depth r over a length: no kink where it is touched."""

    place: float
    length: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(rng.uniform(20e-3, 29e-3), log_uniform(rng, 2e-3, 6e-3))

    def shape(self, motion: Motion) -> np.ndarray:
        depth = np.maximum(motion.displacement - self.place, 0.0) / self.length
        return np.expm1(depth) - depth


class Play(Proportional):
    """Any of the forms; the size is a stiffness."""

    kind = "clearance"
    unit = "N/m"


@dataclass(frozen=True)
class LostMotion(Play):
    """The part of the stiffness that play takes away: x less its follower behind a gap."""

    gap: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 0.05e-3, 1e-3))

    def shape(self, motion: Motion) -> np.ndarray:
        return follow(motion.displacement, self.gap) - motion.displacement


@njit(cache=True)
def follow(path, gap):
    """The follower of a path behind play of `gap` to either side; the first place is approached from below."""
    found = np.empty(path.size)
    now = path[0] - gap
    for i in range(path.size):
        if path[i] - now > gap:
            now = path[i] - gap
        elif now - path[i] > gap:
            now = path[i] + gap
        found[i] = now
    return found


@dataclass(frozen=True)
class SoftLostMotion(Play):
    """Two followers behind different gaps, one after the other in their share."""

    gap: float
    ratio: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 0.1e-3, 1e-3), rng.uniform(0.4, 0.9))

    def shape(self, motion: Motion) -> np.ndarray:
        both = follow(motion.displacement, self.gap) + follow(motion.displacement, self.ratio * self.gap)
        return 0.5 * both - motion.displacement


STOP_FORMS = (Hertz, Bumper, SoftBumper)
PLAY_FORMS = (LostMotion, SoftLostMotion)
