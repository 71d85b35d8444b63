"""How a load cell sees the force of a specimen: not below what the rig can hold, late, with a gain, with an offset."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Observation:
    """Gain, offset (N), delay (s) and least force (N) of the force channel, one of each per lane.

    A specimen that is pressed but not held lifts off instead of pulling: its least force is zero.
    """

    gain: Array
    offset: Array
    delay: Array
    least: Array = field(default_factory=lambda: np.array([-np.inf]))

    @property
    def plain(self) -> bool:
        """Whether the channel shows the force as it is."""
        return not (np.any(self.delay) or np.any(self.offset) or np.any(self.gain != 1.0)
                    or np.any(self.least > -np.inf))  # fmt: skip

    def see(self, force: Array, dt: float) -> Array:
        """What the channel shows of ``force`` (lanes, samples).

        The delay is a shift along the interpolating cubic spline; before the first sample the force is held.
        """
        if self.plain:
            return force
        held = np.maximum(force, self.least[:, None])
        late = np.array([_shift(row, delay / dt) for row, delay in zip(held, self.delay, strict=True)])
        return self.gain[:, None] * late + self.offset[:, None]

    def linear(self, force: Array, changes: Array, dt: float) -> tuple[Array, Array, Array]:
        """What one lane's channel shows of ``force`` (n,) and of small ``changes`` (k, n) of it, and the force itself.

        The changes are shifted along straight lines between samples, which is near enough for a search direction.
        """
        if self.plain:
            return force, changes, force
        at = np.arange(force.size) - self.delay[0] / dt
        held = np.where(force > self.least[0], changes, 0.0)
        late = np.array([np.interp(at, np.arange(force.size), row) for row in held]).reshape(changes.shape)
        return self.see(force[None], dt)[0], self.gain[0] * late, force


def read_observation(paths: tuple[str, ...], values: Array) -> Observation:
    """The observation in a block of values (lanes, slots)."""

    def column(path: str, default: float) -> Array:
        return values[:, paths.index(path)] if path in paths else np.full(values.shape[0], default)

    return Observation(
        column("measurement.force.gain", 1.0),
        column("measurement.force.offset", 0.0),
        column("measurement.force.delay", 0.0),
        column("measurement.force.least", -np.inf),
    )


def _shift(force: Array, samples: float) -> Array:
    if samples == 0.0:
        return force
    if not (np.isfinite(samples) and np.isfinite(force).all()):
        return np.full(force.shape, np.nan)
    from scipy.interpolate import CubicSpline

    at = np.arange(force.size)
    return CubicSpline(at, force)(np.clip(at - samples, 0.0, force.size - 1.0))
