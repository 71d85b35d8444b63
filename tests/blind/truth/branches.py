"""The branches that a specimen is made of, with their own integrators. SI units."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, fields, replace

import numpy as np
from numba import njit

from .motion import STEP, Motion, at_samples
from .relaxation import integrate_maxwell

CHANGE = 1e-3


@dataclass(frozen=True)
class Branch(ABC):
    """A part that carries a force of its own along the path of the specimen; its fields are its numbers."""

    @abstractmethod
    def force(self, motion: Motion) -> np.ndarray:
        """Force along a motion, shape (steps,)."""

    def tangents(self, motion: Motion) -> list[np.ndarray]:
        """What a refit of its numbers can follow, to first order, at the sample times: each of shape (samples,)."""
        now = at_samples(self.force(motion))
        return [at_samples(changed.force(motion)) - now for changed in self._changed()]

    def _changed(self) -> list[Branch]:
        return [replace(self, **{field.name: (1.0 + CHANGE) * getattr(self, field.name)}) for field in fields(self)]


@dataclass(frozen=True)
class Spring(Branch):
    """Sum of coefficient * x^power, the same in tension, fitted by powers up to ``degree``."""

    terms: tuple[tuple[float, float], ...]
    degree: int = 6

    def force(self, motion: Motion) -> np.ndarray:
        x = motion.displacement
        return sum(coefficient * x * np.abs(x) ** (power - 1.0) for coefficient, power in self.terms)

    def tangents(self, motion: Motion) -> list[np.ndarray]:
        deflection = at_samples(motion.displacement) / 20e-3
        return [deflection**power for power in range(1, self.degree + 1)]


@dataclass(frozen=True)
class Damper(Branch):
    """damping * v."""

    damping: float

    def force(self, motion: Motion) -> np.ndarray:
        return self.damping * motion.velocity


@dataclass(frozen=True)
class FadingDamper(Branch):
    """damping * v * exp(-(x - 20 mm) / length): what is pressed harder damps less."""

    damping: float
    length: float

    def force(self, motion: Motion) -> np.ndarray:
        return self.damping * motion.velocity * np.exp(-(motion.displacement - 20e-3) / self.length)


@dataclass(frozen=True)
class ShockAbsorber(Branch):
    """Valves that level out, t = tanh(v / knee), beside an orifice: level * t - asymmetry * t^2 + slope * v."""

    level: float
    asymmetry: float
    knee: float
    slope: float

    def force(self, motion: Motion) -> np.ndarray:
        opened = np.tanh(motion.velocity / self.knee)
        return self.level * opened - self.asymmetry * opened**2 + self.slope * motion.velocity

    def tangents(self, motion: Motion) -> list[np.ndarray]:
        """Any table over velocity, with more places where it bends."""
        v, places = at_samples(motion.velocity), np.array([0.03, 0.08, 0.15, 0.25, 0.4, 0.6, 0.8])
        places = np.concatenate([-places[::-1], [0.0], places])
        return [np.interp(v, places, one) for one in np.eye(places.size) if one[places.size // 2] == 0.0]


@dataclass(frozen=True)
class Maxwell(Branch):
    """A spring in series with a damper."""

    stiffness: float
    time: float

    def force(self, motion: Motion) -> np.ndarray:
        return self.stiffness * integrate_maxwell(motion.velocity, self.time, STEP)


@dataclass(frozen=True)
class Prandtl(Branch):
    """A spring in series with Dahl friction ten times as stiff."""

    stiffness: float
    limit: float

    def force(self, motion: Motion) -> np.ndarray:
        return integrate_prandtl(motion.displacement, self.stiffness, self.limit)


@dataclass(frozen=True)
class Dahl(Branch):
    """Dahl friction, exact between two points of the path."""

    stiffness: float
    limit: float

    def force(self, motion: Motion) -> np.ndarray:
        return integrate_dahl(motion.displacement, self.stiffness, self.limit)


@njit(cache=True)
def _prandtl_slope(force, side, stiffness, limit):
    grip = 10.0 * max(1.0 - side * force / limit, 0.0)
    return stiffness * grip / (1.0 + grip)


@njit(cache=True)
def integrate_prandtl(path, stiffness, limit):
    """Spring in series with Dahl friction ten times as stiff: Heun, steps of at most 1/40 of the yield travel."""
    force = np.zeros(path.size)
    for i in range(1, path.size):
        change = path[i] - path[i - 1]
        pieces = int(np.ceil(abs(change) * 40.0 * stiffness / limit))
        side = np.sign(change)
        now = force[i - 1]
        for _ in range(pieces):
            first = _prandtl_slope(now, side, stiffness, limit)
            second = _prandtl_slope(now + first * change / pieces, side, stiffness, limit)
            now += 0.5 * (first + second) * change / pieces
        force[i] = now
    return force


@njit(cache=True)
def integrate_dahl(path, stiffness, limit):
    """Relaxation of the force towards the limit on the side of the motion, over the travel limit / stiffness."""
    force = np.zeros(path.size)
    for i in range(1, path.size):
        change = path[i] - path[i - 1]
        aim = np.sign(change) * limit
        force[i] = aim + (force[i - 1] - aim) * np.exp(-abs(change) * stiffness / limit)
    return force
