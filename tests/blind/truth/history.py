"""What depends on the history of a run: filler networks, warmth, bedding-in, creep. Every run begins fresh and cold."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from typing import Self

import numpy as np
from numba import njit
from scipy.signal import fftconvolve

from .form import Proportional, log_uniform
from .friction import slide
from .motion import STEP, Motion


class Payne(Proportional):
    """Any of the forms; the size is a stiffness."""

    kind = "amplitude_softening"
    unit = "N/m"


@dataclass(frozen=True)
class PowerSpectrum(Payne):
    """Forty sliders of yield travels from 5 um to 20 mm, stiffness by travel^-power."""

    power: float
    sliders: int = 40

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(rng.uniform(-0.1, 0.4))

    def shape(self, motion: Motion) -> np.ndarray:
        travels = np.geomspace(5e-6, 20e-3, self.sliders)
        stiffness = (travels / travels[0]) ** -self.power
        return slide(motion.travelled, stiffness / stiffness.sum() * travels, travels)


@dataclass(frozen=True)
class Fletcher(Payne):
    """Sliders after the Fletcher-Gent curve: softening 1/(1 + (travel / middle)^power), in thirty steps."""

    middle: float
    power: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 0.4e-3, 2e-3), rng.uniform(0.5, 0.8))

    def shape(self, motion: Motion) -> np.ndarray:
        edges = np.geomspace(3e-6, 50e-3, 31)
        travels = np.sqrt(edges[1:] * edges[:-1])
        stiffness = -np.diff(1.0 / (1.0 + (edges / self.middle) ** self.power))
        return slide(motion.travelled, stiffness * travels, travels)


class Warm(Proportional):
    """Any of the forms; the size is the stiffness that full warmth takes away."""

    kind = "softening"
    unit = "N/m"


@dataclass(frozen=True)
class Dissipated(Warm):
    """Warmth from the power v^2, cooling at a constant rate; the elastic force falls in proportion to it."""

    time: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 0.5, 8.0))

    def shape(self, motion: Motion) -> np.ndarray:
        return -motion.displacement * _warmth(motion.velocity**2 / 0.1**2, self.time, STEP)


@dataclass(frozen=True)
class Arrhenius(Warm):
    """As before, the stiffness falling with exp(-warmth)."""

    time: float
    scale: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 0.5, 8.0), log_uniform(rng, 0.1, 1.0))

    def shape(self, motion: Motion) -> np.ndarray:
        return motion.displacement * np.expm1(-self.scale * _warmth(motion.velocity**2 / 0.1**2, self.time, STEP))


@njit(cache=True)
def _warmth(power, time, step):
    found = np.zeros(power.size)
    for i in range(1, power.size):
        gained = 0.5 * step * (power[i] + power[i - 1]) / time
        found[i] = (found[i - 1] * (1.0 - 0.5 * step / time) + gained) / (1.0 + 0.5 * step / time)
    return found


class Mullins(Proportional):
    """Any of the forms; the size is a stiffness."""

    kind = "bedding_in"
    unit = "N/m"


@dataclass(frozen=True)
class FarthestStretch(Mullins):
    """x exp(-farthest / length)."""

    length: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 5e-3, 60e-3))

    def shape(self, motion: Motion) -> np.ndarray:
        farthest = np.maximum.accumulate(np.abs(motion.displacement))
        return motion.displacement * np.exp(-farthest / self.length)


@dataclass(frozen=True)
class OgdenRoxburgh(Mullins):
    """x (1 - erf((W_max - W) / (m)) / r) with the energy W = x^2."""

    energy: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 10e-3, 60e-3) ** 2)

    def shape(self, motion: Motion) -> np.ndarray:
        from scipy.special import erf

        work = motion.displacement**2
        return -motion.displacement * erf((np.maximum.accumulate(work) - work) / self.energy)


class Creeping(Proportional):
    """Any of the forms: a force that every change of deflection loses with time; the size is a stiffness."""

    kind = "creep"
    unit = "N/m"

    @abstractmethod
    def lost(self, time: np.ndarray) -> np.ndarray:
        """What is lost of a unit step so long after it."""

    def shape(self, motion: Motion) -> np.ndarray:
        """The preload of the run was set at its start; every later change creeps as well."""
        lost = self.lost(motion.time)
        changes = np.diff(motion.displacement, prepend=0.0)
        return -fftconvolve(changes, lost)[: changes.size]


@dataclass(frozen=True)
class Logarithm(Creeping):
    """log10(1 + t / begin)."""

    begin: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 0.02, 0.5))

    def lost(self, time: np.ndarray) -> np.ndarray:
        return np.log10(1.0 + time / self.begin)


@dataclass(frozen=True)
class PowerOfTime(Creeping):
    """(t / second)^power."""

    power: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(rng.uniform(0.1, 0.35))

    def lost(self, time: np.ndarray) -> np.ndarray:
        return time**self.power


PAYNE_FORMS = (PowerSpectrum, Fletcher)
WARM_FORMS = (Dissipated, Arrhenius)
MULLINS_FORMS = (FarthestStretch, OgdenRoxburgh)
CREEP_FORMS = (Logarithm, PowerOfTime)
