"""Solutions whose numerical error is within a tolerance: as many steps as that takes.

A solution is held against that with twice as many steps. Where forces are smooth the second one errs much less, and
the difference is the error of the first; where they bend sharply within a step (a stop, a gap, a reversal) both may err
by as much as the step is long, and twice the difference is a bound for the second.

Two solutions may be near to each other by chance, and both be wrong. So the changes before count as well. They do not
fall faster than the order of the steps allows; one that did tells less than the one before. And twice a change is all
that is still to come where the changes fall by a third or more each time; where they did not, no convergence is seen,
and the largest of the last three counts.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise, takewhile

import numpy as np
from numpy.typing import NDArray

from dashpot.data.excitation import Excitation
from dashpot.kernel.solution import HALVED, Solution, Status
from dashpot.kernel.system import CompiledSystem

Array = NDArray[np.float64]

TOLERANCE = 1e-3  # of the root mean square of a force: the numerical error that is allowed
FINEST = 256  # times as many steps as usual, at most
# where in a step forces bend is a matter of chance, so that the error may be larger than the change
CHANCE = 2.0
QUICKEST = 16.0  # by what a change falls where steps of the highest order, four, are halved
SEEN = 3  # changes, of which two say by how much they fall: one may fall by chance
# of a change is the next one, at most: then CHANCE times it is the sum of all that follow
FALLS = CHANCE / (1.0 + CHANCE)


@dataclass(frozen=True, eq=False)
class Bounded:
    """A ``solution`` of one lane with bounds (driven nodes,) in N of its numerical error: ``error`` of its root mean
    square, ``peak`` of its largest absolute value. ``refine`` is how many times as many steps as usual lie between two
    samples; with half of them the error is ``error``, too.
    """

    solution: Solution
    error: Array
    peak: Array
    refine: int


def solve_within(
    network: CompiledSystem,
    excitation: Excitation,
    values: Array | None = None,
    tolerance: float = TOLERANCE,
    finest: int = FINEST,
) -> Bounded:
    """One lane ``values`` (slots,), by default the numbers of the file, with an error of at most ``tolerance`` times
    the root mean square of each force, or with ``finest`` times as many steps as usual, a power of two.

    Where some step of the finest ones cannot be solved it is the finest solution that can, with its larger error.
    """
    refine, before = 1, network.solve(network.prepare(excitation), values)
    solved: Bounded | None = None
    changes: list[tuple[Array, Array]] = []
    while True:
        refine *= 2
        found = network.solve(network.prepare(excitation, refine), values)
        changes.append(_moved(found, before))
        error, peak = (bound(each) for each in zip(*changes, strict=True))
        allowed = tolerance * np.sqrt(np.mean(found.force[0] ** 2, axis=1))
        good, bounded = found.status[0] is Status.GOOD, Bounded(found, error, peak, refine)
        if good and before.status[0] is Status.GOOD:
            solved = bounded
        if good and (error <= allowed).all():
            return bounded
        if refine >= finest:
            return bounded if good or solved is None else solved
        before = found


def solve_at(network: CompiledSystem, excitation: Excitation, refine: int) -> Bounded:
    """The numbers of the file with ``refine`` times as many steps as usual, by hand."""
    found = network.solve(network.prepare(excitation, refine))
    error, peak = _moved(network.solve(network.prepare(excitation, 2 * refine)), found)
    return Bounded(found, bound([error]), bound([peak]), refine)


def steps_within(network: CompiledSystem, excitation: Excitation, values: Array, tolerance: float, finest: int) -> int:
    """How many times as many steps as usual, ``finest`` at most, keep the error of a lane (slots,) within the
    tolerance; 1 for a lane that cannot be solved, which no number of steps helps.
    """
    first = network.solve(network.prepare(excitation), values)
    if first.status[0] is Status.GOOD and told_within(first, tolerance):
        return 1
    found = solve_within(network, excitation, values, tolerance, 2 * finest)
    return found.refine // 2 if np.isfinite(found.error).all() else 1


def told_within(solution: Solution, tolerance: float = TOLERANCE) -> bool:
    """Whether the first lane is within the tolerance already by what its own long and short steps tell.

    They are held against each other as two solutions are in ``solve_within``, which need not be called then.
    """
    return told_error(solution) <= tolerance


def told_error(solution: Solution) -> float:
    """By what share of their root mean square the forces of the first lane may be off, as its own steps tell.

    It is infinite for forces that are zero and not solved without any error, and for those that are not finite.
    """
    moved, size = CHANCE * HALVED * solution.error[0], np.sqrt(np.mean(solution.force[0] ** 2, axis=1))
    shares = np.divide(moved, size, out=np.where(moved == 0.0, 0.0, np.inf), where=size > 0.0)
    return float(np.max(np.where(np.isfinite(shares), shares, np.inf), initial=0.0))


def bound(changes: Sequence[Array]) -> Array:
    """Of the error of the last solution, from the ``changes`` where the steps were halved, the last one at the end.

    A change that is not finite, of a solution that failed, tells of no other one.
    """
    finite = list(takewhile(lambda change: bool(np.isfinite(change).all()), reversed(changes)))[:SEEN]
    if not finite:
        return CHANCE * changes[-1]
    last = finite[0] if len(finite) == 1 else np.maximum(finite[0], finite[1] / QUICKEST)
    pairs = pairwise(finite)
    falls = np.all([after <= FALLS * before for after, before in pairs], axis=0) if len(finite) > 1 else True
    return CHANCE * np.where(falls, last, np.max(finite, axis=0))


def _moved(finer: Solution, before: Solution) -> tuple[Array, Array]:
    """How far the forces (driven nodes,) move where the steps are halved: root mean square and peak."""
    way = finer.force[0] - before.force[0]
    return np.sqrt(np.mean(way**2, axis=1)), np.max(np.abs(way), axis=1)
