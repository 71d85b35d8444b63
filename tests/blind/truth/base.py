"""The specimens before anything is hidden in them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .branches import Branch, Dahl, Damper, FadingDamper, Maxwell, Prandtl, ShockAbsorber, Spring
from .form import log_uniform
from .motion import Motion

BRANCHES_OF_MODEL = {
    "spring": ("spring",),
    "kelvin_voigt": ("spring", "damper"),
    "ftire": ("spring", "damper", "maxwell", "prandtl"),
    "tire_model_3": ("spring", "damper", "maxwell", "prandtl", "dahl"),
}
KIND_OF_BRANCH = {"damper": "viscous_damping", "maxwell": "relaxation", "prandtl": "friction"}


@dataclass(frozen=True)
class Base:
    """A specimen whose branches carry their forces side by side."""

    name: str
    branches: Mapping[str, Branch]

    def force(self, motion: Motion) -> np.ndarray:
        """Force along a motion, shape (steps,)."""
        return sum((branch.force(motion) for branch in self.branches.values()), start=np.zeros(motion.time.size))

    def known_to(self, model: str) -> Base:
        """What a network of that name has of it. KeyError for a network whose branches are not listed."""
        return Base(model, {word: branch for word, branch in self.branches.items() if word in BRANCHES_OF_MODEL[model]})

    def tangents(self, motion: Motion) -> np.ndarray:
        """What a refit of its numbers can follow, to first order, shape (samples, columns)."""
        return np.stack([column for branch in self.branches.values() for column in branch.tangents(motion)], axis=1)


def draw_base(name: str, rng: np.random.Generator) -> Base:
    """A base with random parameters. Raises KeyError for an unknown name."""
    return Base(name, _DRAWN[name](rng))


def _spring_only(rng: np.random.Generator) -> dict[str, Branch]:
    return {"spring": _progressive(rng)}


def _kelvin_voigt(rng: np.random.Generator) -> dict[str, Branch]:
    return {"spring": _progressive(rng), "damper": Damper(rng.uniform(100.0, 400.0))}


def _ftire(rng: np.random.Generator) -> dict[str, Branch]:
    return {
        "spring": _progressive(rng),
        "damper": Damper(rng.uniform(50.0, 200.0)),
        "maxwell": Maxwell(rng.uniform(15e3, 40e3), log_uniform(rng, 15e-3, 120e-3)),
        "prandtl": Prandtl(rng.uniform(15e3, 40e3), rng.uniform(8.0, 40.0)),
    }


def _tire_model_3(rng: np.random.Generator) -> dict[str, Branch]:
    times = (log_uniform(rng, 80e-3, 250e-3), log_uniform(rng, 15e-3, 50e-3), log_uniform(rng, 4e-3, 10e-3))
    maxwell = {f"maxwell_{number}": Maxwell(rng.uniform(6e3, 20e3), time) for number, time in enumerate(times, 1)}
    return {
        "spring": _progressive(rng),
        "damper": FadingDamper(rng.uniform(50.0, 200.0), rng.uniform(20e-3, 80e-3)),
        **maxwell,
        "prandtl": Prandtl(rng.uniform(15e3, 30e3), rng.uniform(20.0, 60.0)),
        "dahl": Dahl(rng.uniform(50e3, 120e3), rng.uniform(8.0, 20.0)),
    }


def _damper(rng: np.random.Generator) -> dict[str, Branch]:
    level, asymmetry = rng.uniform(400.0, 700.0), rng.uniform(100.0, 250.0)
    valves = ShockAbsorber(level, asymmetry, rng.uniform(0.08, 0.2), rng.uniform(400.0, 1000.0))
    return {"gas": Spring(((rng.uniform(1e3, 4e3), 1.0),), degree=1), "valves": valves}


def _polynomial(rng: np.random.Generator) -> dict[str, Branch]:
    terms = ((rng.uniform(160e3, 220e3), 1.0), (rng.uniform(0.3e6, 1.2e6), 2.0), (rng.uniform(5e6, 20e6), 3.0))
    return {"spring": Spring(terms, degree=3), "damper": Damper(rng.uniform(100.0, 400.0))}


def _progressive(rng: np.random.Generator) -> Spring:
    """Tangent 160-220 N/mm at no deflection, 15-60 N/mm more at 30 mm; the second power is not an integer."""
    power = rng.uniform(1.8, 2.4)
    gained = rng.uniform(15e3, 60e3)
    return Spring(((rng.uniform(160e3, 220e3), 1.0), (gained / (power * 30e-3 ** (power - 1)), power)))


_DRAWN = {
    "spring": _spring_only,
    "kelvin_voigt": _kelvin_voigt,
    "ftire": _ftire,
    "tire_model_3": _tire_model_3,
    "damper": _damper,
    "polynomial": _polynomial,
}
