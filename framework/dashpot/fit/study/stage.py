"""One search of one model: from records as far as they go, then freshly evaluated."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.chain import make_optimizer
from dashpot.contract.optimizer import Optimizer, Space
from dashpot.fit.algebra import single_threaded_algebra
from dashpot.fit.begin_at_wheels import begin_at_wheels
from dashpot.fit.coordinates import Coordinates, search_coordinates, with_point
from dashpot.fit.kept_curves import refinement
from dashpot.fit.objective import Objective
from dashpot.fit.prior import WithPriors, beside_priors, first_error, priors_of, refine_beside_priors
from dashpot.fit.refine import OWN_METHOD, Outcome, Refined, refine
from dashpot.fit.scored import ScoredRun
from dashpot.fit.search import Ending, run_search
from dashpot.fit.starts import LAST_STEPS, refine_from_starts
from dashpot.fit.study.checkpoint import Record
from dashpot.fit.study.declaration import SearchStage
from dashpot.fit.thinned import counted, thinned_objective
from dashpot.kernel.network import compile_network
from dashpot.kernel.workers import pieces
from dashpot.model.network import NetworkSpec

if TYPE_CHECKING:
    from dashpot.kernel.workers import Jobs

Array = NDArray[np.float64]
Watch = Callable[[int, float], None]

LED = 1e-3  # of the loss in a step: a smaller fall on thinned runs leads no further than one on all samples


@dataclass(frozen=True)
class StageResult:
    """How a search went. ``free`` are the parameters it moved, ``spread`` the losses of its starts, the best first."""

    name: str
    optimizer: str
    free: tuple[str, ...]
    loss: float
    evaluations: int
    failures: int
    ending: str
    remark: str
    spread: tuple[float, ...]
    history: tuple[tuple[int, float], ...]
    converged: bool


@dataclass(frozen=True, eq=False)
class Task:
    """What a search works on: the runs with their weights, the seed, the workers, the optimizers.

    ``jobs`` do the starts of a plugged-in optimizer, ``threads`` of this process all else.
    ``noise`` (N) is known or not, and ``swing`` (N) that of the forces; both weigh priors.
    """

    runs: Sequence[ScoredRun]
    weights: Sequence[float]
    seed: int
    jobs: Jobs
    threads: int
    known: Mapping[str, type[Optimizer]]
    noise: float | None
    swing: float


def search(
    spec: NetworkSpec, stage: SearchStage, task: Task, record: Callable[[int], Record], watch: Watch
) -> tuple[NetworkSpec, StageResult]:
    """The network with the parameters that the stage found; ``record(start)`` holds what is known of each start.

    KeyboardInterrupt leaves the records as far as they came.
    """
    coordinates = search_coordinates(spec, stage.frees)
    objective = Objective(compile_network(spec), task.runs, task.threads, weights=task.weights)
    if not coordinates.paths:
        return spec, _nothing(stage, objective, coordinates)
    if stage.optimizer == OWN_METHOD and stage.starts == 1:
        whole = refinement(spec, objective, stage.frees)
        known = _recorded(record(0), lambda keep: _refine(spec, objective, stage, task))
        return whole.at(np.array(known["point"])), _summed(stage, whole.coordinates, [known])
    if stage.optimizer == OWN_METHOD:
        found = [_recorded(record(0), lambda keep: _refine_starts(spec, objective, coordinates, stage, task, watch))]
    else:
        loss = beside_priors(objective, spec, first_error(task.noise, task.swing))
        here = isinstance(task.jobs, int)
        shared = (stage, replace(task, jobs=1, threads=1), loss, coordinates, watch if here else _unwatched)
        found = pieces(_start, shared, [(number, record(number)) for number in range(stage.starts)], task.jobs)
    found = sorted(found, key=lambda each: each["loss"])
    fitted = with_point(spec, coordinates, np.array(found[0]["point"]))
    return fitted, _summed(stage, coordinates, found)


def _unwatched(evaluations: int, loss: float) -> None:
    """How a start goes on that nobody watches."""


@single_threaded_algebra
def _start(
    shared: tuple[SearchStage, Task, Objective | WithPriors, Coordinates, Watch], one: tuple[int, Record]
) -> dict[str, Any]:
    """One start with a plugged-in optimizer, by its number and its record."""
    (stage, task, loss, coordinates, watch), (number, kept) = shared, one
    rng = np.random.default_rng([task.seed, number])
    begin = coordinates.to_cube(coordinates.start) if number == 0 else rng.random(len(coordinates.paths))
    budget = stage.budget // stage.starts
    method = make_optimizer(stage.optimizer, task.known, stage.options)
    before = number * budget
    seed = int(rng.integers(2**32))

    def work(kept: Record) -> dict[str, Any]:
        found = run_search(
            method,
            lambda cube: loss.losses(coordinates.to_values(coordinates.from_cube(cube))),
            lambda cube: loss.residuals(coordinates.to_values(coordinates.from_cube(cube))),
            Space(coordinates.paths, np.clip(begin, 0.0, 1.0)),
            seed,
            budget=max(budget, 1),
            progress=lambda standing: watch(before + standing.evaluations, standing.loss),
            recorded=kept.blocks(),
            keep=kept.keep,
        )
        if found.ending is Ending.INTERRUPTED:
            kept.close()
            raise KeyboardInterrupt
        return {
            "point": coordinates.from_cube(found.best).tolist(),
            "loss": found.loss,
            "evaluations": found.evaluations,
            "failures": found.failures,
            "ending": found.ending.value,
            "remark": found.remark,
            "converged": found.ending is Ending.CONVERGED,
            "history": [[standing.evaluations, standing.loss] for standing in found.history],
            "spread": [found.loss],
        }

    return _recorded(kept, work)


def _refine(spec: NetworkSpec, objective: Objective, stage: SearchStage, task: Task) -> dict[str, Any]:
    """The framework's own method from one start, after a few steps on thinned runs, or at wheels that were measured.

    Parameter vectors on thinned runs count by the share of the samples that these have.
    """
    begun, spent = begin_at_wheels(spec, objective, stage.frees, stage.budget - 1)
    sparse = thinned_objective(objective) if begun is spec and priors_of(spec) is None else None
    spec = begun
    if sparse:
        part = refinement(spec, sparse, stage.frees)
        led = refine(part.loss, part.coordinates, part.coordinates.start, stage.budget, LED, budget=stage.budget)
        spent, spec = spent + counted(led.evaluations, sparse, objective), part.at(led.point)
    whole = refinement(spec, objective, stage.frees)
    refined, _ = refine_beside_priors(whole, objective, stage.budget, task.noise, budget=stage.budget - spent)
    spent += refined.evaluations
    return _own_result(refined, spent, ((spent, refined.loss),), (refined.loss,))


def _refine_starts(
    spec: NetworkSpec, objective: Objective, coordinates: Coordinates, stage: SearchStage, task: Task, watch: Watch
) -> dict[str, Any]:
    """The framework's own method from several starts, on thinned runs; the best of them on all samples."""
    sparse, error = thinned_objective(objective), first_error(task.noise, task.swing)
    searched = sparse or objective
    best = refine_from_starts(
        searched,
        coordinates,
        task.seed,
        lambda done, loss: watch(int(done * stage.budget), loss),
        stage.budget,
        beside_priors(searched, spec, error),
    )
    if not sparse:
        return _own_result(best.refined, best.evaluations, best.history, best.spread)
    whole, spent = beside_priors(objective, spec, error), counted(best.evaluations, sparse, objective)
    refined = refine(whole, coordinates, best.refined.point, LAST_STEPS, budget=stage.budget - spent)
    history = [(counted(count, sparse, objective), loss) for count, loss in best.history]
    spread = whole.losses(coordinates.to_values(best.ends)).tolist()
    spent += refined.evaluations
    return _own_result(refined, spent, (*history, (spent, refined.loss)), spread)


def _own_result(
    refined: Refined, evaluations: int, history: Sequence[tuple[int, float]], spread: Sequence[float]
) -> dict[str, Any]:
    return {
        "point": refined.point.tolist(),
        "loss": refined.loss,
        "evaluations": evaluations,
        "failures": 0,
        "ending": refined.outcome.value,
        "remark": "",
        "converged": refined.outcome is Outcome.CONVERGED,
        "history": [list(entry) for entry in history],
        "spread": list(spread),
    }


def _recorded(record: Record, work: Callable[[Record], dict[str, Any]]) -> dict[str, Any]:
    known = record.result()
    if known is None:
        known = work(record)
        record.finish(known)
    return known


def _summed(stage: SearchStage, coordinates: Coordinates, found: list[dict[str, Any]]) -> StageResult:
    best = found[0]
    spread = sorted(loss for each in found for loss in each["spread"])
    return StageResult(
        stage.name,
        stage.optimizer,
        coordinates.paths,
        best["loss"],
        sum(each["evaluations"] for each in found),
        sum(each["failures"] for each in found),
        best["ending"],
        best["remark"],
        tuple(spread),
        tuple((int(count), float(loss)) for count, loss in best["history"]),
        best["converged"],
    )


def _nothing(stage: SearchStage, objective: Objective, coordinates: Coordinates) -> StageResult:
    loss = float(objective.losses(coordinates.to_values(coordinates.start))[0])
    return StageResult(stage.name, "", (), loss, 0, 0, "nothing to search in this model", "", (loss,), (), True)
