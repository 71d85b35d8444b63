"""The gain of a cause that no held-out run shows: runs that show it take turns in being held out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from dashpot.assess.contest import Bench, Model
from dashpot.assess.gain import Gain, measure_gain
from dashpot.assess.misfits import misfits_of
from dashpot.assess.screen import Finding
from dashpot.fit.holdout import ALWAYS_TRAIN
from dashpot.fit.scored import ScoredRun

SLACK = 0.02
SHOWS = 0.05  # of the largest effect in any run


def runs_that_show(finding: Finding, bench: Bench, model: Model) -> set[str]:
    """Names of the runs in which a finding acts; all of them for a finding inside a network with nodes."""
    view = bench.view(model)
    if finding.candidate.site is not None:
        return set(view.runs)
    chosen, effects = list(finding.chosen), {}
    for name, run in view.scored.items():
        columns = np.atleast_2d(finding.candidate.suspect.columns(view, name))[chosen, run.first :]
        effects[name] = float(np.sqrt(np.mean((finding.strengths @ columns) ** 2)))
    return {name for name, effect in effects.items() if effect > SHOWS * max(effects.values())}


def gain_in_turns(
    bench: Bench, before: Model, after: Model, shown: set[str], groups: Mapping[str, str], seed: int
) -> Gain | None:
    """The gain on dynamic runs that show a cause, each group of repeats judged by fits that did not see it.

    None where no such group can be missed, because no other shows the cause or reaches as far.
    """
    misfits: tuple[list, list] = [], []
    judged: list[ScoredRun] = []
    for group in sorted({groups.get(run.name, run.name) for run in bench.runs if run.name in shown}):
        mine = [run for run in bench.runs if groups.get(run.name, run.name) == group]
        others = replace(bench, runs=[run for run in bench.runs if run not in mine])
        if not _can_be_missed(mine, others.runs, shown):
            continue
        for model, found in zip((before, after), misfits, strict=True):
            found += misfits_of(others.fit(model.declared, model.fitted, None, model.mends), mine)
        judged += mine
    return measure_gain(*misfits, [run.drive.dt for run in judged], seed)


def _can_be_missed(mine: Sequence[ScoredRun], others: Sequence[ScoredRun], shown: set[str]) -> bool:
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
