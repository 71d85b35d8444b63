"""How a load cell sees the force of a specimen: not below what the rig can hold, late, with a gain, with an offset."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

FEWEST = 5  # samples of a spline without a knot beside either end


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
        late = _shifted(held, np.broadcast_to(self.delay / dt, len(held)))
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


def _shifted(forces: Array, samples: Array) -> Array:
    """Forces (lanes, n) late by so many samples (lanes,); NaN where either is not finite."""
    found = np.where((samples == 0.0)[:, None], forces, np.nan)
    late = np.flatnonzero((samples != 0.0) & np.isfinite(samples) & np.isfinite(forces).all(axis=1))
    if late.size:
        for number, slope in zip(late, _slopes(forces[late]), strict=True):
            found[number] = _along(forces[number], slope, samples[number])
    return found


def _along(force: Array, slope: Array, samples: float) -> Array:
    # Hermite's cubic between the samples before and after each place
    place = np.clip(np.arange(force.size) - samples, 0.0, force.size - 1.0)
    begin = np.minimum(place.astype(int), force.size - 2)
    part = place - begin
    rise = force[begin + 1] - force[begin]
    bow = slope[begin] - rise, rise - slope[begin + 1]
    return force[begin] + part * (rise + (1.0 - part) * ((1.0 - part) * bow[0] + part * bow[1]))


def _slopes(forces: Array) -> Array:
    """The slopes (lanes, n) per sample of the cubic splines through forces without a knot beside either end."""
    from scipy.interpolate import CubicSpline
    from scipy.linalg import solve_banded

    count = forces.shape[1]
    if count < FEWEST:
        return CubicSpline(np.arange(count), forces, axis=1)(np.arange(count), 1)
    bands = np.ones((3, count))
    bands[1, 1:-1], bands[0, 1], bands[2, -2] = 4.0, 2.0, 2.0
    rise = np.diff(forces, axis=1)
    ends = 2.5 * rise[:, [0, -1]] + 0.5 * rise[:, [1, -2]]
    right = np.concatenate([ends[:, :1], 3.0 * (rise[:, 1:] + rise[:, :-1]), ends[:, 1:]], axis=1)
    return solve_banded((1, 1), bands, right.T, overwrite_b=True, check_finite=False).T
