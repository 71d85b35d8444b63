"""Runs that were moved alike: repeats, the two sides of an axle, the same sweep at other preloads or amplitudes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive
from dashpot.fit.scored import ScoredRun

Array = NDArray[np.float64]

CORRELATION = 0.99
SAME_MOTION = 0.02  # of the deviation and of the stroke: what a rig repeats


def moved_alike(runs: Sequence[ScoredRun]) -> list[list[int]]:
    """Numbers of runs, grouped: those of a group have the same sampling and proportional motions about their mean.

    What a model gets wrong about one of them it tends to get wrong about all, at the same moments.
    """
    swings = [_swing(run.drive.displacement) for run in runs]
    groups: list[list[int]] = []
    for number, run in enumerate(runs):
        fits = (group for group in groups if _alike(run.drive, runs[group[0]].drive, swings[number] * swings[group[0]]))
        found = next(fits, None)
        if found is None:
            groups.append([number])
        else:
            found.append(number)
    return groups


def repeated(runs: Sequence[ScoredRun]) -> list[list[int]]:
    """Numbers of runs, grouped: those of a group had the same motion, or were measured together.

    A model errs in all of them alike, and each group errs by itself.
    """
    groups: list[list[int]] = []
    for number, run in enumerate(runs):
        found = next((group for group in groups if _same(run, runs[group[0]])), None)
        if found is None:
            groups.append([number])
        else:
            found.append(number)
    return groups


def _same(one: ScoredRun, other: ScoredRun) -> bool:
    if one.record and one.record == other.record:
        return True
    x, y = one.drive.displacement, other.drive.displacement
    return x.size == y.size and bool(
        np.std(x - y) <= SAME_MOTION * np.std(x) and abs(np.mean(x - y)) <= SAME_MOTION * np.ptp(x)
    )


def _alike(one: Drive, other: Drive, both: float) -> bool:
    if one.dt != other.dt or one.samples != other.samples:
        return False
    x, y = one.displacement, other.displacement
    return bool(abs(x @ y - x.size * x.mean() * y.mean()) > CORRELATION * both > 0.0)


def _swing(path: Array) -> float:
    return float(np.linalg.norm(path - path.mean()))
