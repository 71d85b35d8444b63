"""What a channel that records a force in coarse steps adds to it: a function of the force, neither noise nor a law."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

STEP_HARMONICS = 8  # of the error of rounding over a step; noise on the force takes away the higher ones first
LEVEL_ERROR = 0.05  # of a step by which levels may be off, as those that were written with few digits are


@dataclass(frozen=True, eq=False)
class Rounding:
    """``angle`` (n,) in rad: where in a step of the record the force of a model is, 2 pi a step.

    Over it the mean error of rounding, to the next step or to that below, is a sum of sines and its variance one of
    cosines: for any noise on the force, which decides how large they are.
    Source: B. Widrow, I. Kollar: Quantization Noise, 2008, chapters 4 and 5.
    """

    angle: Array
    coarse: bool = False

    @property
    def means(self) -> Array:
        """What the mean error of rounding consists of (STEP_HARMONICS, n); zero of a record that is not coarse."""
        return self.coarse * np.sin(self._angles)

    @property
    def variances(self) -> Array:
        """What its variance consists of beside a constant (STEP_HARMONICS, n), likewise."""
        return self.coarse * np.cos(self._angles)

    @property
    def _angles(self) -> Array:
        return np.outer(np.arange(1.0, STEP_HARMONICS + 1.0), self.angle)


def rounding_of(recorded: Array, modelled: Array) -> Rounding:
    """That of a recorded force (n,) N, of which a model has another one (n,) N.

    Not coarse are a record without steps, and steps smaller than the RMS of the residual: noise of that size makes the
    error of rounding independent of the force.
    """
    step, level = steps_of(recorded)
    if step <= np.sqrt(np.mean((recorded - modelled) ** 2)):
        return Rounding(np.zeros(recorded.size))
    return Rounding(2.0 * np.pi * (modelled - level) / step, coarse=True)


def steps_of(recorded: Array) -> tuple[float, float]:
    """The step between the levels of a record (n,) and one of these levels; a step of zero where there are none."""
    levels = np.unique(recorded)
    smallest = float(np.min(np.diff(levels), initial=np.inf))
    if not np.isfinite(smallest) or np.ptp(levels) > recorded.size * smallest:
        return 0.0, float(levels[0])
    count = np.concatenate([[0.0], np.cumsum(np.round(np.diff(levels) / smallest))])
    step, level = (float(number) for number in np.polyfit(count, levels, 1))
    off = np.max(np.abs(levels - level - step * count))
    return (step, level) if off < LEVEL_ERROR * step else (0.0, level)
