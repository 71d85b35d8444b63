"""The gain of a cause that held-out runs hardly show: runs that show it, or pieces of them, take turns."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from dashpot.assess.contest import Bench, Model
from dashpot.assess.gain import Gain, measure_gain
from dashpot.assess.mend import Mend
from dashpot.assess.misfits import crossed_misfits, misfits_of
from dashpot.fit.holdout import ALWAYS_TRAIN
from dashpot.fit.scored import ScoredRun

SLACK = 0.02
WEAKLY = 0.5  # as strong in held-out runs as in the others, or less
SHOWS = 0.2  # of the largest difference in any run
TURNS = 3
IN_TURNS = "runs that show it, held out in turns"
ON_PIECES = "pieces of runs, its size found on the other pieces"


def runs_that_show(before: Model, after: Model, bench: Bench) -> tuple[str, ...]:
    """Names of the fitted runs in which two models differ, most first, where they differ but weakly in unseen runs.

    Empty where these show the difference as well.
    """
    seen, unseen = (_differences(before, after, runs) for runs in (bench.runs, bench.unseen))
    if not unseen or np.mean(np.square(unseen)) > WEAKLY**2 * np.mean(np.square(seen)):
        return ()
    order = sorted(zip(seen, (run.name for run in bench.runs), strict=True), reverse=True)
    return tuple(name for difference, name in order if difference > SHOWS * max(seen))


def _differences(before: Model, after: Model, runs: Sequence[ScoredRun]) -> list[float]:
    """Root mean square in N of what a model changes in every run."""
    pairs = zip(misfits_of(before, runs), misfits_of(after, runs), strict=True)
    return [float(np.sqrt(np.mean((one - other) ** 2))) for one, other in pairs]


def gain_in_turns(
    bench: Bench, before: Model, after: Model, shown: Sequence[str], groups: Mapping[str, str], seed: int
) -> Gain | None:
    """The gain on dynamic runs that show a cause, each group of repeats judged by fits that did not see it.

    The first few of ``shown`` count. None where none can be missed, because no other shows it or reaches as far.
    """
    misfits: tuple[list, list] = [], []
    judged: list[ScoredRun] = []
    for mine in _groups_to_miss(bench, shown, groups):
        others = replace(bench, runs=[run for run in bench.runs if run not in mine])
        for model, found in zip((before, after), misfits, strict=True):
            found += misfits_of(others.fit(model.declared, model.fitted, None, model.mends), mine)
        judged += mine
    gain = measure_gain(*misfits, [run.drive.dt for run in judged], seed)
    return replace(gain, runs=IN_TURNS) if gain else None


def gain_on_pieces(
    before: Model, after: Model, runs: Sequence[ScoredRun], mends: Sequence[Mend], seed: int
) -> Gain | None:
    """The gain of faults on runs, their strengths found on other pieces of each run than those that are judged."""
    crossed = crossed_misfits(after, runs, mends)
    gain = measure_gain(misfits_of(before, runs), crossed, [run.drive.dt for run in runs], seed)
    return replace(gain, runs=ON_PIECES) if gain else None


def _groups_to_miss(bench: Bench, shown: Sequence[str], groups: Mapping[str, str]) -> list[list[ScoredRun]]:
    found = []
    for group in dict.fromkeys(groups.get(name, name) for name in shown):
        mine = [run for run in bench.runs if groups.get(run.name, run.name) == group]
        if _can_be_missed(mine, [run for run in bench.runs if run not in mine], shown):
            found.append(mine)
    return found[:TURNS]


def _can_be_missed(mine: Sequence[ScoredRun], others: Sequence[ScoredRun], shown: Sequence[str]) -> bool:
    if any(run.kind in ALWAYS_TRAIN for run in mine) or not any(run.name in shown for run in others):
        return False
    low, high = _reach(others)
    low_mine, high_mine = _reach(mine)
    slack = SLACK * (high - low)
    return low_mine >= low - slack and high_mine <= high + slack and _speed(mine) <= (1.0 + SLACK) * _speed(others)


def _reach(runs: Sequence[ScoredRun]) -> tuple[float, float]:
    paths = [run.drive.displacement for run in runs]
    return min(float(path.min()) for path in paths), max(float(path.max()) for path in paths)


def _speed(runs: Sequence[ScoredRun]) -> float:
    return max(float(np.abs(run.drive.velocity).max()) for run in runs)
