"""The periods of a falling sweep under a wheel: tops of the platform, and where the force crosses its static value."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.data.run import Run
from dashpot_metrics.contact_force import HIGHEST, LOWEST, static_force

Array = NDArray[np.float64]

CUT = 60.0  # Hz, of a low-pass without delay
MIDDLE = 0.25  # the static force lies at least so far inside the span of a period, or the period does not count
STEP, SMOOTHED = 0.1, 0.3  # Hz
FEWEST = 3  # periods


@dataclass(frozen=True, eq=False)
class Periods:
    """A run period by period: ``tops`` of the platform, and where the force ``falls`` and ``rises`` through its static
    value, all (k,) in s; ``force`` (n,) in N over that value at ``time`` (n,) in s.
    """

    time: Array
    force: Array
    tops: Array
    falls: Array
    rises: Array

    def whole(self) -> Iterator[tuple[float, float]]:
        """The tops at both ends of every period that counts, in s."""
        for start, stop in zip(self.tops, self.tops[1:], strict=False):
            if self.counts(start, stop):
                yield float(start), float(stop)

    def counts(self, start: float, stop: float) -> bool:
        """Whether the static force, zero here, lies in the middle of the span of a period."""
        first, last = np.searchsorted(self.time, (start, stop))
        low, high = self.force[first:last].min(), self.force[first:last].max()
        return bool(low < 0.0 < high and MIDDLE <= -low / (high - low) <= 1.0 - MIDDLE)


def periods_of(run: Run) -> Periods:
    """The periods of a run, force and path without what is above 60 Hz."""
    time = run.time
    force = low_passed(run.force, run.sample_time) - static_force(run)
    path = low_passed(run.displacement, run.sample_time)
    tops = _crossings(time, -np.gradient(path), rising=True)
    tops = tops[np.interp(tops, time, path) > path[0] + 0.25 * np.ptp(path)]
    return Periods(time, force, tops, _crossings(time, force, rising=False), _crossings(time, force, rising=True))


def least_angle(found: Iterable[tuple[float, float]]) -> float | None:
    """The least of smoothed angles between 6 and 18 Hz, of pairs of frequency in Hz and angle in degrees."""
    frequency, angle = np.array([*found]).reshape(-1, 2).T
    inside = (frequency >= LOWEST) & (frequency <= HIGHEST)
    if np.count_nonzero(inside) < FEWEST:
        return None
    return float(smoothed(frequency[inside], angle[inside]).min())


def smoothed(frequency: Array, angle: Array) -> Array:
    """Angles over an even grid of frequencies, under a Gaussian window."""
    from scipy.ndimage import gaussian_filter1d

    order = np.argsort(frequency)
    grid = np.arange(frequency.min(), frequency.max() + STEP, STEP)
    even = np.interp(grid, frequency[order], angle[order])
    return np.asarray(gaussian_filter1d(even, SMOOTHED / STEP, mode="nearest"))


def low_passed(signal: Array, sample_time: float) -> Array:
    """A signal (n,) without what is above 60 Hz, and without delay."""
    from scipy.signal import butter, sosfiltfilt

    if CUT * sample_time >= 0.5:
        return signal
    return np.asarray(sosfiltfilt(butter(4, CUT, fs=1.0 / sample_time, output="sos"), signal))


def _crossings(time: Array, signal: Array, rising: bool) -> Array:
    """The instants (k,) in s at which a signal goes through zero in one direction."""
    above = signal > 0.0 if rising else signal < 0.0
    at = np.flatnonzero(~above[:-1] & above[1:])
    share = signal[at] / (signal[at] - signal[at + 1])
    return np.asarray(time[at] + share * (time[at + 1] - time[at]))
