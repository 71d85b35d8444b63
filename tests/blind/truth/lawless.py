"""Forces that no element and no cause describes: what an engine is to leave unexplained."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .form import Proportional, log_uniform


class Lawless(Proportional):
    """Either form."""

    kind = "no_law"
    unit = "1"


@dataclass(frozen=True)
class Swinging(Lawless):
    """A stiffness that swings in its own time, whatever is driven: (x - x_0) sin(2 pi f t + phase)."""

    frequency: float
    phase: float

    @classmethod
    def draw(cls, rng):
        return cls(rng.uniform(0.6, 1.4), rng.uniform(0.0, 2 * np.pi))

    def shape(self, motion):
        return motion.travelled * np.sin(2 * np.pi * self.frequency * motion.time + self.phase)


@dataclass(frozen=True)
class Toothed(Lawless):
    """Damping that turns its sign along the way, as over teeth: v sin(2 pi x / pitch + phase)."""

    pitch: float
    phase: float

    @classmethod
    def draw(cls, rng):
        return cls(log_uniform(rng, 0.6e-3, 2e-3), rng.uniform(0.0, 2 * np.pi))

    def shape(self, motion):
        return motion.velocity * np.sin(2 * np.pi * motion.displacement / self.pitch + self.phase)


@dataclass(frozen=True)
class StiffAtSpeed(Lawless):
    """A stiffness that grows with the speed of the moment and dissipates nothing: (x - x_0) v^2 / (v_0^2 + v^2)."""

    speed: float

    @classmethod
    def draw(cls, rng):
        return cls(log_uniform(rng, 0.03, 0.15))

    def shape(self, motion):
        return motion.travelled * motion.velocity**2 / (self.speed**2 + motion.velocity**2)


FORMS = (Swinging, Toothed, StiffAtSpeed)
