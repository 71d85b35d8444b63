"""Which runs and numbers a study is about, and what its patterns name."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.fit.api import Setting, prepare
from dashpot.fit.floor import noise_floor
from dashpot.fit.holdout import Split
from dashpot.fit.scored import ScoredRun
from dashpot.fit.study.declaration import ModelPlan, SearchStage, StudySpec
from dashpot.fit.study.patterns import chosen, nameless
from dashpot.text.problem import InputError, Place, nearest


def study_setting(study: StudySpec, dataset: Dataset) -> Setting:
    """The dataset made ready, split as the study wants it.

    InputError for a name that is no run's, and for a list of patterns that names no run at all.
    """
    setting = prepare(dataset, study.seed)
    runs = setting.dataset.runs
    refuse_unknown_runs(study, study.hold_out or (), runs)
    refuse_unknown_runs(study, tuple(study.weights), runs)
    refuse_idle_patterns(study)
    if study.hold_out is None:
        return setting
    groups = {run.group for run in runs if named(run, study.hold_out)}
    train = tuple(run.name for run in runs if run.group not in groups)
    if not train:
        raise InputError.at(Place(study.name), "'hold_out' leaves no run to train on", "name fewer runs")
    held_out = tuple(run.name for run in runs if run.group in groups)
    return replace(setting, split=Split(train, held_out, "" if held_out else "the study holds none out"))


def refuse_unknown_runs(study: StudySpec, patterns: Sequence[str], runs: Sequence[Run]) -> None:
    """InputError for a name that is no run's; some of several patterns with wildcards may name none."""
    wrong = nameless(patterns, [[run.name, run.record] if run.record else [run.name] for run in runs])
    if wrong:
        names = dict.fromkeys(run.record or run.name for run in runs)
        raise InputError.at(
            Place(study.name), f"no run is called '{wrong[0]}'", f"runs are: {', '.join(list(names)[:12])}"
        )


def refuse_idle_patterns(study: StudySpec) -> None:
    """InputError for a name that is no number's, and for a list of patterns that names no number of any model."""
    paths = {slot.path for plan in study.models for slot in plan.network.slots()}
    paths |= {f"{curve}[0]" for plan in study.models for curve in plan.network.data_curves()}
    searches = [stage for plan in study.models for stage in plan.stages if isinstance(stage, SearchStage)]
    for patterns in (study.profiles, *(stage.free for stage in searches)):
        wrong = nameless(patterns, [[path] for path in paths])
        if wrong:
            message = f"expected a pattern of parameters, got '{wrong[0]}', which names none"
            hint = nearest(wrong[0], paths) or f"parameters are: {', '.join(sorted(paths)[:12])}"
            raise InputError.at(Place(study.name), message, hint)


def named(run: Run | ScoredRun, patterns: Iterable[str]) -> bool:
    """Whether a pattern names a run, or the record that it is one force of."""
    return chosen(run.name, patterns) or bool(run.record and chosen(run.record, patterns))


def restricted(setting: Setting, plan: ModelPlan) -> Setting:
    """The setting with the runs alone that a model is about. InputError when there are none to train on."""
    names = {run.name for run in setting.dataset.runs if named(run, plan.runs)}
    split = setting.split
    train = tuple(name for name in split.train if name in names)
    if not train:
        raise InputError.at(Place(plan.name), f"the runs {', '.join(plan.runs)} leave '{plan.name}' none to train on")
    if len(names) == len(setting.dataset.runs):
        return setting
    dataset = setting.dataset.select(names)
    held_out = tuple(name for name in split.held_out if name in names)
    scored = {name: run for name, run in setting.scored.items() if name in names}
    return Setting(dataset, scored, Split(train, held_out, split.reason), noise_floor(dataset))


def run_weights(study: StudySpec, runs: list[ScoredRun]) -> list[float]:
    """The weight of each run: its own, times that of the first pattern that names it, else 1."""
    return [
        run.weight * next((w for pattern, w in study.weights.items() if named(run, [pattern])), 1.0) for run in runs
    ]
