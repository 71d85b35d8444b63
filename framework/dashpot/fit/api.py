"""Identifying a network on a dataset, in stages.

1  curves     the elastic curve from the quasi-static loop
2  parameters everything else on the dynamic training runs, by the chosen optimizer
3  refinement the ends of the curve corrected by the friction found, then all parameters jointly on all training runs; a
              curve that is kept moves only so that the simulated slow loop keeps the mid line of the measured one
4  posterior  where a sampler is asked for: draws from what data and priors tell of the parameters
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.chain import make_optimizer
from dashpot.contract.optimizer import Optimizer, Space
from dashpot.contract.registry import Registry
from dashpot.data.dataset import Dataset
from dashpot.data.ends import one_force_each
from dashpot.data.noise_spectrum import NoiseSpectrum
from dashpot.data.run import Run
from dashpot.fit.algebra import single_threaded_algebra
from dashpot.fit.coordinates import search_coordinates, with_point
from dashpot.fit.derived_intervals import derived_intervals
from dashpot.fit.floor import noise_floor
from dashpot.fit.force_ends import ends_from_records
from dashpot.fit.grounding import correct_ends, ground_curves
from dashpot.fit.holdout import Split, split_runs
from dashpot.fit.identifiability import identifiability
from dashpot.fit.kept_curves import refinement
from dashpot.fit.known import known_numbers
from dashpot.fit.noise_of_runs import noise_of_runs
from dashpot.fit.objective import Objective, as_simulated
from dashpot.fit.order import ordered
from dashpot.fit.posterior import STEPS, require_sampler, sample_posterior
from dashpot.fit.prior import beside_priors, first_error, refine_beside_priors, rows_beside, told_priors
from dashpot.fit.ranges import natural_sizes, with_ranges
from dashpot.fit.refine import OWN_METHOD, Refined, refine
from dashpot.fit.result import Errors, FitResult, with_intervals
from dashpot.fit.scored import ScoredRun, weighted
from dashpot.fit.search import run_search
from dashpot.fit.seen_range import seen_range
from dashpot.fit.spare import spare_branches
from dashpot.fit.starts import Best, refine_from_starts
from dashpot.fit.thinned import thinned
from dashpot.fit.uncertainty import assess_uncertainty
from dashpot.kernel.network import compile_network
from dashpot.kernel.settings import require_settings
from dashpot.kernel.workers import finished, forked_as_done, forks, result_of, threads
from dashpot.model.network import NetworkSpec, Slot
from dashpot.text.problem import InputError, Place, Problem

if TYPE_CHECKING:
    from dashpot.kernel.workers import Jobs

Array = NDArray[np.float64]
Progress = Callable[..., None]

REFINEMENT_STEPS = 120


def silent(*_: Any, **__: Any) -> None:
    """Progress that nobody watches."""


@dataclass(frozen=True, eq=False)
class Setting:
    """A dataset made ready: scored runs by name, which of them train, the noise floor."""

    dataset: Dataset
    scored: Mapping[str, ScoredRun]
    split: Split
    floor: Any

    @property
    def train(self) -> list[ScoredRun]:
        """The training runs."""
        return [self.scored[name] for name in self.split.train]

    @property
    def train_runs(self) -> tuple[Run, ...]:
        """The training runs as they were measured."""
        return self.dataset.select(self.split.train).runs

    @property
    def held_out(self) -> list[ScoredRun]:
        """The held-out runs."""
        return [self.scored[name] for name in self.split.held_out]

    @cached_property
    def noise(self) -> dict[str, NoiseSpectrum]:
        """The spectrum of the noise of each training run by name; every network of a comparison asks for it."""
        return noise_of_runs(self.train_runs, self.floor)

    @property
    def swing(self) -> float:
        """The root mean square of how the forces of the training runs vary about their means, N."""
        return float(np.sqrt(np.mean([np.var(run.force[run.first :]) for run in self.train])))


def prepare(dataset: Dataset, seed: int = 0) -> Setting:
    """Score the runs, each force by itself, split them, find the noise floor of the training runs.

    Raises InputError for runs without a force, or with one at a node whose motion was not measured.
    """
    dataset = one_force_each(dataset)
    _refuse_without_force(dataset)
    split = split_runs(dataset, seed)
    floor = noise_floor(dataset.select(split.train))
    return Setting(dataset, {run.name: run for run in weighted(dataset.runs)}, split, floor)


def _refuse_without_force(dataset: Dataset) -> None:
    """A network is fitted to forces, each at the place whose motion is known."""
    problems = []
    for run in dataset.runs:
        if "force" not in run.channels or "displacement" not in run.channels:
            known = ", ".join(f"'{name}'" for name in run.channels)
            message = f"run '{run.name}' measures no force at a place whose displacement it measures: it has {known}"
            hint = "add 'force' beside 'displacement' (or 'force@NODE' beside 'displacement@NODE') to its channels"
            problems.append(Problem(Place(run.source or None), message, hint))
    if problems:
        raise InputError(problems)


def fit_network(
    spec: NetworkSpec,
    dataset: Dataset,
    *,
    optimizer: str | None = None,
    options: Mapping[str, Any] | None = None,
    seed: int = 0,
    jobs: Jobs = 1,
    registry: Registry,
    progress: Progress | None = None,
    sampler: str | None = None,
    sampler_steps: int = STEPS,
) -> FitResult:
    """Identify the free parameters of a network; see the module for the stages.

    ``optimizer`` is a plugged-in method for stage 2; without one the framework's own Gauss-Newton from several starts.
    A ``sampler`` draws from the posterior of the fit, in so many steps at most. Raises InputError for a network that
    does not compile, and for a sampler that is unknown or not installed.
    """
    if sampler is not None:
        require_sampler(sampler, sampler_steps)
    method = make_optimizer(optimizer, registry.optimizers, options) if optimizer else None
    setting = prepare(dataset, seed)
    [found] = fit_each([spec], setting, method, seed, jobs, progress or silent)
    fit = fitted_or_raised(found)
    if sampler is None:
        return fit
    watch = _Watch(progress or silent, spec.name, setting.floor.value)
    posterior = sample_posterior(
        fit,
        setting.train,
        sampler=sampler,
        steps=sampler_steps,
        jobs=threads(jobs),
        progress=lambda done: watch.stage("posterior", done),
    )
    return replace(fit, posterior=posterior)


def fit_each(
    specs: Sequence[NetworkSpec],
    setting: Setting | Sequence[Setting],
    method: Optimizer | None,
    seed: int,
    jobs: Jobs,
    progress: Progress,
) -> list[FitResult | InputError]:
    """What each network comes to on a dataset made ready, one for all or one each, or why it cannot be fitted.

    Networks are fitted side by side on a pool or a cluster, or, with several jobs, in copies of this process, each on
    one thread; there ``progress`` hears of a network when it is fitted. A process that cannot be copied fits one after
    the other, each on as many threads as there are jobs.
    """
    settings = [setting] if isinstance(setting, Setting) else list(setting)
    many = [sum(slot.value.searched for slot in spec.slots()) for spec in specs]
    order = sorted(range(len(specs)), key=lambda number: -many[number])  # none that takes long is left to the end alone
    each = [(specs[number], number % len(settings)) for number in order]
    elsewhere = not isinstance(jobs, int) or forks(jobs, len(each)) > 1
    shared = (settings, method, seed, 1 if elsewhere else threads(jobs), silent if elsewhere else progress)
    found: dict[int, FitResult | InputError] = {}
    for place, fit in _fits(shared, each, jobs):
        number = order[place]
        if elsewhere:
            progress(f"{specs[number].name}: fitted", 1.0)
        # one dataset for all, not a copy with each
        whole = settings[number % len(settings)].dataset
        found[number] = replace(fit, dataset=whole) if isinstance(fit, FitResult) else fit
    return [found[number] for number in range(len(specs))]


_Shared = tuple[Sequence[Setting], Optimizer | None, int, int, Progress]
_One = tuple[NetworkSpec, int]  # a network, and the number of its setting


def _fits(shared: _Shared, each: Sequence[_One], jobs: Jobs) -> Iterator[tuple[int, FitResult | InputError]]:
    """The number of each fit and what it came to, as they are done."""
    if not isinstance(jobs, int):
        yield from ((number, result_of(future)) for number, future in finished(_fitted, shared, each, jobs))
        return
    elements = {leaf.element for spec, _ in each for leaf in spec.leaves()}  # may be of no module
    known = [*elements, *(setting.dataset for setting in shared[0])]
    yield from forked_as_done(partial(_fitted, shared), each, jobs, known)


def _fitted(shared: _Shared, one: _One) -> FitResult | InputError:
    (settings, method, seed, jobs, progress), (spec, which) = shared, one
    try:
        return fit_prepared(spec, settings[which], method, seed, jobs, progress)
    except InputError as error:
        return error


def fitted_or_raised(found: FitResult | InputError) -> FitResult:
    """The fit, or its InputError."""
    if isinstance(found, InputError):
        raise found
    return found


def require_training_runs(setting: Setting) -> None:
    """Raise InputError where all runs of a dataset are held out."""
    if not setting.split.train:
        message = f"expected runs to fit a network to, got {len(setting.split.held_out)}, all of them held out"
        raise InputError.at(Place(setting.dataset.name), message, "take 'held_out: true' from some, or add runs")


@single_threaded_algebra
def fit_prepared(
    spec: NetworkSpec, setting: Setting, method: Optimizer | None, seed: int, jobs: int, progress: Progress
) -> FitResult:
    """Identify a network on a dataset made ready. Raises InputError where all of its runs are held out."""
    require_training_runs(setting)
    watch = _Watch(progress, spec.name, setting.floor.value)
    require_settings(spec, {name: run.excitation.settings for name, run in setting.scored.items()})
    started = ends_from_records(ground_curves(spec, setting.train), setting.train)
    grounded = with_ranges(started, natural_sizes(setting.train))
    curves = set(grounded.data_curves())
    fast = [run for run in setting.train if run.kind not in ("quasi_static", "hold")] or setting.train
    staged, best = _search(
        grounded,
        fast if grounded.joints else thinned(fast),
        lambda slot: _curve_of(slot) not in curves,
        method,
        seed,
        jobs,
        watch,
        first_error(setting.floor.value, setting.swing),
    )
    refined, polished = _polish(correct_ends(staged, setting.train), setting, jobs, watch)
    fitted = ordered(spec, refined)
    objective, coordinates = Objective(compile_network(fitted), setting.train, jobs), search_coordinates(fitted)
    steps = [each.step for each in known_numbers(fitted)]
    before, error = rows_beside(objective, coordinates, fitted, setting.floor.value)
    known = assess_uncertainty(objective, coordinates, coordinates.start, steps, setting.floor.value, before, error)
    intervals = dict(zip(coordinates.paths, known.intervals, strict=True))
    intervals |= derived_intervals(fitted.slots(), coordinates, known)
    errors_of_numbers = known.errors * coordinates.slopes(coordinates.start) * coordinates.unit
    spare = spare_branches(
        fitted,
        coordinates,
        errors_of_numbers,
        lambda less: Objective(compile_network(less), setting.train, jobs),
        lambda slot: True,
        setting.floor.value,
    )
    return FitResult(
        declared=spec,
        fitted=with_intervals(fitted, intervals),
        errors=measure_errors(fitted, setting, jobs),
        noise_floor=setting.floor,
        split=setting.split,
        dataset=setting.dataset,
        optimizer=method.word if method else OWN_METHOD,
        seed=seed,
        ending=polished.outcome.value,
        evaluations=best.evaluations + polished.evaluations,
        at_bound=known.at_bound,
        idle=known.idle,
        spread=best.spread,
        history=best.history,
        seen=seen_range(spec, setting.train),
        correlation=known.correlation,
        errors_of_numbers=errors_of_numbers,
        samples=sum(run.samples for run in setting.train),
        known=identifiability(objective, coordinates, coordinates.start, setting.noise),
        priors=told_priors(fitted, coordinates, known.errors),
        spare=spare,
    )


def _polish(spec: NetworkSpec, setting: Setting, jobs: int, watch: _Watch) -> tuple[NetworkSpec, Refined]:
    watch.stage("refinement", 0.0)
    objective = Objective(compile_network(spec), setting.train, jobs)
    steps = watch.steps("refinement", REFINEMENT_STEPS)
    whole = refinement(spec, objective, lambda slot: True)
    found, _ = refine_beside_priors(whole, objective, REFINEMENT_STEPS, setting.floor.value, steps)
    return whole.at(found.point), found


def measure_errors(spec: NetworkSpec, setting: Setting, jobs: Jobs = 1) -> Errors:
    """The errors of a network with given numbers on all runs, as ``dashpot simulate`` and the measured forces say."""
    objective = as_simulated(spec, list(setting.scored.values()), jobs)
    errors = objective.rmse(objective.network.start)[:, 0].tolist()
    per_run = dict(zip(setting.scored, errors, strict=True))

    def pooled(names: Sequence[str]) -> float:
        return float(np.sqrt(np.mean([per_run[name] ** 2 for name in names])))

    held_out = pooled(setting.split.held_out) if setting.split.held_out else None
    return Errors(pooled(setting.split.train), held_out, pooled(tuple(per_run)), per_run)


def _search(
    spec: NetworkSpec,
    runs: Sequence[ScoredRun],
    chosen: Callable[[Slot], bool],
    method: Optimizer | None,
    seed: int,
    jobs: int,
    watch: _Watch,
    error: float,
) -> tuple[NetworkSpec, Best]:
    objective = Objective(compile_network(spec), runs, jobs)
    coordinates = search_coordinates(spec, chosen)
    loss = beside_priors(objective, spec, error)
    if method is None or not coordinates.paths:
        best = refine_from_starts(
            objective, coordinates, seed, lambda done, loss: watch.stage("search", done, loss), loss=loss
        )
        return with_point(spec, coordinates, best.refined.point), best
    space = Space(coordinates.paths, coordinates.to_cube(coordinates.start))
    found = run_search(
        method,
        lambda cube: loss.losses(coordinates.to_values(coordinates.from_cube(cube))),
        lambda cube: loss.residuals(coordinates.to_values(coordinates.from_cube(cube))),
        space,
        seed,
        progress=lambda standing: watch.stage(method.word, None, standing.loss),
    )
    point = coordinates.from_cube(found.best)
    history = tuple((standing.evaluations, standing.loss) for standing in found.history)
    refined = refine(loss, coordinates, point, steps=0)
    best = Best(refined, (found.loss,), found.evaluations, history, point[None])
    return with_point(spec, coordinates, point), best


def _curve_of(slot: Slot) -> str:
    return slot.path.partition("[")[0]


@dataclass(frozen=True)
class _Watch:
    progress: Progress
    name: str
    floor: float | None

    def stage(self, what: str, done: float | None, loss: float | None = None) -> None:
        self.progress(f"{self.name}: {what}", done, loss, self.floor)

    def steps(self, what: str, most: int) -> Callable[[float], None]:
        """Hears of the loss after each step of a stage that takes ``most`` of them at the longest."""
        numbers = itertools.count(1)
        return lambda loss: self.stage(what, next(numbers) / most, loss)
