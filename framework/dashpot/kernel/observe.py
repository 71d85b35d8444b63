"""How a load cell shows the force of a specimen: smoothed, late, with a gain, an offset and hum, within a range."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from dashpot.kernel.lowpass import smoothed
from dashpot.kernel.spline import slopes

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Observation:
    """The force channel, one number per lane: what it shows of a force F is

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

    @property
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
        first sample it is held.
        """
        if self.plain:
            return force
        return np.minimum(self._unlimited(force, dt), self.largest[:, None])

    def _unlimited(self, force: Array, dt: float) -> Array:
        held = smoothed(np.maximum(force, self.least[:, None]), self.lag, dt)
        late = _shifted(held, np.broadcast_to(self.delay / dt, len(held)))
        shown = self.gain[:, None] * late + self.offset[:, None]
        if np.any(self.cosine) or np.any(self.sine):
            phase = 2.0 * np.pi * self.frequency[:, None] * dt * np.arange(force.shape[1])
            shown = shown + self.cosine[:, None] * np.cos(phase) + self.sine[:, None] * np.sin(phase)
        return shown

    def linear(self, rows: Array, dt: float) -> Array:
        """What one lane's channel shows of a force and of small changes of it, ``rows`` (1 + k, n).

        The changes are shifted along straight lines between samples, which is near enough for a search direction.
        """
        if self.plain:
            return rows
        force, changes = rows[0], rows[1:]
        at = np.arange(force.size) - self.delay[0] / dt
        held = smoothed(np.where(force > self.least[0], changes, 0.0), self.lag, dt)
        late = np.array([np.interp(at, np.arange(force.size), row) for row in held]).reshape(changes.shape)
        shown = self._unlimited(force[None], dt)[0]
        inside = shown < self.largest[0]
        return np.vstack([np.where(inside, shown, self.largest[0]), np.where(inside, self.gain[0] * late, 0.0)])


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
