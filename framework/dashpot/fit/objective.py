"""What a set of parameters is worth on a set of runs."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from copy import copy
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from dashpot.data.steady import STEADY
from dashpot.fit.alike import repeated
from dashpot.fit.enough_steps import EnoughSteps, Team
from dashpot.fit.last_moved import LastMoved
from dashpot.fit.scored import ScoredRun
from dashpot.fit.shelf import TIMES_FOR_STEPS, Shelf
from dashpot.kernel.columns import Rows
from dashpot.kernel.network import CompiledNetwork, compile_network
from dashpot.kernel.parts import MovedLanes, Parts, take_apart
from dashpot.kernel.pieces import SystemRows
from dashpot.kernel.scratch import Scratch
from dashpot.kernel.solution import Solution
from dashpot.kernel.system import CompiledSystem
from dashpot.kernel.workers import spread, streamed, threads
from dashpot.model.network import NetworkSpec

if TYPE_CHECKING:
    from dashpot.kernel.workers import Jobs

Array = NDArray[np.float64]
WORTHWHILE = 3e4  # lanes times samples of a run: a tenth of a millisecond in the kernel
Result = TypeVar("Result")


class Whitening(Protocol):
    """Makes misfits of a run independent of one another and of variance one."""

    def whiten(self, run: str, signals: Array) -> Array:
        """Signals (..., samples) of a run, whitened and reduced to (..., kept)."""

    def kept(self, run: str, samples: int) -> int:
        """How many values are kept of so many samples."""


class Objective:
    """The misfit of a compiled network on runs.

    As it is, runs weigh as they say, whatever their length, and a loss is the root of the mean over runs of the mean
    squared error, in N. ``weights`` (runs,), of which only the proportions count, change that. With a ``whitening`` a
    loss is the root mean square of all whitened misfits. Objectives on the same runs may share a ``shelf`` for what is
    prepared of these.
    """

    def __init__(
        self,
        network: CompiledNetwork | CompiledSystem,
        runs: Sequence[ScoredRun],
        jobs: Jobs = 1,
        whitening: Whitening | None = None,
        weights: Sequence[float] | None = None,
        shelf: Shelf[Rows] | None = None,
    ) -> None:
        self.network, self.runs, self.jobs, self.whitening = network, tuple(runs), threads(jobs), whitening
        shares = np.array([run.weight for run in self.runs]) if weights is None else np.asarray(weights, dtype=float)
        self.shares = shares / shares.mean()
        self.teams = _teams(self.runs)
        self.steps = EnoughSteps(network, self.runs)
        self.shelf: Shelf[Rows] = shelf or Shelf()
        self.steps_shelf: Shelf[SystemRows] = Shelf(TIMES_FOR_STEPS)
        self.moved: LastMoved[Team] = LastMoved(len(self.teams))
        self.scratch = Scratch()
        if isinstance(network, CompiledNetwork):
            network.expect(self.shelf.kept(network.prepared_by))
        self.total = sum(
            whitening.kept(run.name, run.samples) if whitening is not None else run.samples for run in self.runs
        )

    def __reduce__(self) -> tuple[Any, ...]:
        # where it arrives it is compiled for the processor there, and works on one thread
        return _elsewhere, (self.network.spec, self.runs, self.whitening, self.shares)

    def weighing(self, weights: Sequence[float]) -> Objective:
        """The same runs with other weights (runs,); what was prepared is shared."""
        other = copy(self)
        other.shares = np.asarray(weights, dtype=float) / np.mean(weights)
        return other

    def repeated(self) -> list[list[int]]:
        """Numbers of runs, grouped: those of a group are repeats of one another, or were measured together."""
        return repeated(self.runs)

    def rows_of(self, network: CompiledNetwork, number: int) -> Rows:
        """What is prepared of a run for the network, or for one of its branches alone."""
        run = self.runs[number]
        return self.shelf(network.prepared_by, run, lambda: network.prepare(run.excitation))

    @cached_property
    def parts(self) -> Parts:
        """The branches of the network alone."""
        found = take_apart(self.network.spec)
        for part in found.members:
            part.network.expect(self.shelf.kept(part.network.prepared_by))
        return found

    def linearise(self, values: Array, moves: Array, reduce: Callable[[int, Array], Result]) -> Iterator[Result]:
        """What ``reduce`` makes of one run after the other, from its number and its rows (1 + k, values).

        The rows are the residual at ``values`` (slots,) and its changes with each of the ``moves`` (k, slots). Those of
        as many runs as there are threads are in memory at once, and those of the next ones overwrite them.
        """
        rows_of = partial(self._moved_as_a_whole, values, moves)
        if isinstance(self.network, CompiledNetwork):
            rows_of = partial(self._moved_by_branches, values, moves, self.parts.lanes(values, moves))

        def reduced(team: Team) -> list[Result]:
            return [reduce(number, self._weighed(number, rows)) for number, rows in rows_of(team)]

        for found in streamed(reduced, self.teams, self._threads(1 + len(moves))):
            yield from found

    def _threads(self, lanes: int) -> int:
        """How many threads are worth it: of short runs Python does most, for one thread at a time."""
        long = isinstance(self.network, CompiledSystem) or lanes * self.total >= WORTHWHILE * len(self.runs)
        return self.jobs if long else 1

    def _moved_by_branches(
        self, values: Array, moves: Array, lanes: Sequence[MovedLanes], team: Team
    ) -> Iterator[tuple[int, Array]]:
        for number in team:
            run = self.runs[number]
            excitation, dt = run.excitation, run.drive.dt
            rows = [self.rows_of(part.network, number) for part in self.parts.members]
            forces = self.parts.sensitivities(rows, lanes, len(moves), self.scratch)
            found = run.seen(self.network.observation(values, excitation).linear(forces, dt))[:, run.first :]
            for k in np.flatnonzero(moves[:, self.parts.outside].any(axis=1)):
                other = self.network.observation(values + moves[k], excitation).see(forces[:1] + forces[1 + k], dt)[0]
                found[1 + k] = run.seen(other)[run.first :] - found[0]
            found[0] -= run.force[run.first :]
            yield number, found

    def _moved_as_a_whole(self, values: Array, moves: Array, team: Team) -> Iterator[tuple[int, Array]]:
        return self.moved(team, values, moves, partial(self._solved_moved, team, values))

    def _solved_moved(self, team: Team, values: Array, moves: Array) -> Iterator[tuple[int, Array]]:
        lanes = np.concatenate([values[None], values + moves])
        solution = self._solved_around(team, lanes)
        if not self.steps.tell(team, solution, values):
            solution = self._solved_around(team, lanes)
        for number, force in self._shown(team, lanes, solution):
            run = self.runs[number]
            found = np.array(force[:, run.first :])
            found[1:] -= found[0]
            found[0] -= run.force[run.first :]
            yield number, found

    def forces(self, values: Array) -> list[Array]:
        """What the load cell would show: for every run (lanes, samples), the warm-up included."""
        values = np.atleast_2d(values)
        found: list[Array] = [np.empty(0)] * len(self.runs)

        def fill(team: Team) -> None:
            for number, force in self._forces(team, values):
                found[number] = force

        spread(fill, self.teams, self._threads(len(values)))
        return found

    def misfits(self, values: Array) -> Array:
        """Simulated minus measured force (lanes, all counted samples), run after run, in N."""
        values = np.atleast_2d(values)
        return np.concatenate(self._misfits(values, lambda number, misfits: misfits), axis=1)

    def residuals(self, values: Array) -> Array:
        """Misfits (lanes, values) of all runs, weighted or whitened so that their root mean square is the loss."""
        values = np.atleast_2d(values)
        return np.concatenate(self._misfits(values, self._weighed), axis=1)

    def _misfits(self, values: Array, seen: Callable[[int, Array], Result]) -> list[Result]:
        """What is ``seen`` of each run, from its number and its misfits (lanes, samples)."""

        def fill(team: Team) -> list[tuple[int, Result]]:
            return [
                (number, seen(number, force[:, run.first :] - run.force[run.first :]))
                for number, force in self._forces(team, values)
                for run in (self.runs[number],)
            ]

        found = dict(pair for some in spread(fill, self.teams, self._threads(len(values))) for pair in some)
        return [found[number] for number in range(len(self.runs))]

    def losses(self, values: Array) -> Array:
        """The loss of every lane (lanes,); a lane that fails costs infinity."""
        if self.whitening is None:
            squares = np.square(self.rmse(values))
            counted = self.shares > 0.0
            return np.sqrt(np.mean(self.shares[counted, None] * squares[counted], axis=0) * counted.mean())
        squares = np.sum(self._misfits(np.atleast_2d(values), lambda *run: _squares(self._weighed(*run))), axis=0)
        return np.sqrt(np.where(np.isfinite(squares), squares, np.inf) / self.total)

    def rmse(self, values: Array) -> Array:
        """The root mean square error of every run (runs, lanes) in N; a lane that fails has infinity."""
        values = np.atleast_2d(values)
        plain = all(self.network.observation(values, run.excitation).plain for run in self.runs)
        if not plain or any(run.kind == STEADY for run in self.runs):
            squares = np.array(self._misfits(values, lambda _, misfits: _squares(misfits) / misfits.shape[1]))
        else:
            squares = self._scores(values)
        return np.sqrt(np.where(np.isfinite(squares), squares, np.inf))

    def _scores(self, values: Array) -> Array:
        found = np.empty((len(self.runs), values.shape[0]))

        def fill(team: Team) -> None:
            found[list(team)] = self._scored(team, values)

        spread(fill, self.teams, self._threads(len(values)))
        return found

    def _scored(self, team: Team, values: Array) -> Array:
        # the mean squared errors (runs, lanes) of runs that were measured together
        runs = [self.runs[number] for number in team]
        if isinstance(self.network, CompiledNetwork):
            rows = self.rows_of(self.network, team[0])
            targets, weights = [run.force for run in runs], [_weights(run) for run in runs]
            return self.network.score([rows] * len(runs), targets, weights, values)
        network, steps = self._system(team)
        places = [network.number_of(run.end) for run in runs]
        target, weight = np.zeros((2, len(network.outputs), runs[0].force.size))
        for place, run in zip(places, runs, strict=True):
            target[place], weight[place] = run.force, _weights(run)
        return network.score([steps], [target], [weight], values)[0][places]

    def factor(self, number: int) -> float:
        """By what the misfits of a run are multiplied, where they are not whitened."""
        return float(np.sqrt(self.shares[number] * self.total / (len(self.runs) * self.runs[number].samples)))

    def _weighed(self, number: int, misfits: Array) -> Array:
        """The misfits (lanes, samples) of a run as they count; they may be altered themselves."""
        if self.whitening is None:
            misfits *= self.factor(number)
            return misfits
        return self.whitening.whiten(self.runs[number].name, misfits)

    def _forces(self, team: Team, values: Array) -> Iterator[tuple[int, Array]]:
        # what the load cells show in runs that were measured together
        if isinstance(self.network, CompiledNetwork):
            rows = self.rows_of(self.network, team[0])
            see = self.network.observation(values, self.runs[team[0]].excitation).see
            for number in team:
                found = see(np.atleast_2d(self.network.simulate(rows, values)), rows.drive.dt)
                yield number, self.runs[number].seen(found)
            return
        yield from self._shown(team, values, self._solution(team, values))

    def _solution(self, team: Team, values: Array) -> Solution:
        network, rows = self._system(team)
        return network.solve(rows, values)

    def _solved_around(self, team: Team, lanes: Array) -> Solution:
        network, rows = self._system(team)
        return network.solve_around(rows, lanes)

    def _system(self, team: Team) -> tuple[CompiledSystem, SystemRows]:
        # with as many steps as runs that were measured together need so far
        assert isinstance(self.network, CompiledSystem)
        network, excitation, refine = self.network, self.runs[team[0]].excitation, self.steps.of(team)
        return network, self.steps_shelf(refine, team, lambda: network.prepare(excitation, refine))

    def _shown(self, team: Team, values: Array, solution: Solution) -> Iterator[tuple[int, Array]]:
        # what the load cells show of a solution
        assert isinstance(self.network, CompiledSystem)
        excitation, forces = self.runs[team[0]].excitation, solution.solved_force
        see = self.network.observation(values, excitation).see
        for number in team:
            shown = see(forces[:, self.network.number_of(self.runs[number].end)], excitation.dt)
            yield number, self.runs[number].seen(shown)


def as_simulated(spec: NetworkSpec, runs: Sequence[ScoredRun], jobs: Jobs = 1) -> Objective:
    """The misfit of the numbers of a file, solved with the steps that ``dashpot simulate`` takes for them."""
    objective = Objective(compile_network(spec), runs, jobs)
    objective.steps = EnoughSteps(objective.network, objective.runs, as_simulated=True)
    return objective


def _elsewhere(spec: NetworkSpec, runs: Sequence[ScoredRun], whitening: Whitening | None, shares: Array) -> Objective:
    return Objective(compile_network(spec), runs, 1, whitening, shares.tolist())


def _squares(signals: Array) -> Array:
    return np.asarray(np.einsum("ij,ij->i", signals, signals))


def _weights(run: ScoredRun) -> Array:
    weights = np.full(run.force.size, 1.0 / run.samples)
    weights[: run.first] = 0.0
    return weights


def _teams(runs: Sequence[ScoredRun]) -> list[Team]:
    found: dict[str, list[int]] = {}
    for number, run in enumerate(runs):
        found.setdefault(run.record or run.name, []).append(number)
    return [tuple(team) for team in found.values()]
