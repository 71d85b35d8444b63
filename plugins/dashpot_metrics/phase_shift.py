"""The least phase angle between a platform and the contact force of the wheel on it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.metric import Metric
from dashpot.data.run import Run
from dashpot_metrics.contact_force import HIGHEST, LOWEST, is_inspection, static_force

Array = NDArray[np.float64]

CUT = 60.0  # Hz, of a low-pass without delay
MIDDLE = 0.25  # the static force lies at least so far inside the span of a period, or the period does not count
STEP, SMOOTHED = 0.1, 0.3  # Hz


class PhaseShift(Metric):
    """The least angle, between 18 and 6 Hz, from the top of the platform to the trough of the contact force.

    The trough is the middle between the falling and the next rising crossing of the static force. At least 35 degrees
    are wanted. The angle is taken from the last top before the trough, however early the force fell: who takes the
    first two crossings after a top finds the crest in place of the trough below 90 degrees, and 180 degrees less the
    angle. After EGEA SPECSUS2018 as it is told in public accounts; the original was not seen.
    """

    word, unit = "phase_shift", "deg"

    def measure(self, run: Run) -> float | None:
        """The angle of a falling sweep under a wheel; None too where no period counts."""
        if not is_inspection(run):
            return None
        frequency, angle = angles(run)
        inside = (frequency >= LOWEST) & (frequency <= HIGHEST)
        if np.count_nonzero(inside) < 3:
            return None
        return float(smoothed(frequency[inside], angle[inside]).min())


def angles(run: Run) -> tuple[Array, Array]:
    """Frequency (k,) in Hz and phase angle (k,) in degrees of every period that counts."""
    static, time = static_force(run), run.time
    force = low_passed(run.force, run.sample_time) - static
    path = low_passed(run.displacement, run.sample_time)
    tops = _crossings(time, -np.gradient(path), rising=True)
    tops = tops[np.interp(tops, time, path) > path[0] + 0.25 * np.ptp(path)]
    falls, rises = _crossings(time, force, rising=False), _crossings(time, force, rising=True)
    after = np.searchsorted(rises, falls)
    falls, rises = falls[after < rises.size], rises[after[after < rises.size]]
    troughs = 0.5 * (falls + rises)
    found = []
    for trough in troughs:
        last = int(np.searchsorted(tops, trough, side="right")) - 1
        if 0 <= last < tops.size - 1 and _counts(force, time, tops[last], tops[last + 1]):
            period = tops[last + 1] - tops[last]
            found.append((1.0 / period, 360.0 * (trough - tops[last]) / period))
    return tuple(np.array(found).reshape(-1, 2).T)  # type: ignore[return-value]


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


def _counts(force: Array, time: Array, start: float, stop: float) -> bool:
    """Whether the static force, zero here, lies in the middle of the span of a period."""
    first, last = np.searchsorted(time, (start, stop))
    low, high = force[first:last].min(), force[first:last].max()
    return bool(low < 0.0 < high and MIDDLE <= -low / (high - low) <= 1.0 - MIDDLE)
