"""Damping of valves: different in both directions, or with a power of the velocity; no memory."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from .form import Proportional, log_uniform
from .motion import Motion


class Asymmetric(Proportional):
    """Any of the forms; the size is a force or a damping."""

    kind = "asymmetric_damping"
    unit = "N s/m"


@dataclass(frozen=True)
class TwoSlopes(Asymmetric):
    """The velocity, in one direction only: compression harder, or rebound. It takes energy, and never gives any."""

    side: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(float(rng.choice([-1.0, 1.0])))

    def shape(self, motion: Motion) -> np.ndarray:
        return self.side * np.maximum(self.side * motion.velocity, 0.0)


@dataclass(frozen=True)
class SoftKnee(Asymmetric):
    """side speed ln(1 + exp(side v / speed)): one direction only, rounded at rest."""

    side: float
    speed: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(float(rng.choice([-1.0, 1.0])), log_uniform(rng, 5e-3, 40e-3))

    def shape(self, motion: Motion) -> np.ndarray:
        rounded = self.speed * np.logaddexp(0.0, self.side * motion.velocity / self.speed)
        return self.side * (rounded - self.speed * np.log(2.0))


@dataclass(frozen=True)
class ReboundPower(Asymmetric):
    """|v|^power against rebound only."""

    power: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(rng.uniform(0.7, 1.3))

    def shape(self, motion: Motion) -> np.ndarray:
        return -(np.maximum(-motion.velocity, 0.0) ** self.power)


class BrokenPower(Proportional):
    """Any of the forms; the size is a force."""

    kind = "power_law_damping"
    unit = "N"


@dataclass(frozen=True)
class Power(BrokenPower):
    """|v|^power sgn v with a power away from 0, 1 and 2."""

    power: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(float(rng.uniform(0.3, 0.7) if rng.random() < 0.7 else rng.uniform(1.3, 1.6)))

    def shape(self, motion: Motion) -> np.ndarray:
        return np.sign(motion.velocity) * np.abs(motion.velocity) ** self.power


@dataclass(frozen=True)
class Eyring(BrokenPower):
    """asinh(v / speed)."""

    speed: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 10e-3, 60e-3))

    def shape(self, motion: Motion) -> np.ndarray:
        return np.arcsinh(motion.velocity / self.speed)


@dataclass(frozen=True)
class Digressive(BrokenPower):
    """v / (speed + |v|)."""

    speed: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 30e-3, 200e-3))

    def shape(self, motion: Motion) -> np.ndarray:
        return motion.velocity / (self.speed + np.abs(motion.velocity))


ASYMMETRIC_FORMS = (TwoSlopes, SoftKnee, ReboundPower)
POWER_FORMS = (Power, Eyring, Digressive)
