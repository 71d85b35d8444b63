"""Faults of single runs beside a model, the runs without them, and runs that depart from all others."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np

from dashpot.data.correction import Correction, corrected_run
from dashpot.data.noise import NoiseFloor
from dashpot.diagnose.channel import Accused
from dashpot.diagnose.leftover import Leftover, look_for_leftover
from dashpot.diagnose.look import Look, look_at
from dashpot.diagnose.pursuit import NAMED
from dashpot.diagnose.refit import Kept, Refitter
from dashpot.diagnose.repeats import Kind
from dashpot.diagnose.term import Model
from dashpot.fit.api import Setting
from dashpot.fit.floor import noise_floor
from dashpot.fit.scored import ScoredRun

ROUNDS = 3  # of faults and fits; the same faults come back in the second one


def faults_beside(
    refitter: Refitter,
    look: Look,
    pairs: Sequence[tuple[str, str]],
    accuse_beside: Callable[[Look], list[Accused]],
) -> list[Accused]:
    """The faults of single runs beside a model that they do not bend, those that are sure enough to be named.

    The model was fitted to the runs as they are. It is fitted to the corrected ones, and the faults are found again
    beside it, until the same ones come back.
    """
    accused = accuse_beside(look)
    if not accused:
        return []
    for _ in range(ROUNDS):
        right = put_right(refitter, accused)
        beside = look_at(right, right.fit(look.model, look.noise), (), look.folds)
        before, accused = accused, accuse_beside(beside)
        if names_of(before) == names_of(accused):
            break
    right = put_right(refitter, accused)
    left = look_for_leftover(right, replace(look, model=right.fit(look.model, look.noise)), pairs)
    return [one for one in (each.judged(left.share) for each in accused) if one.probability >= NAMED]


def runs_apart(
    refitter: Refitter, look: Look, left: Leftover, pairs: Sequence[tuple[str, str]], groups: Mapping[str, str]
) -> tuple[tuple[str, ...], Leftover]:
    """The runs that have what is ``left`` beside the model of a look, each by itself, and what is left in the others.

    All numbers are fitted to the others. None where most of the ``groups`` of runs would be among them: then it is
    told of most runs.
    """
    found, most, rest = list[str](), 0.5 * len({groups[run.name] for run in refitter.runs}), left
    while rest.notable() and rest.run:
        refitter, pairs = without_runs(refitter, {rest.run}), [pair for pair in pairs if rest.run not in pair]
        if len({groups[run.name] for run in refitter.runs}) <= most:
            return (), left.of_most_runs
        found.append(rest.run)
        rest = look_for_leftover(refitter, replace(look, model=refitter.fit(look.model, look.noise)), pairs)
    return tuple(found), rest


def share_explained(refitter: Refitter, apart: Collection[str], by: Model, beside: Model) -> float:
    """The share of what the model ``beside`` leaves of the runs that are ``apart`` that the model ``by`` explains.

    Beyond the noise, which is what the former leaves of all others, to which it was fitted.
    """

    def squares(model: Model) -> dict[str, float]:
        forces = refitter.forces(model.fitted)
        return {run.name: float(np.mean((run.force - forces[run.name])[run.first :] ** 2)) for run in refitter.runs}

    def mean(found: Mapping[str, float], names: Collection[str]) -> float:
        return float(np.mean([found[name] for name in names]))

    left, most = mean(squares(by), apart), squares(beside)
    noise = mean(most, most.keys() - set(apart))
    return (mean(most, apart) - left) / max(mean(most, apart) - noise, 1e-300)


def without_runs(refitter: Refitter, names: Collection[str]) -> Refitter:
    """A refitter of all other runs."""
    return replace(refitter, runs=[run for run in refitter.runs if run.name not in names], reduced=Kept())


def departure_in_words(apart: Sequence[str], left: Leftover) -> str:
    """What the report says of the runs that are ``apart``; what is ``left`` is that of the first one."""
    [first, *others] = apart
    which = f"Runs {', '.join(map(repr, apart))} depart" if others else f"Run '{first}' departs"
    return (
        f"{which} from what the others show: what is left {left.what}. That is a fault or comes from special "
        "conditions, and nothing proves which: causes and numbers are those of the other runs, and the error of all is "
        "told. Measure again, or leave out."
    )


def names_of(accused: Sequence[Accused]) -> set[tuple[str, Kind]]:
    """Which runs have which faults, whatever their strengths."""
    return {(one.run, one.kind) for one in accused}


def put_right(refitter: Refitter, accused: Sequence[Accused]) -> Refitter:
    """A refitter of the corrected runs."""
    return replace(refitter, runs=[corrected(run, accused) for run in refitter.runs], reduced=Kept())


def corrected(run: ScoredRun, accused: Sequence[Accused]) -> ScoredRun:
    """A run without its faults."""
    correction = correction_of(run.name, accused)
    return replace(run, force=correction.apply(run.force, run.drive.dt)) if correction else run


def correction_of(run: str, accused: Sequence[Accused]) -> Correction | None:
    """What puts a run right; None for a sound one."""
    found = None
    for one in (one for one in accused if one.run == run):
        found = found.then(one.correction) if found else one.correction
    return found


def floor_of_corrected(setting: Setting, accused: Sequence[Accused], without: str = "") -> NoiseFloor:
    """The noise floor of the training runs as the corrected dataset has them; one run may stay out."""
    dataset = setting.dataset.select(setting.split.train)
    runs = [
        corrected_run(run, correction) if (correction := correction_of(run.name, accused)) else run
        for run in dataset.runs
        if run.name != without
    ]
    return noise_floor(replace(dataset, runs=tuple(runs)))
