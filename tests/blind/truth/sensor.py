"""A force channel that errs within its data sheet: differently in every run."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

GAIN, ZERO, DELAY = 1e-3, 1.5, 30e-6
DATA_SHEET = f"gain: {100.0 * GAIN:g} %, zero: {ZERO:g} N, delay: {1e6 * DELAY:g} us"


@dataclass(frozen=True)
class Channel:
    """Errors of one run: a gain, a zero [N], a delay [s]."""

    gain: float
    zero: float
    delay: float

    def shows(self, time: np.ndarray, force: np.ndarray) -> np.ndarray:
        """What the channel makes of a force; before the run, and after it, the specimen rested."""
        late = CubicSpline(time, force)(np.clip(time - self.delay, time[0], time[-1])) if self.delay else force
        return (1.0 + self.gain) * late + self.zero


EXACT = Channel(0.0, 0.0, 0.0)


def draw_channels(count: int, rng: np.random.Generator) -> tuple[Channel, ...]:
    """The errors of each run, the data sheet being their standard deviations."""
    return tuple(Channel(*(float(error) for error in row)) for row in rng.normal(0.0, (GAIN, ZERO, DELAY), (count, 3)))
