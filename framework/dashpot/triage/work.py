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
    """``taken`` (n,): work in J that goes into the specimen in each closed cycle.

    Means per cycle: ``per_delay`` in W is the work that each second by which the force comes late takes away, to first
    order; ``moved`` in J is the deviation of the force from its mean times the way, without signs.
    """

    taken: Array
    per_delay: float
    moved: float

    def explicable(self, delay: float) -> float:
        """The work per cycle in J by which an elastic specimen may seem to give back or take up work.

        Its channels may be apart by ``delay`` in s, and the loop may be as wide as a machine of class 1 makes it.
        """
        return delay * abs(self.per_delay) + REVERSIBILITY * self.moved

    @property
    def power_factor(self) -> float:
        """The work taken up as a share of what is moved to and fro, pi/2 times the sine of the loss angle."""
        return float(np.mean(self.taken)) / self.moved if self.moved > 0.0 else 0.0


def work_of_cycles(run: Run) -> CycleWork | None:
    """The closed cycles of a run, from one upward passage of the middle to the next; None where there is none.

    The deflection is the same at both ends, so that whatever only depends on it, and any constant force, drops out.
    """
    x, force, step = run.displacement, run.force, run.sample_time
    passages = _upward_passages(x)
    if len(passages) < 2:
        return None
    force = force - np.mean(force)
    way = np.diff(x)
    middle = 0.5 * (force[1:] + force[:-1])
    taken = np.diff(_at(passages, middle * way))
    first, last = int(passages[0]), int(np.ceil(passages[-1])) + 1
    slope, rate = np.gradient(force, step)[first:last], np.gradient(x, step)[first:last]
    count = len(passages) - 1
    moved = float(np.sum(np.abs(middle * way)[first : last - 1])) / count
    return CycleWork(taken, float(np.sum(slope * rate)) * step / count, moved)


def _at(passages: Array, parts: Array) -> Array:
    """The sum of the parts between samples up to passages that lie between samples."""
    return np.interp(passages, np.arange(parts.size + 1), np.append(0.0, np.cumsum(parts)))


def _upward_passages(x: Array) -> Array:
    """The places, in samples, at which the deflection passes its middle upwards after having been well below."""
    low, high = np.quantile(x, (0.02, 0.98))
    middle, beyond = 0.5 * (low + high), _BEYOND * (high - low)
    if not beyond > 0.0:
        return np.zeros(0)
    side = np.where(x > middle + beyond, 1, np.where(x < middle - beyond, -1, 0))
    clear = np.flatnonzero(side)
    rising = np.flatnonzero(np.diff(side[clear]) > 0)
    places = []
    for start, end in zip(clear[rising], clear[rising + 1], strict=True):
        at = start + int(np.flatnonzero((x[start:end] <= middle) & (x[start + 1 : end + 1] > middle))[-1])
        places.append(at + (middle - x[at]) / (x[at + 1] - x[at]))
    return np.array(places)
