"""Dry friction in five forms: LuGre, Bouc-Wen, Iwan, regularised Coulomb, Masing on a Ramberg-Osgood curve.

All slide at one newton, and are free of force where the path begins: the rig shakes a specimen down at its preload.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numba import njit

from .form import Proportional, log_uniform
from .motion import STEP, Motion

SHORTEST, LONGEST = 0.05e-3, 1.0e-3


class Friction(Proportional):
    """Any of the forms; the size is the sliding force."""

    kind = "friction"
    unit = "N"


@dataclass(frozen=True)
class LuGre(Friction):
    """Bristles with a falling Stribeck level: z' = v - |v| z / (travel g(v)), force = z / travel."""

    travel: float
    stiction: float
    stribeck_speed: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, SHORTEST, LONGEST), rng.uniform(0.0, 0.25), log_uniform(rng, 0.01, 0.05))

    def shape(self, motion: Motion) -> np.ndarray:
        level = 1.0 + self.stiction * np.exp(-((motion.velocity / self.stribeck_speed) ** 2))
        return _integrate_lugre(motion.velocity, level * self.travel, STEP) / self.travel


@njit(cache=True)
def _integrate_lugre(velocity, reach, step):
    """Implicit midpoint, with steps of at most 1/10 of the reach; the bristles start unbent."""
    bend = np.zeros(velocity.size)
    for i in range(1, velocity.size):
        change = 0.5 * step * (velocity[i] + velocity[i - 1])
        middle = 0.5 * (reach[i] + reach[i - 1])
        pieces = int(np.ceil(abs(change) * 10.0 / middle))
        decay = 0.5 * abs(change) / max(pieces, 1) / middle
        now = bend[i - 1]
        for _ in range(pieces):
            now = (now * (1.0 - decay) + change / pieces) / (1.0 + decay)
        bend[i] = now
    return bend


@dataclass(frozen=True)
class BoucWen(Friction):
    """travel dz/dx = 1 - |z|^power (share sgn(v z) + 1 - share), force = z."""

    travel: float
    power: float
    share: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, SHORTEST, LONGEST), rng.uniform(1.0, 3.0), rng.uniform(0.5, 0.9))

    def shape(self, motion: Motion) -> np.ndarray:
        return _integrate_bouc_wen(motion.displacement / self.travel, self.power, self.share)


@njit(cache=True)
def _bouc_wen_slope(z, side, power, share):
    return 1.0 - abs(z) ** power * (share * np.sign(side * z) + 1.0 - share)


@njit(cache=True)
def _integrate_bouc_wen(path, power, share):
    """Heun in the displacement, with steps of at most 1/20 of the travel."""
    force = np.zeros(path.size)
    z = 0.0
    for i in range(1, path.size):
        change = path[i] - path[i - 1]
        pieces = int(np.ceil(abs(change) * 20.0))
        side = np.sign(change)
        for _ in range(pieces):
            first = _bouc_wen_slope(z, side, power, share)
            second = _bouc_wen_slope(z + first * change / pieces, side, power, share)
            z += 0.5 * (first + second) * change / pieces
        force[i] = z
    return force


@dataclass(frozen=True)
class Iwan(Friction):
    """Many elastic sliders in parallel; their yield travels spread log-normally around `travel`."""

    travel: float
    spread: float
    sliders: int = 24

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, SHORTEST, LONGEST), rng.uniform(0.3, 1.2))

    def shape(self, motion: Motion) -> np.ndarray:
        quantiles = np.linspace(-2.0, 2.0, self.sliders)
        weights = np.exp(-(quantiles**2) / 2)
        limits = weights / weights.sum()
        return slide(motion.displacement, limits, self.travel * np.exp(self.spread * quantiles))


@njit(cache=True)
def slide(path, limits, travels):
    """Summed force of elastic sliders (Jenkin elements) of given limit [N] and yield travel [m]."""
    stretch = np.zeros(limits.size)
    force = np.zeros(path.size)
    for i in range(1, path.size):
        change = path[i] - path[i - 1]
        total = 0.0
        for j in range(limits.size):
            stretch[j] = min(max(stretch[j] + change, -travels[j]), travels[j])
            total += limits[j] * stretch[j] / travels[j]
        force[i] = total
    return force


@dataclass(frozen=True)
class Coulomb(Friction):
    """force = tanh(v / speed)."""

    speed: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, 0.5e-3, 2e-3))

    def shape(self, motion: Motion) -> np.ndarray:
        return np.tanh(motion.velocity / self.speed)


@dataclass(frozen=True)
class Masing(Friction):
    """Masing's rule with full memory on the Ramberg-Osgood curve x / travel = f + 0.5 |f|^power sgn f."""

    travel: float
    power: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(log_uniform(rng, SHORTEST, 0.3 * LONGEST), rng.uniform(6.0, 12.0))

    def shape(self, motion: Motion) -> np.ndarray:
        return _follow_masing(motion.travelled / self.travel, self.power)


@njit(cache=True)
def _ramberg_osgood(x, power):
    """Solve f + 0.5 f^power = |x| by Newton from above: the function is convex, so it never overshoots."""
    load = abs(x)
    force = min(load, (2.0 * load) ** (1.0 / power))
    for _ in range(50):
        raised = 0.5 * force**power
        change = (force + raised - load) / (1.0 + power * raised / max(force, 1e-300))
        force -= change
        if abs(change) < 1e-13:
            break
    return np.sign(x) * force


@njit(cache=True)
def _follow_masing(path, power):
    """Keep the open turning points; a closed loop forgets its two."""
    turn_x, turn_f = np.zeros(path.size), np.zeros(path.size)
    force = np.zeros(path.size)
    turns, side = 0, 0.0
    for i in range(1, path.size):
        heading = np.sign(path[i] - path[i - 1])
        if heading != 0.0 and side != 0.0 and heading != side:
            turn_x[turns], turn_f[turns] = path[i - 1], force[i - 1]
            turns += 1
        side = heading if heading != 0.0 else side
        turns = _forget_closed(turn_x, turns, path[i], side)
        if turns == 0:
            force[i] = _ramberg_osgood(path[i], power)
        else:
            half = 0.5 * (path[i] - turn_x[turns - 1])
            force[i] = turn_f[turns - 1] + 2.0 * _ramberg_osgood(half, power)
    return force


@njit(cache=True)
def _forget_closed(turn_x, turns, x, side):
    """Drop the loops that the path has closed; the first turn is closed by its mirror image, too."""
    while turns >= 2 and (x - turn_x[turns - 2]) * side >= 0.0:
        turns -= 2
    if turns == 1 and (x + turn_x[0]) * side >= 0.0 and abs(x) >= abs(turn_x[0]):
        turns = 0
    return turns


FORMS = (LuGre, BoucWen, Iwan, Coulomb, Masing)
