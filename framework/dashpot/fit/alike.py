"""Runs that were moved alike: repeats, the two sides of an axle, the same sweep at other preloads or amplitudes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.scored import ScoredRun

Array = NDArray[np.float64]

CORRELATION = 0.99


def moved_alike(runs: Sequence[ScoredRun]) -> list[list[int]]:
    """Numbers of runs, grouped: those of a group have the same sampling and proportional motions about their mean.

    What a model gets wrong about one of them it tends to get wrong about all, at the same moments.
    """
    groups: list[list[int]] = []
    shapes: list[Array] = []
    for number, run in enumerate(runs):
        shape = _shape(run)
        fits = (k for k, group in enumerate(groups) if _alike(run, shape, runs[group[0]], shapes[k]))
        found = next(fits, None)
        if found is None:
            groups.append([number])
            shapes.append(shape)
        else:
            groups[found].append(number)
    return groups


def _alike(run: ScoredRun, shape: Array, other: ScoredRun, known: Array) -> bool:
    return run.drive.dt == other.drive.dt and shape.size == known.size and bool(abs(shape @ known) > CORRELATION)


def _shape(run: ScoredRun) -> Array:
    path = run.drive.displacement - run.drive.displacement.mean()
    return path / (np.linalg.norm(path) or 1.0)
