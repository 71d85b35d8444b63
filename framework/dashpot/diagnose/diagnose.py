"""The diagnosis of a network on a dataset, its steps called in order."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

from dashpot.contract.cause import Cause
from dashpot.contract.chain import make_optimizer
from dashpot.contract.registry import Registry
from dashpot.data.dataset import Dataset
from dashpot.data.ends import one_force_each
from dashpot.diagnose.channel import Accused, accuse
from dashpot.diagnose.diagnosis import Diagnosis
from dashpot.diagnose.findings import Removal
from dashpot.diagnose.folds import FEWEST, Folds
from dashpot.diagnose.leftover import Leftover, look_for_leftover
from dashpot.diagnose.look import Doubt, Look, give_back_memory, look_at
from dashpot.diagnose.next_run import NextRun, next_run
from dashpot.diagnose.odds import agreed_by_chance
from dashpot.diagnose.polish import FEWER_STEPS, STEPS, known, polished
from dashpot.diagnose.pursue import Pursuer
from dashpot.diagnose.pursuit import NAMED, Pursuit
from dashpot.diagnose.refit import Kept, Refitter
from dashpot.diagnose.repeats import begun_together, doubts, kinds_of, repeats_of
from dashpot.diagnose.single_runs import (
    corrected,
    faults_beside,
    floor_of_corrected,
    names_of,
    put_right,
    runs_apart,
    share_explained,
    without_runs,
)
from dashpot.diagnose.table_rows import diagnosed, folds_with_rows, groups_of, records
from dashpot.diagnose.term import Model, first_model
from dashpot.diagnose.trials import Trials
from dashpot.fit.algebra import single_threaded_algebra
from dashpot.fit.api import Progress, Setting, fit_prepared, prepare, silent
from dashpot.fit.driven import NOTE
from dashpot.fit.grounding import free_curves
from dashpot.fit.kept_curves import kept_curves
from dashpot.fit.refine import Outcome
from dashpot.fit.result import FitResult
from dashpot.fit.scored import ScoredRun
from dashpot.fit.thinned import subsampled
from dashpot.kernel.workers import forked, threads
from dashpot.model.network import Group, NetworkSpec
from dashpot.text.problem import InputError, Place
from dashpot.triage.examine import examine

if TYPE_CHECKING:
    from dashpot.kernel.workers import Jobs

ATTEMPTS = 3
SAME = 1e-3  # of an error
SEARCHES = 2  # beside faults of single runs; the same faults come back after the first one
RELEVANCE = 0.0015  # share of the error by which a cause must matter


class Searched(NamedTuple):
    """The best structure, the faults of single training runs beside it, what is left beside both, and the runs that are
    apart because it is of these alone.
    """

    pursuit: Pursuit
    accused: Sequence[Accused]
    leftover: Leftover
    apart: tuple[str, ...]


@single_threaded_algebra
def diagnose(
    spec: NetworkSpec,
    dataset: Dataset,
    *,
    optimizer: str | None = None,
    options: Mapping[str, Any] | None = None,
    seed: int = 0,
    jobs: Jobs = 1,
    registry: Registry,
    progress: Progress | None = None,
    relevance: float = RELEVANCE,
) -> Diagnosis:
    """Triage the data, fit, search for the causes of the residual, and say how sure that is.

    A cause without which the training error grows by less than the share ``relevance`` is not named. Held-out runs take
    no part before the end. With a pool or a cluster as ``jobs`` it works in this process, on one thread.
    Raises InputError for a network that does not compile on these data, and where no plugin provides a cause.
    """
    if not registry.causes:
        raise InputError.at(Place(), "expected plugins with causes, got none", "`dashpot list plugins` says why")
    progress, jobs = progress or silent, threads(jobs)
    triage = examine(diagnosed(spec, one_force_each(dataset)))
    setting = prepare(triage.dataset, seed)
    method = make_optimizer(optimizer, registry.optimizers, options) if optimizer else None
    fit, restarts = fit_to_rest(
        lambda attempt: fit_prepared(spec, setting, method, seed + attempt, jobs, progress), setting.swing
    )
    causes = [registry.causes[word] for word in sorted(registry.causes)]
    groups = {run.name: run.cluster for run in triage.dataset.runs}
    sensors = {run.name: run.sensors.get("force", {}) for run in triage.dataset.runs}
    searched = setting.train if spec.joints else subsampled(setting.train)
    noise = math.inf if setting.floor.value is None else setting.floor.value
    refitter = Refitter(begun_together(searched, groups), registry.elements, sensors, jobs, noise=noise)
    watch = partial(_watch, progress, spec.name)
    pursuit, accused, leftover, apart = find_causes(refitter, fit, causes, groups, setting, relevance, seed, watch)
    give_back_memory()
    sound = {one.name: corrected(one, accused) for one in setting.train}
    runs = [run for run in sound.values() if run.name not in apart]
    if accused:
        setting = replace(setting, floor=floor_of_corrected(setting, accused))
    model = pursuit.best.model
    together = groups_of(runs, groups)
    whole, *less = all_polished(pursuit, runs, jobs)
    final = known(whole, model, runs, together, jobs, setting.floor.value)
    removals = [Removal(one.name, found) for one, found in zip(pursuit.without, less, strict=True)]
    last = without_runs(put_right(refitter, accused), apart)
    return Diagnosis(
        setting=setting,
        triage=replace(triage, remarks=(*triage.remarks, *restarts, *remarks_on(spec, triage.dataset, pursuit))),
        fit=fit,
        pursuit=pursuit,
        accused=tuple(accused),
        apart=apart,
        corrected=sound,
        final=final,
        removals=tuple(removals),
        leftover=leftover,
        next_runs=next_runs(last, pursuit) if not spec.joints else {},
        causes={cause.word: cause for cause in causes},
        relevance=relevance,
        seed=seed,
        jobs=jobs,
    )


def all_polished(pursuit: Pursuit, runs: Sequence[ScoredRun], jobs: int) -> list[NetworkSpec]:
    """The networks of the best structure and of those without each of its causes, at the least error of the runs."""
    models = [(pursuit.best.model, STEPS), *((one.scored.model, FEWER_STEPS) for one in pursuit.without)]
    return forked(lambda one: polished(one[0], runs, jobs, one[1]), models, jobs)


def find_causes(
    refitter: Refitter,
    fit: FitResult,
    causes: Sequence[type[Cause]],
    groups: Mapping[str, str],
    setting: Setting,
    relevance: float,
    seed: int,
    watch: Callable[[int, int], None],
) -> Searched:
    """The best structure, and the faults of single training runs beside it.

    The residual tests tell beforehand whether anything is missing. Where repeats of a run disagree, all runs may have
    that fault, as large as they differ, while causes are searched.
    Where runs are found at fault in the end, causes are searched again in the corrected runs, and the faults are found
    again beside these causes; where others come back, once more. Runs that depart from the others, for which nothing
    tells whether that is a fault or their conditions, take no part in a last search.
    """
    model = first_model(fit.declared, fit.fitted)
    if kept_curves(fit.fitted):
        # what a cause does to the slow loop, the curve must be able to give way to
        freed = polished(first_model(fit.declared, free_curves(fit.fitted)), refitter.runs, refitter.jobs)
        model = first_model(fit.declared, freed)
    folds, pairs = folds_with_rows(refitter.runs, groups), repeats_of(refitter, groups)
    refitter, seen = tested_beforehand(refitter, model, folds, pairs)
    recorded = replace(refitter, runs=records(refitter.runs), reduced=Kept())
    kinds = kinds_of(causes, seen)
    doubted = doubts(recorded, seen, kinds, groups) if recorded.runs else []

    def search(refitter: Refitter, folds: Folds, model: Model, doubted: Sequence[Doubt] = ()) -> Pursuit:
        return Pursuer(Trials(refitter, folds, doubted), causes, relevance, seed, watch).run(model)

    pursuit = search(refitter, folds, model, doubted)
    if not recorded.runs:
        return searched_without_apart(refitter, model, pursuit, [], groups, search)
    measured = {run.name: run for run in setting.dataset.runs if run.name in setting.split.train}

    def accuse_beside(look: Look) -> list[Accused]:
        return accuse(recorded, look, kinds, groups, measured, doubted, relevance)

    accused = faults_beside(refitter, pursuit.look, pairs, accuse_beside)
    for _ in range(SEARCHES if accused else 0):
        again = put_right(refitter, accused)
        pursuit = search(again, folds, again.fit(pursuit.best.model, pursuit.look.noise))
        before, accused = accused, faults_beside(refitter, pursuit.look, pairs, accuse_beside)
        if names_of(before) == names_of(accused):
            break
    return searched_without_apart(put_right(refitter, accused), model, pursuit, accused, groups, search)


def tested_beforehand(
    refitter: Refitter, model: Model, folds: Folds, pairs: Sequence[tuple[str, str]]
) -> tuple[Refitter, Look]:
    """The refitter that knows from residual tests whether a fitted network lacks anything, and the look of these."""
    seen = look_at(refitter, model, (), folds)
    return replace(refitter, missing=look_for_leftover(refitter, seen, pairs).notable()), seen


def searched_without_apart(
    refitter: Refitter,
    model: Model,
    pursuit: Pursuit,
    accused: Sequence[Accused],
    groups: Mapping[str, str],
    search: Callable[[Refitter, Folds, Model], Pursuit],
) -> Searched:
    """What a search without the runs ends with that depart from the others, in which nothing is left.

    The ``pursuit`` of all runs where none does, and where a cause would be lost that these runs alone show, and that
    explains them: it tells their conditions. Where nothing was found, they may have hidden it: then nothing has to be
    left beside what the search finds. ``model`` is the fitted network without causes.
    """
    look, pairs = replace(pursuit.look, model=pursuit.best.model), repeats_of(refitter, groups)
    left = look_for_leftover(refitter, look, pairs)
    apart, rest = runs_apart(refitter, look, left, pairs, groups)
    whole, known = Searched(pursuit, accused, left if apart else rest, ()), set(pursuit.best.model.names)
    if not apart or (known and rest.notable()):
        return whole
    others = without_runs(refitter, apart)
    folds, pairs = folds_with_rows(others.runs, groups), repeats_of(others, groups)
    others, _ = tested_beforehand(others, others.fit(model, look.noise), folds, pairs)
    found = search(others, folds, others.fit(look.model, look.noise))
    if rest.notable():
        rest = look_for_leftover(others, replace(found.look, model=found.best.model), pairs)
    lost = known - set(found.best.model.names)
    explained = lost and share_explained(refitter, apart, pursuit.best.model, found.best.model) >= NAMED
    return whole if explained or rest.notable() else Searched(found, accused, left, apart)


def fit_to_rest(fit: Callable[[int], FitResult], swing: float) -> tuple[FitResult, list[str]]:
    """The first fit that converged, by the number of the attempt, else the best; and what is to be said of it.

    A fit whose RMSE exceeds the ``swing`` (N) of the forces has converged to something absurd, and does not count.
    Where another start comes to the same error, more starts are not needed.
    """
    faults = []
    attempts: list[FitResult] = []
    while len(attempts) < ATTEMPTS and not _agree(attempts, swing):
        attempts.append(fit(len(attempts)))
        fault = _fault_of(attempts[-1], swing)
        if not fault:
            break
        faults.append(fault)
    best = min(attempts, key=lambda found: found.errors.train)
    if not faults:
        return best, []
    failed = "came to the same error" if _agree(attempts, swing) else "also failed"
    ending = failed if len(faults) == len(attempts) else "converged"
    return best, [
        f"The fit of {best.declared.name} did not converge ({faults[0]}); of {len(attempts)} starts the best "
        f"counts, the last one {ending}."
    ]


def _agree(attempts: Sequence[FitResult], swing: float) -> bool:
    """Whether the last two of several fits come to the same error, and to none that is absurd."""
    errors = [found.errors.train for found in attempts[-2:]]
    return len(errors) == 2 and max(errors) < min(swing, (1.0 + SAME) * min(errors))


def _fault_of(fit: FitResult, swing: float) -> str:
    if fit.ending != Outcome.CONVERGED.value:
        return fit.ending
    if fit.errors.train > swing:
        return (
            f"its RMSE is {fit.errors.train:.3g} N where the forces vary by {swing:.3g} N: check units and start values"
        )
    return ""


def limits_of(spec: NetworkSpec) -> list[str]:
    """What is not looked for in a network of this kind."""
    chains = [member.name for member in spec.root.members if isinstance(member, Group) and member.kind == "series"]
    found = [
        f"Between the parts of the series connection '{name}' no cause is looked for, only between its ends; "
        "give the node between them a name under 'nodes:'."
        for name in chains
    ]
    if spec.joints:
        found.append("No further run is simulated to tell causes apart: that is done for networks with two ends only.")
    return found


def settings_in_words(dataset: Dataset) -> list[str]:
    """What no parameter can follow, though groups of runs differ in it; a word for each run only names them."""
    found: dict[str, list[str]] = {}
    for run in dataset.runs:
        for key, word in run.notes.items():
            found.setdefault(key, []).append(word)
    return [
        f"The setting '{key}' is told in words ({', '.join(dict.fromkeys(words))}), which no parameter can follow: "
        "give numbers (clicks, 0 and 1) in their place to have a dependence on it looked for."
        for key, words in found.items()
        if key != NOTE and 1 < len(set(words)) < len(words)
    ]


def remarks_on(spec: NetworkSpec, dataset: Dataset, pursuit: Pursuit) -> list[str]:
    """What the diagnosis could not do, and how the search ended."""
    found = [*settings_in_words(dataset), *limits_of(spec)]
    found += [] if pursuit.ended else [f"The search was cut short after {pursuit.looks} looks at all candidates."]
    found += of_few_groups(pursuit.look.folds.groups)
    return [*found, *dict.fromkeys(pursuit.refused)]


def of_few_groups(groups: int) -> list[str]:
    """What so few independent training runs, each with its repeats, do not tell."""
    found = []
    if groups < FEWEST:
        found.append(
            f"With {groups} independent training run{'s' * (groups > 1)} parts of runs were left out in turn: "
            "whether the causes hold under other conditions is not known."
        )
    if 1.0 - agreed_by_chance(groups) < NAMED:
        found.append(
            f"So few agree by chance in one of {2**groups} cases: where something stays unexplained no cause is named "
            "before further runs are measured."
        )
    return found


def next_runs(refitter: Refitter, pursuit: Pursuit) -> dict[tuple[str, str], NextRun]:
    """The run to make next for every cause, and for each that stands in its place in more than one of ten draws."""
    found = {}
    for term, rival in pursuit.rivals:
        told = [name for name in pursuit.replacements(term.name) if name in rival.model.names]
        for word, _ in told:
            run = next_run(refitter, pursuit.best.model, rival.model, pursuit.look.measured_noise)
            if run is not None:
                found[term.cause.word, word] = run
    return found


def _watch(progress: Progress, name: str, looks: int, terms: int) -> None:
    progress(f"{name}: search for causes, round {looks}, {terms} found", None, None, None)
