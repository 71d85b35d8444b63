"""How a load cell shows the force of a specimen: smoothed, late, with a gain, an offset and hum, within a range."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from dashpot.kernel.lowpass import smoothed, smoothed_straight
from dashpot.kernel.spline import slopes

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Observation:
    """The force channel, one number per lane, gain and offset also (lanes, n): what it shows of a force F is

    min(gain * smoothed(max(F, least))(t - delay) + offset + hum(t), largest)

    with gain, offset (N), delay (s), the time constant ``lag`` (s) of a low-pass of first order, and hum with a
    ``frequency`` (Hz), a ``cosine`` and a ``sine`` (N) by the time of the run. A specimen that is pressed but not held
    lifts off instead of pulling: its ``least`` force is zero, whatever the channel makes of it. ``largest`` (N) is the
    end of the range of the channel: nothing above it is shown, whatever the force is.
    """

    gain: Array
    offset: Array
    delay: Array
    least: Array = field(default_factory=lambda: np.array([-np.inf]))
    lag: Array = field(default_factory=lambda: np.zeros(1))
    largest: Array = field(default_factory=lambda: np.array([np.inf]))
    frequency: Array = field(default_factory=lambda: np.zeros(1))
    cosine: Array = field(default_factory=lambda: np.zeros(1))
    sine: Array = field(default_factory=lambda: np.zeros(1))

    @cached_property
    def plain(self) -> bool:
        """Whether the channel shows the force as it is."""
        return not (
            np.any(self.delay)
            or np.any(self.offset)
            or np.any(self.gain != 1.0)
            or np.any(self.lag)
            or np.any(self.cosine)
            or np.any(self.sine)
            or np.any(self.least > -np.inf)
            or np.any(self.largest < np.inf)
        )

    def see(self, force: Array, dt: float) -> Array:
        """What the channel shows of ``force`` (lanes, samples).

        Between samples the force is the interpolating cubic spline, along which it is smoothed and shifted; before the
        first sample it is held, after the last one continued along its slope.
        """
        if self.plain:
            return force
        return np.minimum(self._unlimited(force, dt), self.largest[:, None])

    def _unlimited(self, force: Array, dt: float) -> Array:
        held = smoothed(np.maximum(force, self.least[:, None]), self.lag, dt)
        late = _shifted(held, np.broadcast_to(self.delay / dt, len(held)))
        shown = _by_lane(self.gain) * late + _by_lane(self.offset)
        if np.any(self.cosine) or np.any(self.sine):
            phase = 2.0 * np.pi * self.frequency[:, None] * dt * np.arange(force.shape[1])
            shown = shown + self.cosine[:, None] * np.cos(phase) + self.sine[:, None] * np.sin(phase)
        return shown

    def linear(self, rows: Array, dt: float) -> Array:
        """What one lane's channel shows of a force and of small changes of it, ``rows`` (1 + k, n).

        The changes are smoothed and shifted along straight lines between samples: near enough for a search direction.
        """
        if self.plain:
            return rows
        force, changes = rows[0], rows[1:]
        if self.least[0] > -np.inf:
            changes = np.where(force > self.least[0], changes, 0.0)
        smooth = smoothed_straight(changes, float(self.lag[0]), dt)
        late = _late(smooth, float(self.delay[0]) / dt, _straight, smooth[:, -1] - smooth[:, -2])
        shown = self._unlimited(force[None], dt)
        beyond = shown[0] >= self.largest[0]
        found = np.concatenate([shown, self.gain[0] * late])
        found[0, beyond], found[1:, beyond] = self.largest[0], 0.0
        return found


PLAIN = Observation(np.ones(1), np.zeros(1), np.zeros(1))


def _by_lane(numbers: Array) -> Array:
    return numbers if numbers.ndim == 2 else numbers[:, None]


def read_observation(paths: tuple[str, ...], values: Array) -> Observation:
    """The observation in a block of values (lanes, slots)."""

    def column(path: str, default: float) -> Array:
        return values[:, paths.index(path)] if path in paths else np.full(values.shape[0], default)

    return Observation(
        column("measurement.force.gain", 1.0),
        column("measurement.force.offset", 0.0),
        column("measurement.force.delay", 0.0),
        column("measurement.force.least", -np.inf),
        column("measurement.force.lag", 0.0),
        column("measurement.force.largest", np.inf),
        column("measurement.force.hum.frequency", 0.0),
        column("measurement.force.hum.cosine", 0.0),
        column("measurement.force.hum.sine", 0.0),
    )


def _shifted(forces: Array, samples: Array) -> Array:
    """Forces (lanes, n) late by so many samples (lanes,); NaN where either is not finite."""
    found = np.where((samples == 0.0)[:, None], forces, np.nan)
    late = np.flatnonzero((samples != 0.0) & np.isfinite(samples) & np.isfinite(forces).all(axis=1))
    if late.size:
        for number, slope in zip(late, slopes(forces[late]), strict=True):
            found[number] = _late(forces[number], float(samples[number]), partial(_cubic, slope), slope[-1])
    return found


def _late(values: Array, samples: float, along: Callable[[Array, float, slice], Array], ahead: Array) -> Array:
    """Values (..., n) late by so many samples, held before the first one and continued after the last one.

    Every place is the same ``part`` of a step behind the sample so many ``whole`` ones away: ``along`` gives the values
    there, for a slice of samples at the beginning of their steps. ``ahead`` (...) are the slopes at the last sample.
    """
    count, whole = values.shape[-1], math.floor(-samples)
    first = min(max(-whole, 0), count)
    stop = max(min(count - 1 - whole, count), first)
    found = np.empty_like(values)
    found[..., :first] = values[..., :1]
    found[..., first:stop] = along(values, -samples - whole, slice(first + whole, stop + whole))
    found[..., stop:] = _continued(values, ahead, np.arange(stop, count) - samples - (count - 1))
    return found


def _continued(values: Array, slope: Array, beyond: Array) -> Array:
    """Values (..., m) so many samples beyond the last one: along the last slope, within the range of the record.

    What comes early shows at the end of a record the motion after it. Held, it would miss it by far more than noise:
    a delay then looks like a mass and a damper, which look back.
    """
    ahead = values[..., -1:] + np.multiply.outer(slope, beyond)
    return np.clip(ahead, values.min(axis=-1, keepdims=True), values.max(axis=-1, keepdims=True))


def _straight(values: Array, part: float, begin: slice) -> Array:
    """Along the straight line between two samples."""
    return (1.0 - part) * values[..., begin] + part * values[..., _next(begin)]


def _cubic(slope: Array, force: Array, part: float, begin: slice) -> Array:
    """Along Hermite's cubic through two samples with these slopes."""
    square, cube = part**2, part**3
    return (
        (1.0 - 3.0 * square + 2.0 * cube) * force[begin]
        + (3.0 * square - 2.0 * cube) * force[_next(begin)]
        + (part - 2.0 * square + cube) * slope[begin]
        + (cube - square) * slope[_next(begin)]
    )


def _next(begin: slice) -> slice:
    return slice(begin.start + 1, begin.stop + 1)
