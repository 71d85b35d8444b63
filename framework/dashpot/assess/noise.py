"""The colour of the noise of each run, and residuals made white by it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

ORDER = 8


@dataclass(frozen=True, eq=False)
class NoiseModel:
    """For every run the prediction filter (order + 1,) of its noise, scaled so that filtered noise has variance one."""

    filters: Mapping[str, Array]

    @property
    def flat(self) -> bool:
        """Whether the noise of every run is white."""
        return not any(coefficients[1:].any() for coefficients in self.filters.values())

    def whiten(self, run: str, signals: Array) -> Array:
        """Signals (..., n) of a run in units of their noise; the first samples miss their past and are set to zero."""
        if signals.size == 0:
            return signals.copy()
        # all rows in one: what runs over from one into the next is what is set to zero
        white = np.convolve(signals.ravel(), self.filters[run])[: signals.size].reshape(signals.shape)
        white[..., :ORDER] = 0.0
        return white


def flat_noise(deviations: Mapping[str, float]) -> NoiseModel:
    """White noise of the given standard deviations."""
    return NoiseModel({run: np.concatenate([[1.0 / s], np.zeros(ORDER)]) for run, s in deviations.items()})


def learn_noise(residuals: Mapping[str, Array], smallest: Mapping[str, float]) -> NoiseModel:
    """Autoregressive noise of order 8 of each run by Burg's method.

    ``smallest`` is a deviation in N below which nothing is believed: the resolution of the simulation and the record.
    Source: Burg, Maximum entropy spectral analysis, 37th SEG meeting (1967).
    """
    return NoiseModel({run: _scaled(residual, smallest[run]) for run, residual in residuals.items()})


def _scaled(residual: Array, smallest: float) -> Array:
    prediction = burg(residual, ORDER)
    deviation = float(np.sqrt(np.mean(np.convolve(residual, prediction, mode="valid") ** 2)))
    if deviation < smallest:
        return np.concatenate([[1.0 / smallest], np.zeros(ORDER)])
    return prediction / deviation


def burg(signal: Sequence[float] | Array, order: int) -> Array:
    """The prediction-error filter (order + 1,), first coefficient one, of a stationary signal."""
    forward = backward = np.asarray(signal, dtype=float)
    found = np.ones(1)
    for _ in range(order):
        forward, backward = forward[1:], backward[:-1]
        power = forward @ forward + backward @ backward
        reflection = -2.0 * (forward @ backward) / power if power > 0.0 else 0.0
        found = np.append(found, 0.0) + reflection * np.append(0.0, found[::-1])
        forward, backward = forward + reflection * backward, backward + reflection * forward
    return found
