"""Which runs a fit uses, and which ones are held out."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from dashpot.data.dataset import Dataset
from dashpot.data.run import Run

SHARE = 0.25
LIVELY = 0.8  # of the largest speed
FEWEST_GROUPS = 3
ALWAYS_TRAIN = ("quasi_static", "hold")
NO_CONDITIONS = ("warm_up",)  # settings that say how a run is scored, not under which conditions it was measured


@dataclass(frozen=True)
class Split:
    """Names of the runs that are fitted and of those held out; ``reason`` says why none are, if so."""

    train: tuple[str, ...]
    held_out: tuple[str, ...]
    reason: str = ""


def split_runs(dataset: Dataset, seed: int = 0) -> Split:
    """Hold out about a quarter of the dynamic runs, a run with its repeats; a dataset that says ``held_out`` decides.

    Only runs are held out whose motion lies inside what the others cover, at first those whose settings (amplitude,
    preload ...) the others still have, so that the held-out error tests the model and not its extrapolation. One of the
    fastest runs is among them, as much shows only there. Where every run goes beyond the others in some way a single
    one is held out nevertheless. The last repeats, which tell the noise floor, stay with the fitted runs.
    """
    if any(run.held_out is not None for run in dataset.runs):
        return _split(dataset, {run.cluster for run in dataset.runs if run.held_out})
    groups = list(dict.fromkeys(run.cluster for run in dataset.runs if run.kind not in ALWAYS_TRAIN))
    if len(groups) < FEWEST_GROUPS:
        return Split(
            tuple(run.name for run in dataset.runs),
            (),
            f"{len(groups)} independent dynamic runs are too few to hold one out; {FEWEST_GROUPS} would do",
        )
    order = [str(group) for group in np.random.default_rng(seed).permutation(groups)]
    order = _one_lively_first(dataset, order)
    chosen: set[str] = set()
    for wanted, allowed in _demands(max(1, round(SHARE * len(groups)))):
        for group in order:
            if len(chosen) < wanted and group not in chosen and _can_go(dataset, chosen | {group}, allowed):
                chosen.add(group)
    return _split(dataset, chosen)


Allowed = Callable[[list[Run], list[Run]], bool]


def _demands(share: int) -> tuple[tuple[int, Allowed], ...]:
    """How many groups to hold out under which demand on (kept, gone), strictest first."""
    return (
        (share, lambda kept, gone: _covers(kept, gone) and _levels(gone) <= _levels(kept)),
        (share, _covers),
        (1, lambda kept, gone: True),
    )


def _one_lively_first(dataset: Dataset, order: list[str]) -> list[str]:
    speeds = {group: _speed([run for run in dataset.runs if run.cluster == group]) for group in order}
    strict = _demands(1)[0][1]
    for group in order:
        if speeds[group] > LIVELY * max(speeds.values()) and _can_go(dataset, {group}, strict):
            return [group, *(other for other in order if other != group)]
    return order


def _split(dataset: Dataset, held_out: set[str]) -> Split:
    names = {
        flag: tuple(run.name for run in dataset.runs if (run.cluster in held_out) is flag) for flag in (True, False)
    }
    return Split(names[False], names[True])


def _can_go(dataset: Dataset, held_out: set[str], allowed: Allowed) -> bool:
    kept = [run for run in dataset.runs if run.cluster not in held_out]
    gone = [run for run in dataset.runs if run.cluster in held_out]
    noise_known = _repeated(kept) or not _repeated(gone)
    return any(run.kind not in ALWAYS_TRAIN for run in kept) and noise_known and allowed(kept, gone)


def _repeated(runs: list[Run]) -> bool:
    return len({run.cluster for run in runs}) < len({run.record for run in runs})


def _levels(runs: Iterable[Run]) -> set[tuple[str, float]]:
    conditions = [item for run in runs for item in run.settings.items() if item[0] not in NO_CONDITIONS]
    return {(key, round(value, 9)) for key, value in conditions}


def _covers(kept: list[Run], gone: list[Run]) -> bool:
    dynamic = [run for run in kept if run.kind not in ALWAYS_TRAIN]
    low, high = _reach(dynamic)
    low_gone, high_gone = _reach(gone)
    slack = 0.02 * (high - low)
    return low_gone >= low - slack and high_gone <= high + slack and _speed(gone) <= 1.02 * _speed(dynamic)


def _reach(runs: list[Run]) -> tuple[float, float]:
    return min(run.displacement.min() for run in runs), max(run.displacement.max() for run in runs)


def _speed(runs: list[Run]) -> float:
    return max(float(np.max(np.abs(np.gradient(run.displacement, run.sample_time)))) for run in runs)
