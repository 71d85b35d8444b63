"""What a set of parameters is worth on a set of runs."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from copy import copy
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol, cast

import numpy as np
from numpy.typing import NDArray

from dashpot.data.steady import STEADY
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.columns import Rows
from dashpot.kernel.network import CompiledNetwork, compile_network
from dashpot.kernel.parts import Parts, take_apart
from dashpot.kernel.pieces import SystemRows
from dashpot.kernel.system import CompiledSystem
from dashpot.kernel.workers import spread, threads
from dashpot.model.network import NetworkSpec

if TYPE_CHECKING:
    from dashpot.kernel.workers import Jobs

Array = NDArray[np.float64]


class Whitening(Protocol):
    """Makes misfits of a run independent of one another and of variance one."""

    def whiten(self, run: str, signals: Array) -> Array:
        """Signals (..., samples) of a run, whitened and reduced to (..., kept)."""

    def kept(self, run: str, samples: int) -> int:
        """How many values are kept of so many samples."""


# the numbers of runs whose forces were measured together
Team = tuple[int, ...]


class Objective:
    """The misfit of a compiled network on runs.

    As it is, runs weigh as they say, whatever their length, and a loss is the root of the mean over runs of the mean
    squared error, in N. ``weights`` (runs,), of which only the proportions count, change that. With a ``whitening`` a
    loss is the root mean square of all whitened misfits.
    """

    def __init__(
        self,
        network: CompiledNetwork | CompiledSystem,
        runs: Sequence[ScoredRun],
        jobs: Jobs = 1,
        whitening: Whitening | None = None,
        weights: Sequence[float] | None = None,
    ) -> None:
        self.network, self.runs, self.jobs, self.whitening = network, tuple(runs), threads(jobs), whitening
        shares = np.array([run.weight for run in self.runs]) if weights is None else np.asarray(weights, dtype=float)
        self.shares = shares / shares.mean()
        self.teams = _teams(self.runs)
        prepared = {team: network.prepare(self.runs[team[0]].excitation) for team in self.teams}
        self.rows = [prepared[team] for number in range(len(self.runs)) for team in self.teams if number in team]
        self.pieces = _pieces([run.samples for run in self.runs])
        if whitening is not None:
            self.pieces = _pieces([whitening.kept(run.name, run.samples) for run in self.runs])
        self.total = self.pieces[-1].stop if self.pieces else 0

    def __reduce__(self) -> tuple[Any, ...]:
        # where it arrives it is compiled for the processor there, and works on one thread
        return _elsewhere, (self.network.spec, self.runs, self.whitening, self.shares)

    def weighing(self, weights: Sequence[float]) -> Objective:
        """The same runs with other weights (runs,); what was prepared is shared."""
        other = copy(self)
        other.shares = np.asarray(weights, dtype=float) / np.mean(weights)
        return other

    @cached_property
    def parts(self) -> tuple[Parts, list[list[Rows]]]:
        """The branches of the network alone, and the runs as they see them."""
        parts = take_apart(self.network.spec)
        return parts, [parts.prepare(run.excitation) for run in self.runs]

    def linearise(self, values: Array, which: Sequence[int], shifts: Array) -> tuple[Array, Array]:
        """The residual (samples,) at ``values`` (slots,) and its changes (len(which), samples) when slots move."""
        if isinstance(self.network, CompiledSystem):
            return self._linearise_as_a_whole(values, which, shifts)
        block = np.empty((1 + len(which), self.total))
        parts, rows = self.parts

        def fill(number: int) -> None:
            run = self.runs[number]
            settings = run.excitation.settings
            seen = self.network.observation(values, settings).linear(
                *parts.sensitivities(rows[number], values, which, shifts), run.drive.dt
            )
            shown = run.seen(seen[0])
            found = np.empty((1 + len(which), run.samples))
            found[0] = shown[run.first :] - run.force[run.first :]
            found[1:] = run.seen(seen[1])[:, run.first :]
            for k in (k for k, slot in enumerate(which) if parts.owner[slot] is None):
                moved = values.copy()
                moved[which[k]] += shifts[k]
                other = self.network.observation(moved, settings).see(seen[2][None], run.drive.dt)[0]
                found[1 + k] = (run.seen(other) - shown)[run.first :]
            block[:, self.pieces[number]] = self._weighed(number, found)

        spread(fill, range(len(self.runs)), jobs=self.jobs)
        return block[0], block[1:]

    def _linearise_as_a_whole(self, values: Array, which: Sequence[int], shifts: Array) -> tuple[Array, Array]:
        lanes = np.repeat(values[None], 1 + len(which), axis=0)
        lanes[np.arange(1, 1 + len(which)), which] += shifts
        block = self.residuals(lanes)
        return block[0], block[1:] - block[0]

    def forces(self, values: Array) -> list[Array]:
        """What the load cell would show: for every run (lanes, samples), the warm-up included."""
        values = np.atleast_2d(values)
        found: list[Array] = [np.empty(0)] * len(self.runs)

        def fill(team: Team) -> None:
            for number, force in self._forces(team, values):
                found[number] = force

        spread(fill, self.teams, jobs=self.jobs)
        return found

    def misfits(self, values: Array) -> Array:
        """Simulated minus measured force (lanes, all counted samples), run after run, in N."""
        values = np.atleast_2d(values)
        return np.concatenate(self._misfits(values, lambda number, misfits: misfits), axis=1)

    def residuals(self, values: Array) -> Array:
        """Misfits (lanes, values) of all runs, weighted or whitened so that their root mean square is the loss."""
        values = np.atleast_2d(values)
        return np.concatenate(self._misfits(values, self._weighed), axis=1)

    def _misfits(self, values: Array, seen: Callable[[int, Array], Array]) -> list[Array]:
        found: list[Array] = [np.empty(0)] * len(self.runs)

        def fill(team: Team) -> None:
            for number, force in self._forces(team, values):
                run = self.runs[number]
                found[number] = seen(number, force[:, run.first :] - run.force[run.first :])

        spread(fill, self.teams, jobs=self.jobs)
        return found

    def losses(self, values: Array) -> Array:
        """The loss of every lane (lanes,); a lane that fails costs infinity."""
        if self.whitening is None:
            squares = np.square(self.rmse(values))
            counted = self.shares > 0.0
            return np.sqrt(np.mean(self.shares[counted, None] * squares[counted], axis=0) * counted.mean())
        residuals = self.residuals(values)
        losses = np.sqrt(np.einsum("ij,ij->i", residuals, residuals) / self.total)
        return np.where(np.isfinite(losses), losses, np.inf)

    def rmse(self, values: Array) -> Array:
        """The root mean square error of every run (runs, lanes) in N; a lane that fails has infinity."""
        values = np.atleast_2d(values)
        plain = all(self.network.observation(values, run.excitation.settings).plain for run in self.runs)
        if not plain or any(run.kind == STEADY for run in self.runs):
            squares = np.array([np.mean(np.square(misfit), axis=1) for misfit in self._misfits(values, lambda _, m: m)])
        else:
            squares = self._scores(values)
        return np.sqrt(np.where(np.isfinite(squares), squares, np.inf))

    def _scores(self, values: Array) -> Array:
        weights = [np.where(np.arange(run.force.size) < run.first, 0.0, 1.0 / run.samples) for run in self.runs]
        if isinstance(self.network, CompiledNetwork):
            rows = cast("list[Rows]", self.rows)
            return self.network.score(rows, [run.force for run in self.runs], weights, values, self.jobs)
        ends, targets, weighs = len(self.network.outputs), [], []
        for team in self.teams:
            shape = (ends, self.runs[team[0]].force.size)
            target, weigh = np.zeros(shape), np.zeros(shape)
            for number in team:
                place = self.network.number_of(self.runs[number].end)
                target[place], weigh[place] = self.runs[number].force, weights[number]
            targets.append(target)
            weighs.append(weigh)
        records = [cast(SystemRows, self.rows[team[0]]) for team in self.teams]
        scores = self.network.score(records, targets, weighs, values, self.jobs)
        found = np.empty((len(self.runs), values.shape[0]))
        for team, score in zip(self.teams, scores, strict=True):
            found[list(team)] = score[[self.network.number_of(self.runs[number].end) for number in team]]
        return found

    def factor(self, number: int) -> float:
        """By what the misfits of a run are multiplied, where they are not whitened."""
        return float(np.sqrt(self.shares[number] * self.total / (len(self.runs) * self.runs[number].samples)))

    def _weighed(self, number: int, misfits: Array) -> Array:
        """The misfits (lanes, samples) of a run as they count."""
        if self.whitening is None:
            return misfits * self.factor(number)
        return self.whitening.whiten(self.runs[number].name, misfits)

    def _forces(self, team: Team, values: Array) -> Iterator[tuple[int, Array]]:
        # what the load cells show in runs that were measured together
        rows = self.rows[team[0]]
        see = self.network.observation(values, self.runs[team[0]].excitation.settings).see
        if isinstance(self.network, CompiledNetwork):
            assert isinstance(rows, Rows)
            for number in team:
                found = see(np.atleast_2d(self.network.simulate(rows, values)), rows.drive.dt)
                yield number, self.runs[number].seen(found)
            return
        assert isinstance(rows, SystemRows)
        found = self.network.forces(rows, values)
        for number in team:
            shown = see(found[:, self.network.number_of(self.runs[number].end)], rows.excitation.dt)
            yield number, self.runs[number].seen(shown)


def _elsewhere(spec: NetworkSpec, runs: Sequence[ScoredRun], whitening: Whitening | None, shares: Array) -> Objective:
    return Objective(compile_network(spec), runs, 1, whitening, shares.tolist())


def _pieces(sizes: Sequence[int]) -> list[slice]:
    ends = np.cumsum([0, *sizes]).tolist()
    return [slice(first, last) for first, last in zip(ends, ends[1:], strict=False)]


def _teams(runs: Sequence[ScoredRun]) -> list[Team]:
    found: dict[str, list[int]] = {}
    for number, run in enumerate(runs):
        found.setdefault(run.record or run.name, []).append(number)
    return [tuple(team) for team in found.values()]
