"""The specimens before anything is hidden in them, with their own integrators."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit

from .form import log_uniform
from .motion import STEP, Motion
from .relaxation import integrate_maxwell


@dataclass(frozen=True)
class Base:
    """A progressive spring, and in parallel whatever has a value other than zero.

    spring: sum of coefficient * x^power; damper: damping * v; a Maxwell branch (`maxwell_stiffness`, `maxwell_time`);
    a spring in series with Dahl friction (`prandtl_stiffness`, `prandtl_limit`), Dahl ten times as stiff. SI units.
    """

    name: str
    spring: tuple[tuple[float, float], ...]
    damping: float = 0.0
    maxwell_stiffness: float = 0.0
    maxwell_time: float = 1.0
    prandtl_stiffness: float = 0.0
    prandtl_limit: float = 1.0

    def force(self, motion: Motion) -> np.ndarray:
        """Force along a motion, shape (steps,)."""
        return sum(self.branches(motion).values(), start=np.zeros(motion.time.size))

    def branches(self, motion: Motion) -> dict[str, np.ndarray]:
        """Force of every branch that is present."""
        x, v = motion.displacement, motion.velocity
        forces = {"spring": sum(coefficient * x**power for coefficient, power in self.spring)}
        if self.damping:
            forces["damper"] = self.damping * v
        if self.maxwell_stiffness:
            forces["maxwell"] = self.maxwell_stiffness * integrate_maxwell(v, self.maxwell_time, STEP)
        if self.prandtl_stiffness:
            forces["prandtl"] = integrate_prandtl(x, self.prandtl_stiffness, self.prandtl_limit)
        return forces


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


def draw_base(name: str, rng: np.random.Generator) -> Base:
    """A base with random parameters. Raises KeyError for an unknown name."""
    return _DRAWN[name](rng)


def _spring_only(rng: np.random.Generator) -> Base:
    return Base("spring", _progressive(rng))


def _kelvin_voigt(rng: np.random.Generator) -> Base:
    return Base("kelvin_voigt", _progressive(rng), damping=rng.uniform(100.0, 400.0))


def _ftire(rng: np.random.Generator) -> Base:
    return Base(
        "ftire",
        _progressive(rng),
        damping=rng.uniform(50.0, 200.0),
        maxwell_stiffness=rng.uniform(15e3, 40e3),
        maxwell_time=log_uniform(rng, 15e-3, 120e-3),
        prandtl_stiffness=rng.uniform(15e3, 40e3),
        prandtl_limit=rng.uniform(8.0, 40.0),
    )


def _polynomial(rng: np.random.Generator) -> Base:
    spring = ((rng.uniform(160e3, 220e3), 1.0), (rng.uniform(0.3e6, 1.2e6), 2.0), (rng.uniform(5e6, 20e6), 3.0))
    return Base("polynomial", spring, damping=rng.uniform(100.0, 400.0))


def _progressive(rng: np.random.Generator) -> tuple[tuple[float, float], ...]:
    """Tangent 160-220 N/mm at no deflection, 15-60 N/mm more at 30 mm; the second power is not an integer."""
    power = rng.uniform(1.8, 2.4)
    gained = rng.uniform(15e3, 60e3)
    return (rng.uniform(160e3, 220e3), 1.0), (gained / (power * 30e-3 ** (power - 1)), power)


_DRAWN = {"spring": _spring_only, "kelvin_voigt": _kelvin_voigt, "ftire": _ftire, "polynomial": _polynomial}
