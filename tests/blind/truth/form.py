"""What a functional form of a hidden effect has to offer."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import ClassVar, Self

import numpy as np

from .motion import Motion, at_samples

Forces = list[np.ndarray]


def log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    """A number whose logarithm is uniform between those of `low` and `high`."""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def alternating_rms(forces: Sequence[np.ndarray]) -> float:
    """Pooled root mean square of several runs at the sample times, the mean of each run taken out."""
    sampled = [at_samples(force) for force in forces]
    return float(np.sqrt(np.mean(np.concatenate([force - force.mean() for force in sampled]) ** 2)))


class DoesNotShow(ValueError):
    """A form that adds no force in any of the dynamic runs, such as a stop that none of them reaches."""


class Form(ABC):
    """One functional form of one effect.

    `kind` is the cause word it stands for, `unit` the unit of its size.
    """

    kind: ClassVar[str]
    unit: ClassVar[str]

    @classmethod
    @abstractmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        """A form with random shape parameters."""

    @abstractmethod
    def at_rms(self, motions: list[Motion], carried: Forces, dynamic: list[bool], rms: float) -> tuple[float, Forces]:
        """The size, and the force added to each run, at which the dynamic runs reach `rms` [N] on top of `carried`.

        Raises DoesNotShow where none of these runs shows it.
        """


class Proportional(Form):
    """A form whose force grows in proportion to its size."""

    @abstractmethod
    def shape(self, motion: Motion) -> np.ndarray:
        """The force at size one, shape (steps,)."""

    def at_rms(self, motions: list[Motion], carried: Forces, dynamic: list[bool], rms: float) -> tuple[float, Forces]:
        shapes = [self.shape(motion) for motion in motions]
        shown = alternating_rms([shape for shape, counts in zip(shapes, dynamic, strict=True) if counts])
        if shown == 0.0:
            raise DoesNotShow(f"{self} does not show in the dynamic runs")
        size = rms / shown
        return size, [size * shape for shape in shapes]
