"""Damping: viscous, quadratic, and viscous or relaxing with a level that depends on the deflection."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from typing import Self

import numpy as np

from .form import Proportional, log_uniform
from .motion import STEP, Motion
from .relaxation import Maxwell, Relaxation, StretchedExponential


def _power(velocity: np.ndarray, power: float) -> np.ndarray:
    return np.sign(velocity) * np.abs(velocity) ** power


@dataclass(frozen=True)
class NearlyViscous(Proportional):
    """|v|^power sgn v, the power close to one."""

    kind = "viscous_damping"
    unit = "N (s/m)^power"
    power: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(rng.uniform(0.9, 1.1))

    def shape(self, motion: Motion) -> np.ndarray:
        return _power(motion.velocity, self.power)


@dataclass(frozen=True)
class Viscous(Proportional):
    """The velocity, from differences of the displacement."""

    kind = "viscous_damping"
    unit = "N s/m"

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls()

    def shape(self, motion: Motion) -> np.ndarray:
        return np.gradient(motion.displacement, STEP)


@dataclass(frozen=True)
class Quadratic(Proportional):
    """|v| v."""

    kind = "quadratic_damping"
    unit = "N s2/m2"

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls()

    def shape(self, motion: Motion) -> np.ndarray:
        return np.abs(motion.velocity) * motion.velocity


@dataclass(frozen=True)
class NearlyQuadratic(Proportional):
    """|v|^power sgn v, the power close to two."""

    kind = "quadratic_damping"
    unit = "N (s/m)^power"
    power: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(rng.uniform(1.7, 2.3))

    def shape(self, motion: Motion) -> np.ndarray:
        return _power(motion.velocity, self.power)


class PreloadDependent(Proportional):
    """v times a positive level of the deflection; the size is the damping where the level is one."""

    kind = "preload_dependent_damping"
    unit = "N s/m"

    @abstractmethod
    def level(self, deflection: np.ndarray) -> np.ndarray:
        """Positive, and rising or falling all the way."""

    def shape(self, motion: Motion) -> np.ndarray:
        return self.level(motion.displacement) * motion.velocity


@dataclass(frozen=True)
class Relaxing(Proportional):
    """Force that relaxes, by a Maxwell branch or a stretched exponential, times the level of another form.

    The size is a stiffness.
    """

    kind = "preload_dependent_damping"
    unit = "N/m"
    remembered: Relaxation
    faded: PreloadDependent

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        remembered = (Maxwell, StretchedExponential)[rng.integers(2)].draw(rng)
        return cls(remembered, (Exponential, Tanh, Rational)[rng.integers(3)].draw(rng))

    def shape(self, motion: Motion) -> np.ndarray:
        return self.faded.level(motion.displacement) * self.remembered.shape(motion)


@dataclass(frozen=True)
class Exponential(PreloadDependent):
    """exp(-x / length); a negative length rises."""

    length: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 6e-3, 20e-3) * _direction(rng))

    def level(self, deflection: np.ndarray) -> np.ndarray:
        return np.exp(-deflection / self.length)


@dataclass(frozen=True)
class Tanh(PreloadDependent):
    """(1 - tanh((x - middle) / width)) / 2; a negative width rises."""

    middle: float
    width: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(rng.uniform(14e-3, 26e-3), log_uniform(rng, 4e-3, 15e-3) * _direction(rng))

    def level(self, deflection: np.ndarray) -> np.ndarray:
        return 0.5 * (1 - np.tanh((deflection - self.middle) / self.width))


@dataclass(frozen=True)
class Rational(PreloadDependent):
    """1 / (1 + (x / length)^power)."""

    length: float
    power: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 8e-3, 25e-3), rng.uniform(1.0, 3.0))

    def level(self, deflection: np.ndarray) -> np.ndarray:
        return 1 / (1 + (np.maximum(deflection, 0.0) / self.length) ** self.power)


def _direction(rng: np.random.Generator) -> float:
    return 1.0 if rng.random() < 0.7 else -1.0


VISCOUS_FORMS = (NearlyViscous, Viscous)
QUADRATIC_FORMS = (Quadratic, NearlyQuadratic)
PRELOAD_FORMS = (Exponential, Tanh, Rational, Relaxing)
