"""Linear relaxation in four forms, on a specimen brought to the beginning of the path `DWELL` seconds before.

All but the Maxwell branch are the hereditary integral of a relaxation modulus G over the path,
F(t) = int G(t - s) dx(s), with x linear and G averaged over each step. Whatever has a long memory still
remembers the preload.
"""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from functools import lru_cache
from typing import Self

import numpy as np
from numba import njit
from scipy.signal import fftconvolve
from scipy.special import gamma, gammaincc

from .form import Proportional, log_uniform
from .motion import STEP, Motion

FASTEST, SLOWEST = 5e-3, 200e-3
DWELL = 30.0


class Relaxation(Proportional):
    """Any of the forms; the size is a stiffness."""

    kind = "relaxation"
    unit = "N/m"


class Hereditary(Relaxation):
    """A form given by its relaxation modulus."""

    @abstractmethod
    def modulus(self, steps: int) -> np.ndarray:
        """Mean of G over each of the first `steps` steps."""

    @abstractmethod
    def remainder(self, time: np.ndarray) -> np.ndarray:
        """G at times long after the step."""

    def shape(self, motion: Motion) -> np.ndarray:
        changes = np.diff(motion.displacement)
        force = motion.displacement[0] * self.remainder(DWELL + motion.time)
        force[1:] += fftconvolve(changes, _remembered_modulus(self, changes.size))[: changes.size]
        return force


@lru_cache(maxsize=8)
def _remembered_modulus(form: Hereditary, steps: int) -> np.ndarray:
    return form.modulus(steps)


@dataclass(frozen=True)
class Springpot(Hereditary):
    """K* = (j w)^order, G = t^-order / Gamma(1 - order)."""

    order: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(rng.uniform(0.1, 0.5))

    def modulus(self, steps: int) -> np.ndarray:
        edges = np.arange(steps + 1) ** (1 - self.order)
        return np.diff(edges) * STEP**-self.order / gamma(2 - self.order)

    def remainder(self, time: np.ndarray) -> np.ndarray:
        return time**-self.order / gamma(1 - self.order)


@dataclass(frozen=True)
class StretchedExponential(Hereditary):
    """G = exp(-(t / time)^power)."""

    time: float
    power: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, FASTEST, SLOWEST), rng.uniform(0.35, 0.75))

    def modulus(self, steps: int) -> np.ndarray:
        edges = (np.arange(steps + 1) * STEP / self.time) ** self.power
        remaining = self.time * gamma(1 / self.power) / self.power * gammaincc(1 / self.power, edges)
        return -np.diff(remaining) / STEP

    def remainder(self, time: np.ndarray) -> np.ndarray:
        return np.exp(-((time / self.time) ** self.power))


@dataclass(frozen=True)
class ColeCole(Hereditary):
    """K* = (j w time)^order / (1 + (j w time)^order), summed over its known spectrum of Maxwell branches."""

    time: float
    order: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, FASTEST, SLOWEST), rng.uniform(0.4, 0.85))

    def modulus(self, steps: int) -> np.ndarray:
        times, weights = self._spectrum()
        total = np.zeros(steps)
        for branch_time, weight in zip(times, weights, strict=True):
            fade = np.exp(-STEP / branch_time * np.arange(steps))
            total += weight * branch_time / STEP * -np.expm1(-STEP / branch_time) * fade
        return total

    def remainder(self, time: np.ndarray) -> np.ndarray:
        times, weights = self._spectrum()
        knots = np.linspace(time[0], time[-1], 17)
        return np.interp(time, knots, np.exp(-knots[:, None] / times) @ weights)

    def _spectrum(self) -> tuple[np.ndarray, np.ndarray]:
        """Weight over ln(branch time / time): sin(pi a) / (2 pi (cosh(a u) + cos(pi a))), a the order."""
        reach = 16.0 / self.order
        u = np.linspace(-reach, reach, 161)
        angle = np.pi * self.order
        weights = np.sin(angle) / (2 * np.pi * (np.cosh(self.order * u) + np.cos(angle)))
        return self.time * np.exp(u), weights * (u[1] - u[0])


@dataclass(frozen=True)
class Maxwell(Relaxation):
    """F' = v - F / time, by the trapezoidal rule."""

    time: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, FASTEST, SLOWEST))

    def shape(self, motion: Motion) -> np.ndarray:
        return integrate_maxwell(motion.velocity, self.time, STEP)


@njit(cache=True)
def integrate_maxwell(velocity, time, step):
    """Force of a Maxwell branch of stiffness one, relaxed at the start."""
    force = np.zeros(velocity.size)
    half = 0.5 * step / time
    for i in range(1, velocity.size):
        drive = 0.5 * step * (velocity[i] + velocity[i - 1])
        force[i] = (force[i - 1] * (1.0 - half) + drive) / (1.0 + half)
    return force


FORMS = (Springpot, StretchedExponential, ColeCole, Maxwell)
