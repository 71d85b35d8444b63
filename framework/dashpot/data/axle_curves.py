"""Springs, friction and anti-roll bar of an axle from quasi-static runs of its wheels, in phase and anti-phase."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .backbone import interior_width
from .loop import Loop, mean_loop

Array = NDArray[np.float64]

INTERIOR = 0.8  # share of a curve, around its middle, in which slopes are taken


@dataclass(frozen=True, eq=False)
class SlowCurve:
    """Elastic force (m,) N over deflection (m,) m, dry friction taken out; ``half_width`` (m,) N of the loop.

    friction: N, the half width of the fully open loop, less what dampers do at this speed; speed: m/s, at which most of
    the way was travelled.
    """

    deflection: Array
    force: Array
    half_width: Array
    friction: float
    speed: float

    @property
    def rate(self) -> float:
        """Slope in the middle of the travel, N/m."""
        return _slope(self.deflection, self.force, INTERIOR)

    def at(self, deflection: Array) -> Array:
        """The force N at other deflections m; beyond the ends the curve goes on straight."""
        end = max(2, self.deflection.size // 8)
        slopes = [np.polyfit(self.deflection[part], self.force[part], 1)[0] for part in (np.s_[:end], np.s_[-end:])]
        inside = np.interp(deflection, self.deflection, self.force)
        below, above = (
            np.minimum(deflection - self.deflection[0], 0.0),
            np.maximum(deflection - self.deflection[-1], 0.0),
        )
        return inside + slopes[0] * below + slopes[1] * above


@dataclass(frozen=True, eq=False)
class SlowAxle:
    """A slow run of an axle: vertical motions m of the two wheels, and the wheel contact forces N, each (n,)."""

    wheels: tuple[Array, Array]
    forces: tuple[Array, Array]
    sample_time: float


@dataclass(frozen=True, eq=False)
class AxleCurves:
    """``suspension`` of the left and of the right wheel in phase; ``roll``: half the difference of the two forces over
    half that of the two motions, in anti-phase; ``bar_rate`` N/m and ``bar_friction`` N of the anti-roll bar, over the
    difference of the two motions. The last three are None without a run in anti-phase."""

    suspension: tuple[SlowCurve, SlowCurve]
    roll: SlowCurve | None = None
    bar_rate: float | None = None
    bar_friction: float | None = None


def slow_curve(deflection: Array, force: Array, sample_time: float, damping: float = 0.0) -> SlowCurve:
    """The elastic curve of a slow loop, deflection (n,) m and force (n,) N, without the bias of its ends.

    ``damping`` in N*s/m is the slope at rest of dampers beside the friction: their share of the loop's width at this
    speed is not friction. Raises ValueError for a record that does not turn round.
    """
    loop = mean_loop(deflection, force)
    if not loop.complete:
        raise ValueError("expected a slow test in both directions, got one direction only; drive it back as well")
    speed = float(np.ptp(deflection) * _strokes(deflection) / (deflection.size * sample_time))
    return SlowCurve(
        loop.deflection, loop.middle - end_bias(loop), loop.half_width, interior_width(loop) - damping * speed, speed
    )


def end_bias(loop: Loop) -> Array:
    """What friction adds to the mid line near the two ends of a loop (m,), N.

    After a reversal one branch is on its way from one friction limit to the other, while the opposite branch arrives
    there fully developed. So the mid line is off by exactly what the half width is short of its interior value: below
    at the lower end, above at the upper one. No law of friction is assumed, but that it is the same all along.
    """
    open_width = interior_width(loop)
    short = np.maximum(open_width - loop.half_width, 0.0)
    places = np.arange(short.size)
    is_open = np.flatnonzero(short == 0.0)
    first, last = (is_open[0], is_open[-1]) if is_open.size else (short.size // 2, short.size // 2)
    return np.where(places > last, short, 0.0) - np.where(places < first, short, 0.0)


def axle_curves(in_phase: SlowAxle, anti_phase: SlowAxle | None = None, damping: float = 0.0) -> AxleCurves:
    """Suspension curves from a slow run in phase; from one in anti-phase also the anti-roll bar.

    In anti-phase each wheel stands on its own suspension curve, which the run in phase knows; what is left turns the
    bar, whose ends move against each other by the difference of the wheel motions. ``damping`` as in ``slow_curve``.
    """
    dt = in_phase.sample_time
    suspension = tuple(slow_curve(z, f, dt, damping) for z, f in zip(in_phase.wheels, in_phase.forces, strict=True))
    if anti_phase is None:
        return AxleCurves(suspension)  # type: ignore[arg-type]
    wheel, force = (0.5 * (pair[0] - pair[1]) for pair in (anti_phase.wheels, anti_phase.forces))
    roll = slow_curve(wheel, force, anti_phase.sample_time, damping)
    middle = float(np.mean([[motion.min(), motion.max()] for motion in anti_phase.wheels]))
    springs = 0.5 * (suspension[0].at(middle + roll.deflection) - suspension[1].at(middle - roll.deflection))
    rate = _slope(2.0 * roll.deflection, roll.force - springs, INTERIOR)
    friction = roll.friction - float(np.mean([side.friction for side in suspension]))
    return AxleCurves(suspension, roll, rate, friction)  # type: ignore[arg-type]


def behind_tire(platform: Array, force: Array, tire: SlowCurve) -> Array:
    """The motion of a wheel (n,) m, up to a constant, from that of its platform (n,) m and the contact force (n,) N.

    The deflection of the tire is read from its own slow curve, whose force has to rise and to hold all forces of the
    run; the friction of the tire is left out. Raises ValueError for forces outside.
    """
    if force.min() < tire.force[0] or force.max() > tire.force[-1]:
        raise ValueError(
            f"expected contact forces within the tire's curve, {tire.force[0]:.4g} to {tire.force[-1]:.4g} N, got "
            f"{force.min():.4g} to {force.max():.4g} N; measure the tire over the whole range of loads"
        )
    return platform - np.interp(force, np.maximum.accumulate(tire.force), tire.deflection)


def _strokes(deflection: Array) -> float:
    return float(np.sum(np.abs(np.diff(deflection[:: max(1, deflection.size // 400)]))) / np.ptp(deflection))


def _slope(places: Array, values: Array, share: float) -> float:
    low, high = np.quantile(places, [0.5 - share / 2.0, 0.5 + share / 2.0])
    inside = (places >= low) & (places <= high)
    return float(np.polyfit(places[inside], values[inside], 1)[0])
