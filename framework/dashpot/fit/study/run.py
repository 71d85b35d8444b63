"""All stages of all models, in the order of the study."""

from __future__ import annotations

import hashlib
import zlib
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

import dashpot
from dashpot.contract.metric import Metric
from dashpot.contract.registry import Registry
from dashpot.data.dataset import Dataset
from dashpot.fit.algebra import single_threaded_algebra
from dashpot.fit.api import Progress, Setting, measure_errors, silent
from dashpot.fit.bootstrap import bootstrap_intervals
from dashpot.fit.coordinates import Coordinates, search_coordinates
from dashpot.fit.derived_intervals import derived_intervals
from dashpot.fit.force_ends import ends_from_records
from dashpot.fit.grounding import correct_ends, ground_curves
from dashpot.fit.identifiability import Identifiability, identifiability
from dashpot.fit.known import KnownNumber, known_numbers
from dashpot.fit.noise_of_runs import noise_of_runs
from dashpot.fit.objective import Objective
from dashpot.fit.order import interchangeable, ordered
from dashpot.fit.prior import priors_of, rows_beside, told_priors
from dashpot.fit.profile import Profile, profiles
from dashpot.fit.ranges import natural_sizes, with_ranges
from dashpot.fit.refine import Outcome
from dashpot.fit.result import FitResult, with_intervals
from dashpot.fit.scored import ScoredRun
from dashpot.fit.seen_range import seen_range
from dashpot.fit.spare import spare_branches
from dashpot.fit.study.allowance import Owed, OwedToKnown, allowance, effect, force_error
from dashpot.fit.study.carry import carry_over
from dashpot.fit.study.checkpoint import Checkpoint
from dashpot.fit.study.declaration import ModelPlan, SearchStage, StudySpec
from dashpot.fit.study.parts import with_parts
from dashpot.fit.study.patterns import chosen
from dashpot.fit.study.references import require_references
from dashpot.fit.study.setting import restricted, run_weights, study_setting
from dashpot.fit.study.stage import StageResult, Task, search
from dashpot.fit.uncertainty import assess_uncertainty
from dashpot.fit.without_tire import MassWithoutTire, masses_without_tire
from dashpot.kernel.network import compile_network
from dashpot.kernel.workers import finished, result_of, threads
from dashpot.model.network import NetworkSpec
from dashpot.text.problem import InputError, Place

if TYPE_CHECKING:
    from dashpot.kernel.workers import Jobs

Array = NDArray[np.float64]

SLOW = ("quasi_static", "hold")


@dataclass(frozen=True, eq=False)
class ModelResult:
    """An identified model: the fit, how its stages went, and what the data tell about its numbers.

    ``setting`` holds its runs; ``bootstrap`` the intervals in SI by path where the study asks for them. ``owed`` says
    for each part, and ``owed_to_known`` for each number known from elsewhere, how far its error moves the parameters.
    ``without_tire`` are the masses of wheels as their own measured motion tells them.
    """

    setting: Setting
    fit: FitResult
    stages: tuple[StageResult, ...]
    known: Identifiability
    bootstrap: Mapping[str, tuple[float, float]]
    profiles: tuple[Profile, ...]
    owed: tuple[Owed, ...] = ()
    owed_to_known: tuple[OwedToKnown, ...] = ()
    without_tire: tuple[MassWithoutTire, ...] = ()


@dataclass(frozen=True, eq=False)
class StudyResult:
    """What a study found, model by model in its order; ``metrics`` are told of every run that has them."""

    study: StudySpec
    setting: Setting
    models: tuple[ModelResult, ...]
    metrics: tuple[type[Metric], ...] = ()


@single_threaded_algebra
def run_study(
    study: StudySpec,
    dataset: Dataset,
    *,
    registry: Registry,
    jobs: Jobs = 1,
    here: int = 1,
    checkpoint: Path | None = None,
    progress: Progress | None = None,
) -> StudyResult:
    """Identify every model of a study; what an earlier call left in the folder ``checkpoint`` is not done again.

    The same study, data and version give the same results, bit for bit, with any number of workers and after any
    number of interruptions. Raises InputError for patterns that name nothing, for networks that do not compile, and for
    references of another kind than the parameters of their paths.
    On a pool or a cluster models that do not build on each other are pieces of work, which reach the ``checkpoint``
    under the same path; of a model alone its starts, bootstrap and profiles are, and ``here`` threads of this process
    do the rest.

    Examples:
        >>> found = dp.run_study(study, dp.load_dataset("mount"), registry=dp.load_registry())
        >>> len(found.models)
        1
    """
    setting = study_setting(study, dataset)
    require_references(study, dataset.references)
    records = Checkpoint(checkpoint and checkpoint.absolute())
    records.open(fingerprint(study, dataset))
    conduct = _Conduct(study, setting, registry, jobs, max(here, threads(jobs)), records, progress or silent)
    return StudyResult(study, setting, tuple(conduct.models()), tuple(registry.metrics.values()))


def fingerprint(study: StudySpec, dataset: Dataset) -> str:
    """What the parameters of a study depend on."""
    networks = [text for plan in study.models for text in plan.network.texts]
    parts = [dashpot.__version__, str(study.seed), dataset.digest, study.text, *networks]
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()


def take_numbers(spec: NetworkSpec, what: str, runs: list[ScoredRun]) -> NetworkSpec:
    """The network after a stage that reads numbers from the data."""
    return ground_curves(spec, runs) if what == "curves" else correct_ends(spec, runs)


@dataclass
class _Conduct:
    study: StudySpec
    setting: Setting
    registry: Registry
    jobs: Jobs
    here: int
    records: Checkpoint
    progress: Progress
    spent: int = 0

    def models(self) -> Iterator[ModelResult]:
        """Every model; those identified before may be starting points."""
        _refuse_priors(self.study)
        done: dict[str, ModelResult] = {}
        while ready := self.study.ready(done):
            if isinstance(self.jobs, int) or len(ready) == 1:
                done[ready[0].name] = self.model_of(ready[0], done)
            else:
                done |= self._apart(ready, done)
        yield from (done[plan.name] for plan in self.study.models)

    def model_of(self, plan: ModelPlan, done: Mapping[str, ModelResult]) -> ModelResult:
        """A model whose starting point and parts are among those that are ``done``."""
        texts = {name: done[name].fit.identified_text for name in plan.needs}
        network = with_parts(plan.network, plan.parts, texts, self.registry) if plan.parts else plan.network
        alone = replace(self, setting=restricted(self.setting, plan))
        found = alone._model(replace(plan, network=network), done)
        self.spent = alone.spent
        return found

    def _apart(self, ready: Sequence[ModelPlan], done: Mapping[str, ModelResult]) -> dict[str, ModelResult]:
        """Several models, each as a piece of work, in processes with as many threads as all of them.

        Where one has no more to do, the others have its core.
        """
        each = [(plan, {name: done[name] for name in plan.needs}) for plan in ready]
        found, here = {}, self.here if isinstance(self.jobs, Executor) else 1
        for number, future in finished(
            _model_apart, replace(self, jobs=1, here=here, progress=silent), each, self.jobs
        ):
            plan, result = ready[number], result_of(future)
            if isinstance(result, InputError):
                raise result
            setting = restricted(self.setting, plan)
            # one dataset for all, not a copy with each
            fit = replace(result.fit, dataset=setting.dataset)
            found[plan.name] = replace(result, setting=setting, fit=fit)
            self.spent += plan.budget
            self._tell(plan, "identified")
        return found

    def _model(self, plan: ModelPlan, done: Mapping[str, ModelResult]) -> ModelResult:
        train = self.setting.train
        spec = carry_over(plan.network, done[plan.start_from].fit.fitted) if plan.start_from else plan.network
        results = []
        for number, stage in enumerate(plan.stages):
            if isinstance(stage, SearchStage):
                spec = with_ranges(ends_from_records(spec, train), natural_sizes(train))
                spec, result = self._search(plan, number, stage, spec)
                results.append(result)
            else:
                spec = take_numbers(spec, stage.take, train)
        parts = {branch: done[model] for branch, model in plan.parts.items()}
        found = self._judge(plan, with_ranges(spec, natural_sizes(train)), tuple(results), parts)
        masses = masses_without_tire(found.fit.fitted, self.setting.train_runs, self.here)
        return replace(found, without_tire=tuple(masses))

    def _search(
        self, plan: ModelPlan, number: int, stage: SearchStage, spec: NetworkSpec
    ) -> tuple[NetworkSpec, StageResult]:
        train = self.setting.train
        slow = [run for run in train if run.kind in SLOW]
        dynamic = [run for run in train if run.kind not in SLOW]
        runs = {"slow": slow, "dynamic": dynamic, "all": train}[stage.runs] or train
        label = f"{plan.name}-{number + 1}-{stage.name}"
        seed = zlib.crc32(label.encode()) ^ self.study.seed
        weights, optimizers = run_weights(self.study, runs), self.registry.optimizers
        noise, swing = self.setting.floor.value, self.setting.swing
        task = Task(runs, weights, seed, self.jobs, self.here, optimizers, noise, swing)

        def watch(evaluations: int, loss: float) -> None:
            done = (self.spent + min(evaluations, stage.budget)) / max(self.study.budget, 1)
            self.progress(f"{plan.name}: {stage.name}", done, loss, self.setting.floor.value)

        self._tell(plan, stage.name)
        found = search(spec, stage, task, lambda start: self.records.stage(f"{label}-{start + 1}"), watch)
        self.spent += stage.budget
        return found

    def _judge(
        self, plan: ModelPlan, spec: NetworkSpec, stages: tuple[StageResult, ...], parts: Mapping[str, ModelResult]
    ) -> ModelResult:
        spec = ordered(plan.network, spec)
        train, network, coordinates = self.setting.train, compile_network(spec), search_coordinates(spec)
        objective = Objective(network, train, self.here, weights=run_weights(self.study, train))
        errors = measure_errors(spec, self.setting, self.here)
        shares = {
            branch: force_error((part.fit.errors, part.setting), (errors, self.setting))
            for branch, part in parts.items()
        }
        allowed = [allowance(spec, branch, part.fit.declared.name, shares[branch]) for branch, part in parts.items()]
        known_before = known_numbers(spec)
        steps = [*(each.step for each in allowed), *(each.step for each in known_before)]
        floor = self.setting.floor.value
        before = rows_beside(objective, coordinates, spec, floor)
        known = assess_uncertainty(objective, coordinates, coordinates.start, steps, floor, *before)
        intervals = dict(zip(coordinates.paths, known.intervals, strict=True))
        noise = noise_of_runs(self.setting.dataset.runs, self.setting.floor)
        told = identifiability(objective, coordinates, coordinates.start, noise)
        errors_of_numbers = known.errors * coordinates.slopes(coordinates.start) * coordinates.unit
        fit = FitResult(
            declared=plan.network,
            fitted=with_intervals(spec, intervals | derived_intervals(spec.slots(), coordinates, known)),
            errors=errors,
            noise_floor=self.setting.floor,
            split=self.setting.split,
            dataset=self.setting.dataset,
            optimizer=" then ".join(dict.fromkeys(stage.optimizer for stage in stages if stage.free)),
            seed=self.study.seed,
            ending=ending_of(stages),
            evaluations=sum(stage.evaluations for stage in stages),
            at_bound=known.at_bound,
            idle=known.idle,
            spread=next((stage.spread for stage in stages if len(stage.spread) > 1), ()),
            history=_joined(stages),
            seen=seen_range(plan.network, train),
            known=told,
            errors_of_numbers=errors_of_numbers,
            priors=told_priors(spec, coordinates, known.errors),
            spare=self._spare(plan, spec, coordinates, errors_of_numbers, stages),
        )
        effects = [effect(coordinates, moved) for moved in known.moved]
        owed = tuple(
            Owed(each.branch, each.model, each.share, numbers) for each, numbers in zip(allowed, effects, strict=False)
        )
        return ModelResult(
            self.setting,
            fit,
            stages,
            told,
            self._resampled(plan, spec, objective, coordinates),
            self._profiles(plan, objective, coordinates),
            owed,
            _owed_to_known(spec, known_before, effects[len(allowed) :]),
        )

    def _spare(
        self,
        plan: ModelPlan,
        spec: NetworkSpec,
        coordinates: Coordinates,
        errors: Array,
        stages: Sequence[StageResult],
    ) -> tuple[str, ...]:
        """The branches that may go: without them, all else refitted that some stage searched, nothing is lost."""
        self._tell(plan, "branches that may go")
        train, searched = self.setting.train, {path for stage in stages for path in stage.free}
        weights = run_weights(self.study, train)
        return spare_branches(
            spec,
            coordinates,
            errors,
            lambda less: Objective(compile_network(less), train, self.here, weights=weights),
            lambda slot: slot.path in searched,
            self.setting.floor.value,
        )

    def _resampled(
        self, plan: ModelPlan, spec: NetworkSpec, objective: Objective, coordinates: Coordinates
    ) -> dict[str, tuple[float, float]]:
        if not (self.study.bootstrap and coordinates.paths):
            return {}
        group_of = {run.name: (run.kind, run.group) for run in self.setting.dataset.runs}
        groups = [group_of[run.name] for run in objective.runs]
        self._tell(plan, "bootstrap")
        found = bootstrap_intervals(
            objective,
            coordinates,
            coordinates.start,
            groups,
            self.study.bootstrap,
            self.study.seed,
            self.jobs,
            interchangeable(plan.network, spec),
        )
        return dict(zip(coordinates.paths, found, strict=True))

    def _profiles(self, plan: ModelPlan, objective: Objective, coordinates: Coordinates) -> tuple[Profile, ...]:
        wanted = [number for number, path in enumerate(coordinates.paths) if chosen(path, self.study.profiles)]
        if wanted:
            self._tell(plan, f"profiles of {', '.join(coordinates.paths[number] for number in wanted)}")
        return tuple(profiles(objective, coordinates, coordinates.start, wanted, self.setting.floor.value, self.jobs))

    def _tell(self, plan: ModelPlan, what: str) -> None:
        self.progress(f"{plan.name}: {what}", self.spent / max(self.study.budget, 1), None, self.setting.floor.value)


def ending_of(stages: Sequence[StageResult]) -> str:
    """How a model's search ended: as its first stage that did not converge, if no later one did with the same free.

    What a stage left unfinished is finished by one after it that searches at least the same parameters.
    """
    for number, stage in enumerate(stages):
        later = stages[number + 1 :]
        if not stage.converged and not any(each.converged and {*stage.free} <= {*each.free} for each in later):
            return stage.ending
    return Outcome.CONVERGED.value


def _owed_to_known(
    spec: NetworkSpec, known: Sequence[KnownNumber], effects: Sequence[Mapping[str, float]]
) -> tuple[OwedToKnown, ...]:
    """What the parameters owe to each number known from elsewhere, but to the knots of curves from data."""
    curves = set(spec.data_curves())
    pairs = zip(known, effects, strict=True)
    return tuple(OwedToKnown.of(each, moved) for each, moved in pairs if each.path.partition("[")[0] not in curves)


@single_threaded_algebra
def _model_apart(shared: _Conduct, one: tuple[ModelPlan, Mapping[str, ModelResult]]) -> ModelResult | InputError:
    try:
        return shared.model_of(*one)
    except InputError as error:
        return error


def _refuse_priors(study: StudySpec) -> None:
    """Bootstrap and profiles tell what the data say; a prior would be drawn or walked away from in silence."""
    wanted = [key for key in ("bootstrap", "profiles") if getattr(study, key)]
    for plan in study.models if wanted else ():
        priors = priors_of(plan.network)
        if priors:
            raise InputError.at(
                Place(plan.network.file),
                f"expected parameters without priors for '{wanted[0]}', got priors of {', '.join(priors.paths)}",
                f"leave '{wanted[0]}' out of the study, or the priors out of the network",
            )


def _joined(stages: tuple[StageResult, ...]) -> tuple[tuple[int, float], ...]:
    entries, before = [], 0
    for stage in stages:
        entries += [(before + count, loss) for count, loss in stage.history]
        before += stage.evaluations
    return tuple(entries)
