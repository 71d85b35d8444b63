"""The diagnosis of a network on a dataset, its steps called in order."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from dashpot.assess.contest import Bench, Model
from dashpot.assess.court import MOST_LOOKS, SMALLEST_GAIN, Court, Effort
from dashpot.assess.diagnosis import Diagnosis
from dashpot.assess.leftover import look_for_leftover
from dashpot.assess.mend import mended
from dashpot.assess.misfit import describe_misfit
from dashpot.assess.misfits import residuals_of
from dashpot.assess.pursuit import Pursuer, Pursuit
from dashpot.assess.telling import Telling, telling_run
from dashpot.assess.triage.examine import examine
from dashpot.assess.untried import remarks_on_untried, with_untried
from dashpot.assess.verdict import give_verdict
from dashpot.assess.view import view_of
from dashpot.contract.chain import make_optimizer
from dashpot.contract.registry import Registry
from dashpot.data.dataset import Dataset
from dashpot.data.ends import one_force_each
from dashpot.fit.algebra import single_threaded_algebra
from dashpot.fit.api import Progress, Setting, fit_prepared, measure_errors, prepare, silent
from dashpot.fit.coordinates import search_coordinates
from dashpot.fit.objective import Objective
from dashpot.fit.refine import Outcome
from dashpot.fit.result import FitResult, with_intervals
from dashpot.fit.uncertainty import assess_uncertainty
from dashpot.kernel.network import compile_network
from dashpot.model.network import Group, NetworkSpec
from dashpot.text.problem import InputError, Place

ATTEMPTS = 3
SAME = 1e-3  # of an error: what hardly matters is still on its way
WEAK = 30.0  # merit below which a cause had better be measured once more


@single_threaded_algebra
def diagnose(
    spec: NetworkSpec,
    dataset: Dataset,
    *,
    optimizer: str | None = None,
    options: Mapping[str, Any] | None = None,
    seed: int = 0,
    jobs: int = 1,
    registry: Registry,
    progress: Progress | None = None,
    relevance: float = SMALLEST_GAIN,
    most_looks: int = MOST_LOOKS,
) -> Diagnosis:
    """Triage the data, fit, look at what is left, pursue its causes, and say how sure that is.

    A cause that makes the training error smaller by less than the share ``relevance`` is not named. After so many
    looks at all suspects as ``most_looks`` the search ends. Raises InputError for a network that does not compile on
    these data, and where no plugin provides a cause.
    """
    if not registry.causes:
        raise InputError.at(Place(), "expected plugins with causes, got none", "`dashpot list plugins` says why")
    progress = progress or silent
    triage = examine(one_force_each(dataset))
    dataset = triage.dataset
    setting = prepare(dataset, seed)
    method = make_optimizer(optimizer, registry.optimizers, options) if optimizer else None
    fit, restarts = fit_to_rest(lambda attempt: fit_prepared(spec, setting, method, seed + attempt, jobs, progress),
                                setting.swing)  # fmt: skip
    causes = {word: registry.causes[word] for word in sorted(registry.causes)}
    watch = _watch(progress, spec.name)
    bench = bench_of(fit, setting, registry, jobs, partial(watch, "screen of all places"))
    court = Court(bench, setting.held_out, list(causes.values()), seed, relevance,
                  {run.name: run.cluster for run in dataset.runs}, effort=Effort(most_looks))  # fmt: skip
    pursued = Pursuer(court, watch).run(model_of(fit))
    pursuit = with_untried(pursued, causes)
    final = known_to(bench, pursuit)
    first = pursuit.ladder[0]
    misfit = describe_misfit(dataset.runs, residuals_of(first, setting.scored))
    runs = [run for run in dataset.runs if run.name in setting.split.train]
    last = pursuit.last
    leftover = look_for_leftover(last.view, last.columns, last.noise, runs)
    return Diagnosis(
        setting=setting,
        triage=replace(
            triage,
            remarks=(
                *triage.remarks,
                *restarts,
                *limits_of(spec),
                *remarks_on_untried(pursued, causes),
                *remarks_on_effort(pursued, most_looks),
            ),
        ),
        fit=fit,
        pursuit=pursuit,
        final=final,
        before=measure_errors(first.fitted, setting, jobs),
        after=measure_errors(final, mended_setting(setting, pursuit), jobs),
        misfit=tuple(misfit),
        leftover=leftover,
        next_runs={} if spec.joints else next_runs(bench, pursuit),
        verdict=give_verdict(triage.faults, pursuit, leftover),
        causes=causes,
        seed=seed,
    )


def bench_of(fit: FitResult, setting: Setting, registry: Registry, jobs: int, watch: Callable[[float], None]) -> Bench:
    """What the refits need that come after the fit of a network."""
    return Bench(setting.train, registry.elements, force_sensors(setting.dataset), jobs, setting.held_out, watch,
                 [slot.path for slot in fit.declared.slots()],
                 view_of(fit.fitted, setting.train, registry.elements, jobs).forces)  # fmt: skip


def fit_to_rest(fit: Callable[[int], FitResult], swing: float) -> tuple[FitResult, list[str]]:
    """The first fit that converged, by the number of the attempt, else the best; and what is to be said of it.

    A fit that errs by more than the ``swing`` (N) of the forces has converged to something absurd, and does not count.
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
    ending = failed if len(faults) == len(attempts) else "came to rest"
    return best, [
        f"The fit of {best.declared.name} did not come to rest ({faults[0]}); of {len(attempts)} starts the best "
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
            f"it errs by {fit.errors.train:.3g} N where the forces vary by {swing:.3g} N: check units and start values"
        )
    return ""


def limits_of(spec: NetworkSpec) -> list[str]:
    """What is not looked for in a network of this kind."""
    chains = [member.name for member in spec.root.members if isinstance(member, Group) and member.kind == "series"]
    found = [f"Between the parts of the series connection '{name}' no cause is looked for, only between its ends; "
             "give the node between them a name under 'nodes:'." for name in chains]  # fmt: skip
    if spec.joints:
        found.append("No further run is simulated to tell causes apart: that is done for networks with two ends only.")
    return found


def remarks_on_effort(pursuit: Pursuit, most_looks: int) -> list[str]:
    """What to say of a search that was cut short."""
    if not pursuit.cut_short:
        return []
    return [f"The search ended after {most_looks} looks at all suspects: what is named was found, other causes may "
            "explain as much. More looks (`--most-looks`) take it further."]  # fmt: skip


def next_runs(bench: Bench, pursuit: Pursuit) -> dict[tuple[str, str], Telling]:
    """The run to make next for every cause and rival that fit alike, and for every weak cause (its rival is empty)."""
    found = {}
    for entry in pursuit.accepted:
        word = entry.finding.candidate.cause.word
        pairs = {other.finding.candidate.cause.word: other.model for other in entry.others}
        if not pairs and entry.base is not None and entry.trial.merit < WEAK:
            pairs = {"": entry.base}
        for rival, model in pairs.items():
            if entry.trial.model.mends != model.mends:
                continue  # what a fault of the measurement does on another run is not known
            run = telling_run(bench, entry.trial.model, model, pursuit.last.noise)
            if run is not None:
                found[word, rival] = run
    return found


def model_of(fit: FitResult) -> Model:
    """A fitted network as the start of a pursuit."""
    coordinates = search_coordinates(fit.fitted)
    return Model(fit.declared, fit.fitted, coordinates, coordinates.start, float("nan"), Outcome.CONVERGED)


def mended_setting(setting: Setting, pursuit: Pursuit) -> Setting:
    """The setting with the faults that were found taken out of the measured forces."""
    mends = pursuit.ladder[-1].mends
    return replace(setting, scored={name: mended(run, mends) for name, run in setting.scored.items()})


def known_to(bench: Bench, pursuit: Pursuit) -> NetworkSpec:
    """The final network with the intervals of its numbers."""
    model = pursuit.ladder[-1]
    runs = [mended(run, model.mends) for run in bench.runs]
    objective = Objective(compile_network(model.fitted), runs, bench.jobs)
    known = assess_uncertainty(objective, model.coordinates, model.point)
    return with_intervals(model.fitted, dict(zip(model.coordinates.paths, known.intervals, strict=True)))


def force_sensors(dataset: Dataset) -> dict[str, Mapping[str, float]]:
    """What the dataset says of the force channel, by run."""
    return {run.name: run.sensors.get("force", {}) for run in dataset.runs}


def _watch(progress: Progress, name: str) -> Callable[[str, float], None]:
    return lambda what, done: progress(f"{name}: {what}", done or None, None, None)
