"""One run, and what laws may know of it and of the specimen."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .rig import Rig


@dataclass(frozen=True, eq=False)
class Record:
    """A run before anything is hidden: arrays (n,) in SI units; `preload` is nan for the quasi-static loop."""

    name: str
    kind: str
    time: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray
    force: np.ndarray
    amplitude: float = float("nan")
    preload: float = float("nan")
    repeats: str = ""

    @property
    def dynamic(self) -> bool:
        """Whether it is not the quasi-static loop."""
        return self.kind != "quasi_static"


@dataclass(frozen=True)
class Circumstances:
    """What is drawn once for a case: the runs with a fault, a phase [rad], a frequency over the end of the band.

    A mass on a spring that is tuned to more than twice the end of the band would show as a mass, not as a resonance.
    """

    rig: Rig
    spoiled: frozenset[str]
    phase: float
    pitch: float

    @classmethod
    def draw(cls, rig: Rig, runs: list[str], rng: np.random.Generator) -> Circumstances:
        """One to three runs, any phase, 0.6 to 2 times the end of the band."""
        spoiled = frozenset(str(run) for run in rng.choice(runs, rng.integers(1, 4), replace=False))
        return cls(rig, spoiled, float(rng.uniform(0.0, 2 * np.pi)), float(rng.uniform(0.6, 2.0)))
