"""Faults of the force channel that single runs have: gain, zero, drift, hum; and a range that ends too early."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np

from .form import log_uniform
from .motion import SAMPLING

Forces = list[np.ndarray]


class Fault(ABC):
    """A form of a fault; `kind` is the cause word, `unit` that of its size, `runs` the numbers of the faulty runs."""

    kind: ClassVar[str]
    unit: ClassVar[str]
    runs: tuple[int, ...]

    @classmethod
    @abstractmethod
    def draw(cls, rng: np.random.Generator, count: int) -> Self:
        """A fault with random parameters among `count` runs."""

    @abstractmethod
    def shape(self, force: np.ndarray, number: int) -> np.ndarray:
        """What the channel adds to the sampled force of a run at size one, shape (samples,)."""

    def at_rms(self, forces: Forces, dynamic: list[bool], rms: float) -> tuple[float, Forces]:
        """The size, and the force added to each run, at which all dynamic runs together reach `rms` [N]."""
        added = [
            self.shape(force, number) if number in self.runs else np.zeros(force.size)
            for number, force in enumerate(forces)
        ]
        # a constant counts with its mean: an offset alternates nowhere
        pooled = float(np.sqrt(np.mean(np.concatenate([a for a, d in zip(added, dynamic, strict=True) if d]) ** 2)))
        size = rms / max(pooled, 1e-300)
        return size, [size * shape for shape in added]


def some_runs(rng: np.random.Generator, count: int) -> tuple[int, ...]:
    """One run, or two, neither the first nor the last where there are others."""
    inner = np.arange(1, count - 1) if count > 3 else np.arange(count - 1, count)
    chosen = rng.choice(inner, size=min(int(rng.integers(1, 3)), inner.size), replace=False)
    return tuple(int(number) for number in chosen)


@dataclass(frozen=True)
class FaultOfRuns(Fault):
    """A fault that some runs have, without parameters of its own."""

    runs: tuple[int, ...]

    @classmethod
    def draw(cls, rng, count):
        return cls(some_runs(rng, count))


class OneGain(FaultOfRuns):
    """Everything in proportion, the static force included."""

    kind = "gain"
    unit = "1"

    def shape(self, force, number):
        return force


class GrowingGain(FaultOfRuns):
    """A gain that grows by a fifth over the run."""

    kind = "gain"
    unit = "1"

    def shape(self, force, number):
        return force * np.linspace(0.9, 1.1, force.size)


class Zero(FaultOfRuns):
    """A constant."""

    kind = "offset"
    unit = "N"

    def shape(self, force, number):
        return np.ones(force.size)


class Steady(FaultOfRuns):
    """A zero that moves evenly."""

    kind = "drift"
    unit = "N/s"

    def shape(self, force, number):
        return np.arange(force.size) / SAMPLING


@dataclass(frozen=True)
class Settling(Fault):
    """A zero that settles, 1 - exp(-t / time), over more than half of the run."""

    kind = "drift"
    unit = "N"
    runs: tuple[int, ...]
    time: float

    @classmethod
    def draw(cls, rng, count):
        return cls(some_runs(rng, count), rng.uniform(3.0, 10.0))

    def shape(self, force, number):
        return -np.expm1(-np.arange(force.size) / SAMPLING / self.time)


@dataclass(frozen=True)
class Line(Fault):
    """A line at 50 Hz in every run, of random phase, its amplitude swinging by a part, with a third harmonic."""

    kind = "hum"
    unit = "N"
    runs: tuple[int, ...]
    phases: tuple[float, ...]
    swing: float
    third: float

    @classmethod
    def draw(cls, rng, count):
        phases = tuple(rng.uniform(0.0, 2 * np.pi, count).tolist())
        return cls(tuple(range(count)), phases, rng.uniform(0.0, 0.3), rng.uniform(0.0, 0.3))

    def shape(self, force, number):
        time = np.arange(force.size) / SAMPLING
        angle = 2 * np.pi * 50.0 * time + self.phases[number]
        level = 1.0 + self.swing * np.sin(2 * np.pi * 0.7 * time + self.phases[number])
        return level * (np.sin(angle) + self.third * np.sin(3 * angle))


class EndOfRange(Fault):
    """Either form; the size is the level [N], found by bisection, and every run has it."""

    kind = "clipping"
    unit = "N"

    @abstractmethod
    def beyond(self, force: np.ndarray, level: float) -> np.ndarray:
        """What the channel adds at a level."""

    def shape(self, force, number):
        raise NotImplementedError

    def at_rms(self, forces, dynamic, rms):
        top = max(float(force.max()) for force, d in zip(forces, dynamic, strict=True) if d)
        low, high = 0.3 * top, 1.2 * top
        for _ in range(60):
            level = 0.5 * (low + high)
            added = [self.beyond(force, level) for force in forces]
            if alternating_rms_of(added, dynamic) > rms:
                low = level
            else:
                high = level
        return level, added


@dataclass(frozen=True)
class Saturation(EndOfRange):
    """Nothing is lost well below the level; above, the rest is bent over within a width."""

    runs: tuple[int, ...]
    width: float

    @classmethod
    def draw(cls, rng, count):
        return cls(tuple(range(count)), log_uniform(rng, 2.0, 60.0))

    def beyond(self, force, level):
        return -self.width * np.logaddexp(0.0, (force - level) / self.width)


def alternating_rms_of(added: Forces, dynamic: list[bool]) -> float:
    """Root mean square over the dynamic runs, the mean of each taken out."""
    chosen = [force - force.mean() for force, d in zip(added, dynamic, strict=True) if d]
    return float(np.sqrt(np.mean(np.concatenate(chosen) ** 2)))


FORMS: dict[str, tuple[type[Fault], ...]] = {
    "gain": (OneGain, GrowingGain),
    "offset": (Zero,),
    "drift": (Steady, Settling),
    "hum": (Line,),
    "clipping": (Saturation,),
}
