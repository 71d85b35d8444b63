"""The work that a specimen takes up over closed cycles of its deflection."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.data.run import Run

Array = NDArray[np.float64]

# of the stroke: the motion has to go so far beyond the middle on either side, so that noise makes no cycles
_BEYOND = 0.1
# a testing machine of class 1 after ISO 7500-1 may show a force that differs by so much between loading and unloading
REVERSIBILITY = 0.015


@dataclass(frozen=True, eq=False)
class CycleWork:
    """``halves`` (n,): work in J that goes into the specimen from each passage of the middle to the next, n >= 2.

    Means per cycle: ``per_delay`` in W is the work that each second by which the force comes late takes away, to first
    order; ``moved`` in J is the deviation of the force from its mean times the way, without signs; ``period`` in s.
    """

    halves: Array
    per_delay: float
    moved: float
    period: float

    @property
    def mean(self) -> float:
        """The work per cycle in J: that of the mean half above the middle and of the mean half below."""
        return float(np.mean(self.halves[::2]) + np.mean(self.halves[1::2]))

    @property
    def freedom(self) -> int:
        """How many halves there are beyond the first one above and the first one below."""
        return self.halves.size - 2

    @property
    def variance(self) -> float:
        """Of a half about the mean of those on its side, J^2; 0 where there is no freedom."""
        apart = [side - np.mean(side) for side in (self.halves[::2], self.halves[1::2])]
        return float(sum(np.sum(each**2) for each in apart)) / max(self.freedom, 1)

    @property
    def share(self) -> float:
        """The variance of ``mean`` over that of a half."""
        return 1.0 / self.halves[::2].size + 1.0 / self.halves[1::2].size

    def explicable(self, delay: float) -> float:
        """The work per cycle in J by which an elastic specimen may seem to give back or take up work.

        Its channels may be apart by ``delay`` in s, and the loop may be as wide as a machine of class 1 makes it.
        """
        return delay * abs(self.per_delay) + REVERSIBILITY * self.moved

    @property
    def power_factor(self) -> float:
        """The work taken up as a share of what is moved to and fro, pi/2 times the sine of the loss angle."""
        return self.mean / self.moved


def work_of_cycles(run: Run) -> CycleWork | None:
    """The closed cycles of a run, between passages of the middle; None where there is none, or no force.

    The deflection is the same at both ends of each half, so that whatever only depends on it, and any constant force,
    drops out. A force that drifts evenly drops out of two halves that follow one another.
    """
    x, force, step = run.displacement, run.force, run.sample_time
    passages = _passages(x)
    if len(passages) < 3:
        return None
    force = force - np.mean(force)
    way = np.diff(x)
    middle = 0.5 * (force[1:] + force[:-1])
    halves = np.diff(_at(passages, middle * way))
    first, last = int(passages[0]), int(np.ceil(passages[-1])) + 1
    slope, rate = np.gradient(force, step)[first:last], np.gradient(x, step)[first:last]
    count = 0.5 * halves.size
    moved = float(np.sum(np.abs(middle * way)[first : last - 1])) / count
    if not moved > 0.0:
        return None
    period = float(passages[-1] - passages[0]) * step / count
    return CycleWork(halves, float(np.sum(slope * rate)) * step / count, moved, period)


def _at(passages: Array, parts: Array) -> Array:
    """The sum of the parts between samples up to passages that lie between samples."""
    return np.interp(passages, np.arange(parts.size + 1), np.append(0.0, np.cumsum(parts)))


def begin_of_motion(x: Array) -> int:
    """The sample at which a deflection (n,) first comes to its median."""
    above = x > np.median(x)
    return int(np.argmax(above != above[0]))


def _passages(x: Array) -> Array:
    """The places, in samples, at which the deflection passes its middle between being well below and well above.

    The way from the start of the record to its median, such as one up to a preload, is no part of the motion.
    """
    begin = begin_of_motion(x)
    return begin + _passages_within(x[begin:])


def _passages_within(x: Array) -> Array:
    low, high = np.quantile(x, (0.02, 0.98))
    middle, beyond = 0.5 * (low + high), _BEYOND * (high - low)
    if not beyond > 0.0:
        return np.zeros(0)
    side = np.where(x > middle + beyond, 1, np.where(x < middle - beyond, -1, 0))
    clear = np.flatnonzero(side)
    crossing = np.flatnonzero(np.diff(side[clear]))
    above = x > middle
    places = []
    for start, end in zip(clear[crossing], clear[crossing + 1], strict=True):
        at = start + int(np.flatnonzero(above[start:end] != above[start + 1 : end + 1])[-1])
        places.append(at + (middle - x[at]) / (x[at + 1] - x[at]))
    return np.array(places)
