"""The misfit of several specimens, each in units of what a sample of it counts for."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.linear import Loss
from dashpot.fit.objective import Objective
from dashpot.fit.scored import ScoredRun

Array = NDArray[np.float64]
Result = TypeVar("Result")


@dataclass(frozen=True, eq=False)
class Member:
    """A specimen: its ``objective``, the ``loss`` that is refined of it; in it a sample counts for ``error`` in N."""

    objective: Objective
    loss: Loss
    error: float

    @property
    def size(self) -> int:
        """How many slots its network has."""
        return self.objective.network.start.size


class JointObjective:
    """The misfits of all specimens over the errors of their samples; slots stand specimen after specimen.

    A loss is the root mean square over all samples of all specimens, about 1 where each error is that of its fit.
    """

    def __init__(self, members: Sequence[Member]) -> None:
        self.members = tuple(members)
        self.runs: tuple[ScoredRun, ...] = tuple(run for member in members for run in member.objective.runs)
        self.total = sum(member.objective.total for member in members)
        ends = np.cumsum([member.size for member in members])
        self.slices = tuple(slice(int(end) - member.size, int(end)) for end, member in zip(ends, members, strict=True))

    def repeated(self) -> list[list[int]]:
        """Numbers of runs, grouped: those of a group are repeats of one another, of one specimen."""
        found, before = [], 0
        for member in self.members:
            found += [[before + number for number in group] for group in member.objective.repeated()]
            before += len(member.objective.runs)
        return found

    def losses(self, values: Array) -> Array:
        """The loss of every lane (lanes,) of slots (lanes, slots) in SI; a lane that fails costs infinity."""
        squares = sum(
            member.objective.total * (member.loss.losses(values[:, own]) / member.error) ** 2
            for member, own in zip(self.members, self.slices, strict=True)
        )
        return np.asarray(np.sqrt(squares / self.total))

    def linearise(self, values: Array, moves: Array, reduce: Callable[[int, Array], Result]) -> Iterator[Result]:
        """As that of an objective: runs are counted through; only moves that a specimen feels are simulated of it."""
        before = 0
        for member, own in zip(self.members, self.slices, strict=True):
            felt = np.flatnonzero(moves[:, own].any(axis=1))
            spread = partial(_spread, member.error, np.append(0, 1 + felt), 1 + len(moves), before, reduce)
            yield from member.loss.linearise(values[own], moves[felt][:, own], spread)
            before += len(member.objective.runs)


def _spread(
    error: float,
    places: NDArray[np.int64],
    count: int,
    before: int,
    reduce: Callable[[int, Array], Result],
    number: int,
    rows: Array,
) -> Result:
    """What is made of the rows of a run of one specimen, put at their places among those of all moves."""
    whole = np.zeros((count, rows.shape[1]))
    whole[places] = rows / error
    return reduce(before + number, whole)
