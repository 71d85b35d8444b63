"""The motion that drives a specimen: the path between the samples, its rates, and its turning points."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.data.coherence import highest_coherent
from dashpot.data.interpolating import PIECE, QUINTIC, interpolated_rates
from dashpot.data.smoothing import best_rates, sensor_noise, smooth_path
from dashpot.text.problem import InputError, Place

Array = NDArray[np.float64]

FEWEST = 25  # samples that are smoothed, if that is asked for


@dataclass(frozen=True)
class Drive:
    """A uniformly sampled path: between two samples the cubic with the given positions and velocities.

    ``displacement`` (n,) m, ``velocity`` (n,) m/s, ``acceleration`` (n,) m/s^2, ``dt`` s. ``turn_step`` (k,) is the
    index of the sample that ends the step in which the path turns, ``turn_displacement`` (k,) where it turns; both in
    the order of time.
    """

    dt: float
    displacement: Array
    velocity: Array
    acceleration: Array
    turn_step: NDArray[np.int64]
    turn_displacement: Array

    @property
    def samples(self) -> int:
        """How many samples the path has."""
        return self.displacement.size


def refined_path(drive: Drive, parts: int, first: int, end: int) -> tuple[Array, Array, Array]:
    """Displacement, velocity and acceleration, ((end - first - 1) * parts + 1,) each, at equal parts of every step.

    The path goes from the sample ``first`` to the last one before ``end``. Between two samples it follows the quintic
    with the given positions, velocities and accelerations.
    """
    x, v, a = (each[first:end] for each in (drive.displacement, drive.velocity, drive.acceleration))
    dt = drive.dt
    far = x[1:] - x[:-1] - dt * (v[:-1] + 0.5 * dt * a[:-1])
    fast = dt * (v[1:] - v[:-1] - dt * a[:-1])
    bent = 0.5 * dt * dt * (a[1:] - a[:-1])
    third, fourth, fifth = 10 * far - 4 * fast + bent, -15 * far + 7 * fast - 2 * bent, 6 * far - 3 * fast + bent
    ascending = [x[:-1], dt * v[:-1], 0.5 * dt * dt * a[:-1], third, fourth, fifth]
    place, speed, bend = (_at_parts(ascending, order, parts) / dt**order for order in range(3))
    return np.append(place, x[-1]), np.append(speed, v[-1]), np.append(bend, a[-1])


def _at_parts(ascending: list[Array], order: int, parts: int) -> Array:
    # the polynomials of every step, or their derivatives, at equal parts of it: part by part, along all steps
    found = np.zeros((ascending[0].size, parts))
    for part in range(parts):
        powers = (power[part] for power in _powers(order, parts))
        found[:, part] += sum(each * power for each, power in zip(ascending, powers, strict=True) if power)
    return found.ravel()


@lru_cache
def _powers(order: int, parts: int) -> list[Any]:
    """The powers 0 to 5 at equal parts (parts,) of one, or their derivatives."""
    u = np.arange(parts) / parts
    powers = [np.polynomial.polynomial.polyder(row, order) if order else row for row in np.eye(6)]
    return [np.polynomial.polynomial.polyval(u, power) for power in powers]


def drive_from_path(dt: float, displacement: Array, velocity: Array, acceleration: Array) -> Drive:
    """The drive of a path whose rates are known. Raises InputError for fewer than two samples."""
    _refuse_single(displacement)
    step, place = find_turns(dt, displacement, velocity)
    return Drive(dt, displacement, velocity, acceleration, step, place)


def drive_from_samples(dt: float, displacement: Array, smooth: bool | None = None, force: Array | None = None) -> Drive:
    """The drive of a measured displacement.

    Rates come from an interpolating spline where the samples are clean, or the motion too fast to be smoothed, and from
    local polynomials, which also replace the displacement, where the sensor is noisy; ``smooth`` decides it by hand.
    Where the ``force`` (n,) in N was measured, what is too fast to show in it is noise. Raises InputError for fewer
    than two samples.
    """
    x = np.ascontiguousarray(displacement, dtype=float)
    _refuse_single(x)
    degree = QUINTIC
    if x.size > FEWEST:
        best = best_rates(x, sensor_noise(x), None if force is None else highest_coherent(x, force))
        degree = best.degree
        if smooth or (smooth is None and best.smooth):
            return drive_from_path(dt, *smooth_path(dt, x, best.half, best.narrower))
    return drive_from_path(dt, x, *interpolated_rates(dt, x, degree))


def _refuse_single(displacement: Array) -> None:
    if displacement.size < 2:
        raise InputError.at(
            Place(),
            f"expected a motion of two samples at least, got {displacement.size}",
            "give the samples of a whole record",
        )


def moved_drive(drive: Drive, change: Array) -> Drive:
    """The drive with a change (n,) of its displacement in m; the drive itself is not smoothed once more."""
    by = drive_from_samples(drive.dt, change)
    return drive_from_path(
        drive.dt,
        drive.displacement + by.displacement,
        drive.velocity + by.velocity,
        drive.acceleration + by.acceleration,
    )


def find_turns(dt: float, x: Array, v: Array) -> tuple[NDArray[np.int64], Array]:
    """Where the cubic path turns between samples: step (index of its end) and displacement, in the order of time."""
    pieces = [
        (first, *_turns(dt, x[first : first + PIECE + 1], v[first : first + PIECE + 1]))
        for first in range(0, x.size - 1, PIECE)
    ]
    steps, places = [first + step for first, step, _ in pieces], [place for *_, place in pieces]
    return np.concatenate(steps).astype(np.int64), np.concatenate(places)


def _turns(dt: float, x: Array, v: Array) -> tuple[NDArray[np.int64], Array]:
    rise = np.diff(x) / dt
    # velocity over u = 0..1: v0 + b u + c u^2
    v0, v1 = v[:-1], v[1:]
    c = 3.0 * (v0 + v1) - 6.0 * rise
    b = v1 - v0 - c
    roots = _roots(c, b, v0)
    step, which = np.nonzero((roots > 0.0) & (roots < 1.0))
    u = roots[step, which]
    place = x[:-1][step] + dt * u * (v0[step] + u * (b[step] / 2.0 + u * c[step] / 3.0))
    return step + 1, place


def _roots(c: Array, b: Array, a: Array) -> Array:
    # both real roots of a + b u + c u^2, ascending, NaN where there are none; stable for small c
    with np.errstate(all="ignore"):
        root = np.sqrt(b * b - 4.0 * a * c)
        q = -0.5 * (b + np.where(b < 0.0, -root, root))
        pair = np.column_stack([q / c, a / q])
    pair[np.isinf(pair)] = np.nan
    double = pair[:, 0] == pair[:, 1]
    pair[double] = np.nan
    return np.sort(pair, axis=1)
