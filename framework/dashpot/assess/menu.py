"""A small menu of further runs on the same rig, from which the next measurement is chosen."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from dashpot.assess.view import ModelView
from dashpot.text.quantity import pretty

Array = NDArray[np.float64]

PERIODS = 5.0
SAMPLES_PER_PERIOD = 40.0
LONGEST_TRIANGLE = 120.0  # s
SHARES = (0.15, 0.5, 0.85)  # of the reach
LADDER = (0.1, 0.33, 1.0)  # of the largest amplitude
BEYOND = (1.0, 2.0, 5.0)  # of the end of the measured band


@dataclass(frozen=True, eq=False)
class Proposal:
    """A run that could be made: ``words`` say it, ``displacement`` (n,) m every ``dt`` s is its motion."""

    words: str
    displacement: Array
    dt: float

    @property
    def seconds(self) -> float:
        """How long it takes."""
        return float(self.dt * self.displacement.size)


def runs_to_choose_from(view: ModelView) -> Iterator[Proposal]:
    """Sweeps over the measured band and beyond its end at several amplitudes and preloads, and slow triangles.

    None goes beyond the measured deflections, nor faster than 1.5 times the measured speed.
    """
    low, high = view.reach
    stroke = min(view.stroke, high - low)
    top = view.speed / (np.pi * stroke)
    for share, step, beyond in product(SHARES, LADDER, BEYOND):
        amplitude = 0.5 * step * stroke
        centre = float(np.clip(low + share * (high - low), low + amplitude, high - amplitude))
        stop = beyond * top
        if 2.0 * np.pi * stop * amplitude <= 1.5 * view.speed:
            yield _sweep(amplitude, centre, 0.1 * top, stop)
    for speed in (1e-3, 1e-2, 1e-1):
        if 2.0 * (high - low) / (speed * view.speed) < LONGEST_TRIANGLE:
            yield _triangle(low, high, speed * view.speed)


def _sweep(amplitude: float, centre: float, start: float, stop: float) -> Proposal:
    dt = 1.0 / (SAMPLES_PER_PERIOD * stop)
    duration = PERIODS / start
    time = np.arange(int(duration / dt)) * dt
    angle = 2.0 * np.pi * (start * time + 0.5 * (stop - start) / duration * time**2)
    words = (
        f"a sweep of {pretty(amplitude, 'm', 2)} about {pretty(centre, 'm', 3)} from {start:.2g} to {stop:.2g} Hz "
        f"in {duration:.2g} s"
    )
    return Proposal(words, centre + amplitude * np.minimum(time * start, 1.0) * np.sin(angle), dt)


def _triangle(low: float, high: float, speed: float) -> Proposal:
    half = (high - low) / speed
    dt = half / 1000.0
    x = high - np.abs(np.linspace(-1.0, 1.0, 2001)) * (high - low)
    return Proposal(f"a triangle over {pretty(high - low, 'm', 3)} at {pretty(speed, 'm/s', 2)}", x, dt)
