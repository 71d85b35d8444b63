"""A small menu of further runs on the same rig, from which the next measurement is chosen."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from dashpot.diagnose.view import ModelView
from dashpot.text.quantity import pretty

Array = NDArray[np.float64]

PERIODS = 5.0
SAMPLES_PER_PERIOD = 40.0
SAMPLES_PER_STROKE = 1000
LONGEST = 120.0  # s
SHARES = (0.15, 0.5, 0.85)  # of the reach
LADDER = (0.1, 0.33, 1.0)  # of the largest amplitude
BEYOND = (1.0, 2.0, 5.0)  # of the end of the measured band
FASTER = 1.5  # than measured


@dataclass(frozen=True)
class Sweep:
    """A sweep of an ``amplitude`` about a ``centre`` in m from ``start`` to ``stop`` in Hz within ``seconds``."""

    amplitude: float
    centre: float
    start: float
    stop: float
    seconds: float

    @property
    def words(self) -> str:
        """What to drive."""
        return (
            f"a sweep of {pretty(self.amplitude, 'm', 2)} about {pretty(self.centre, 'm', 3)} "
            f"from {self.start:.2g} to {self.stop:.2g} Hz in {self.seconds:.2g} s"
        )

    @property
    def dt(self) -> float:
        """The sample time in s."""
        return 1.0 / (SAMPLES_PER_PERIOD * self.stop)

    @property
    def displacement(self) -> Array:
        """The motion (n,) in m every ``dt`` s; it fades in over a period."""
        time = np.arange(int(self.seconds / self.dt)) * self.dt
        angle = 2.0 * np.pi * (self.start * time + 0.5 * (self.stop - self.start) / self.seconds * time**2)
        return self.centre + self.amplitude * np.minimum(time * self.start, 1.0) * np.sin(angle)

    def longer(self, times: int) -> Sweep:
        """The same, so many times as slow."""
        return replace(self, seconds=times * self.seconds)


@dataclass(frozen=True)
class Triangle:
    """Triangles between ``low`` and ``high`` in m at a ``speed`` in m/s."""

    low: float
    high: float
    speed: float
    count: int = 1

    @property
    def words(self) -> str:
        """What to drive."""
        what = "a triangle" if self.count == 1 else f"{self.count} triangles"
        return f"{what} over {pretty(self.high - self.low, 'm', 3)} at {pretty(self.speed, 'm/s', 2)}"

    @property
    def seconds(self) -> float:
        """How long it takes."""
        return 2.0 * self.count * (self.high - self.low) / self.speed

    @property
    def dt(self) -> float:
        """The sample time in s."""
        return (self.high - self.low) / self.speed / SAMPLES_PER_STROKE

    @property
    def displacement(self) -> Array:
        """The motion (n,) in m every ``dt`` s."""
        stroke = np.arange(2 * SAMPLES_PER_STROKE * self.count + 1) / SAMPLES_PER_STROKE
        return self.low + (self.high - self.low) * (1.0 - np.abs(stroke % 2.0 - 1.0))

    def longer(self, times: int) -> Triangle:
        """The same, so many times in succession."""
        return replace(self, count=times * self.count)


Proposal = Sweep | Triangle


def runs_to_choose_from(view: ModelView) -> Iterator[Proposal]:
    """Sweeps over the measured band and beyond its end at several amplitudes and preloads, and slow triangles.

    None goes beyond the measured deflections, nor faster than 1.5 times the measured speed: large amplitudes stop short
    of the end of a band that only small ones have reached.
    """
    low, high = view.reach
    stroke = min(view.stroke, high - low)
    for share, step, beyond in product(SHARES, LADDER, BEYOND):
        amplitude = 0.5 * step * stroke
        centre = float(np.clip(low + share * (high - low), low + amplitude, high - amplitude))
        fastest = FASTER * view.speed / (2.0 * np.pi * amplitude)
        end = min(view.highest_frequency, fastest)
        if beyond * end <= fastest:
            yield Sweep(amplitude, centre, 0.1 * end, beyond * end, PERIODS / (0.1 * end))
    for speed in (1e-3, 1e-2, 1e-1):
        triangle = Triangle(low, high, speed * view.speed)
        if triangle.seconds < LONGEST:
            yield triangle
