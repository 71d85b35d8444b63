"""What is left out at a time: groups of runs, and where there are few of them pieces of whole cycles.

A run is left out with its repeats. Of fewer than six groups each is cut into pieces, so that at least six parts are
left out in turn: they tell whether a law is there, but little of whether it holds in runs of other conditions. Of many
groups several are left out together.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.scored import ScoredRun

Array = NDArray[np.float64]

FEWEST, MOST = 6, 24  # parts that are left out in turn


@dataclass(frozen=True)
class Folds:
    """``names`` of what is left out in turn, of so many ``groups`` of runs.

    ``parts`` holds for each run the ends of its parts as shares of its length (k + 1,), and the numbers of their folds.
    """

    names: tuple[str, ...]
    groups: int
    parts: Mapping[str, tuple[tuple[float, ...], tuple[int, ...]]]

    def of_run(self, run: str, kept: int) -> list[tuple[int, slice]]:
        """The folds of a run, each with its part of so many ``kept`` samples."""
        ends, numbers = self.parts[run]
        edges = np.round(np.array(ends) * kept).astype(int).tolist()
        return [(number, slice(*ends)) for number, ends in zip(numbers, pairwise(edges), strict=True)]


def folds_of(runs: Sequence[ScoredRun], groups: Mapping[str, str]) -> Folds:
    """The folds of runs; ``groups`` names for each one the group of its repeats."""
    known = list(dict.fromkeys(groups[run.name] for run in runs))
    pieces = -(-FEWEST // len(known)) if len(known) < FEWEST else 1
    names: dict[str, int] = {}
    parts = {}
    for run in runs:
        path = run.drive.displacement[run.first :]
        edges = whole_cycles(path, pieces)
        group = known[known.index(groups[run.name]) % MOST]
        mine = [f"{group}, part {k + 1}" if pieces > 1 else group for k in range(len(edges) - 1)]
        numbers = tuple(names.setdefault(name, len(names)) for name in mine)
        parts[run.name] = tuple(edge / path.size for edge in edges), numbers
    return Folds(tuple(names), len(known), parts)


def whole_cycles(displacement: Array, pieces: int) -> list[int]:
    """Where a run (n,) may be cut into so many ``pieces`` at the most (k + 1,): at upward crossings of the mean."""
    if pieces == 1:
        return [0, displacement.size]
    side = displacement > np.mean(displacement)
    crossings = np.flatnonzero(~side[:-1] & side[1:]) + 1
    if crossings.size < pieces + 1:
        crossings = np.linspace(0, displacement.size, pieces + 1).astype(int)[1:-1]
    wanted = np.linspace(0, displacement.size, pieces + 1)[1:-1]
    nearest = {int(crossings[np.argmin(np.abs(crossings - at))]) for at in wanted}
    return sorted({0, *nearest, displacement.size})
