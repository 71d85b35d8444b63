"""Elastic force beyond the base curve, inside the range of deflections that the sweeps cover."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from typing import Self

import numpy as np

from .form import Proportional, log_uniform
from .motion import Motion


class StiffnessCurve(Proportional):
    """Any of the forms; the size is a force, and the force is zero at no deflection."""

    kind = "stiffness_curve"
    unit = "N"

    @abstractmethod
    def curve(self, deflection: np.ndarray) -> np.ndarray:
        """The elastic force up to a constant."""

    def shape(self, motion: Motion) -> np.ndarray:
        return self.curve(motion.displacement) - self.curve(np.zeros(1))


@dataclass(frozen=True)
class Knee(StiffnessCurve):
    """tanh((x - middle) / width)."""

    middle: float
    width: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(rng.uniform(8e-3, 32e-3), log_uniform(rng, 1e-3, 4e-3))

    def curve(self, deflection: np.ndarray) -> np.ndarray:
        return np.tanh((deflection - self.middle) / self.width)


@dataclass(frozen=True)
class Ripple(StiffnessCurve):
    """sin(2 pi x / length + angle)."""

    length: float
    angle: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 4e-3, 14e-3), rng.uniform(0.0, 2 * np.pi))

    def curve(self, deflection: np.ndarray) -> np.ndarray:
        return np.sin(2 * np.pi * deflection / self.length + self.angle)


@dataclass(frozen=True)
class PowerLaw(StiffnessCurve):
    """((x - begin) / 10 mm)^power from `begin` on."""

    begin: float
    power: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(rng.uniform(4e-3, 12e-3), rng.uniform(1.3, 3.0))

    def curve(self, deflection: np.ndarray) -> np.ndarray:
        return (np.maximum(deflection - self.begin, 0.0) / 10e-3) ** self.power


FORMS = (Knee, Ripple, PowerLaw)
