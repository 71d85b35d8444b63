"""A sine of constant amplitude whose frequency moves from one end to the other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.rig import PrescribedPath
from dashpot_rigs.smooth_step import smooth_step

Array = NDArray[np.float64]

SPACINGS = ("linear", "log")


@dataclass(frozen=True)
class Sweep:
    """From `start` to `stop` (Hz) in `duration` (s), evenly in frequency or in its logarithm (`spacing`)."""

    start: float
    stop: float
    duration: float
    spacing: str
    sample_time: float

    @property
    def time(self) -> Array:
        """The instants (n,) in s."""
        return np.arange(round(self.duration / self.sample_time) + 1, dtype=float) * self.sample_time

    def turning(self) -> tuple[Array, Array, Array]:
        """Phase (rad), its rate (rad/s) and the rate of that (rad/s^2), each (n,)."""
        time = self.time
        if self.spacing == "linear" or self.start == self.stop:
            climb = (self.stop - self.start) / self.duration
            frequency, rise = self.start + climb * time, np.full_like(time, climb)
            cycles = self.start * time + 0.5 * climb * time**2
        else:
            pace = np.log(self.stop / self.start) / self.duration
            frequency = self.start * np.exp(pace * time)
            cycles, rise = (frequency - self.start) / pace, pace * frequency
        return 2.0 * np.pi * cycles, 2.0 * np.pi * frequency, 2.0 * np.pi * rise

    def path(self, amplitude: float, preload: float, fade: float) -> PrescribedPath:
        """preload + amplitude sin(phase) in m, the amplitude fading in over `fade` s."""
        level, level_rate, level_second = smooth_step(self.time, fade)
        phase, turn, turn_rate = self.turning()
        sine, cosine = np.sin(phase), np.cos(phase)
        return PrescribedPath(
            preload + amplitude * level * sine,
            amplitude * (level_rate * sine + level * turn * cosine),
            amplitude
            * (level_second * sine + 2.0 * level_rate * turn * cosine + level * (turn_rate * cosine - turn**2 * sine)),
        )


def require_sweep(start: float, stop: float, duration: float, spacing: str, sampling: float) -> None:
    """ValueError for a sweep that cannot be driven or sampled."""
    if spacing not in SPACINGS:
        raise ValueError(f"spacing: expected linear or log, got '{spacing}'")
    if min(start, stop, duration) <= 0.0:
        raise ValueError(f"start, stop and duration: expected more than 0, got {start:g}, {stop:g} Hz, {duration:g} s")
    if sampling < 20.0 * max(start, stop):
        raise ValueError(
            f"sampling: expected at least 20 samples a cycle of {max(start, stop):g} Hz, got {sampling:g} Hz"
        )
