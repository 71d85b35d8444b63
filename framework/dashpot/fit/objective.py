"""What a set of parameters is worth on a set of runs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from copy import copy
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.scored import ScoredRun
from dashpot.kernel.columns import Rows
from dashpot.kernel.network import CompiledNetwork
from dashpot.kernel.parts import Parts, take_apart

Array = NDArray[np.float64]


Whiten = Callable[[str, Array], Array]
Result = TypeVar("Result")


class Objective:
    """The misfit of a compiled network on runs.

    As it is, all runs weigh the same, whatever their length, and a loss is the root of the mean over runs of the mean
    squared error, in N. ``weights`` (runs,), of which only the proportions count, change that. With
    ``whiten(run, misfits)`` a loss is the root mean square of all whitened misfits.
    """

    def __init__(
        self,
        network: CompiledNetwork,
        runs: Sequence[ScoredRun],
        jobs: int = 1,
        whiten: Whiten | None = None,
        weights: Sequence[float] | None = None,
    ) -> None:
        self.network, self.runs, self.jobs, self.whiten = network, tuple(runs), jobs, whiten
        shares = np.ones(len(self.runs)) if weights is None else np.asarray(weights, dtype=float)
        self.shares = shares / shares.mean()
        self.rows = [network.prepare(run.drive) for run in self.runs]
        ends = np.cumsum([0] + [run.samples for run in self.runs])
        self.pieces = [slice(first, last) for first, last in zip(ends, ends[1:], strict=False)]
        self.total = int(ends[-1])

    def weighing(self, weights: Sequence[float]) -> Objective:
        """The same runs with other weights (runs,); what was prepared is shared."""
        other = copy(self)
        other.shares = np.asarray(weights, dtype=float) / np.mean(weights)
        return other

    @cached_property
    def parts(self) -> tuple[Parts, list[list[Rows]]]:
        """The branches of the network alone, and the runs as they see them."""
        parts = take_apart(self.network.spec)
        return parts, [parts.prepare(run.drive) for run in self.runs]

    def linearise(self, values: Array, which: Sequence[int], shifts: Array) -> tuple[Array, Array]:
        """The residual (samples,) at ``values`` (slots,) and its changes (len(which), samples) when slots move."""
        block = np.empty((1 + len(which), self.total))
        parts, rows = self.parts

        def fill(number: int) -> None:
            run, piece = self.runs[number], self.pieces[number]
            seen = self.network.observation(values).linear(
                *parts.sensitivities(rows[number], values, which, shifts), run.drive.dt
            )
            block[0, piece] = seen[0][run.first :] - run.force[run.first :]
            block[1:, piece] = seen[1][:, run.first :]
            for k in (k for k, slot in enumerate(which) if parts.owner[slot] is None):
                moved = values.copy()
                moved[which[k]] += shifts[k]
                other = self.network.observation(moved).see(seen[2][None], run.drive.dt)[0]
                block[1 + k, piece] = (other - seen[0])[run.first :]
            self._weigh(number, block)

        self._map(fill)
        return block[0], block[1:]

    def forces(self, values: Array) -> list[Array]:
        """What the load cell would show: for every run (lanes, samples), the warm-up included."""
        return self._map(lambda number: self._force(number, np.atleast_2d(values)))

    def misfits(self, values: Array) -> Array:
        """Simulated minus measured force (lanes, all counted samples), run after run, in N."""
        values = np.atleast_2d(values)
        out = np.empty((values.shape[0], self.total))

        def fill(number: int) -> None:
            run = self.runs[number]
            out[:, self.pieces[number]] = self._force(number, values)[:, run.first :] - run.force[run.first :]

        self._map(fill)
        return out

    def residuals(self, values: Array) -> Array:
        """Misfits (lanes, all counted samples) weighted or whitened so that their root mean square is the loss."""
        misfits = self.misfits(values)
        self._map(lambda number: self._weigh(number, misfits))
        return misfits

    def losses(self, values: Array) -> Array:
        """The loss of every lane (lanes,); a lane that fails costs infinity."""
        if self.whiten is None:
            squares = np.square(self.rmse(values))
            counted = self.shares > 0.0
            return np.sqrt(np.mean(self.shares[counted, None] * squares[counted], axis=0) * counted.mean())
        residuals = self.residuals(values)
        losses = np.sqrt(np.einsum("ij,ij->i", residuals, residuals) / self.total)
        return np.where(np.isfinite(losses), losses, np.inf)

    def rmse(self, values: Array) -> Array:
        """The root mean square error of every run (runs, lanes) in N; a lane that fails has infinity."""
        values = np.atleast_2d(values)
        if not self.network.observation(values).plain:
            misfits = self.misfits(values)
            squares = np.array([np.mean(np.square(misfits[:, piece]), axis=1) for piece in self.pieces])
        else:
            squares = self._scores(values)
        return np.sqrt(np.where(np.isfinite(squares), squares, np.inf))

    def _scores(self, values: Array) -> Array:
        weights = [np.where(np.arange(run.force.size) < run.first, 0.0, 1.0 / run.samples) for run in self.runs]
        return self.network.score(self.rows, [run.force for run in self.runs], weights, values, self.jobs)

    def _weigh(self, number: int, misfits: Array) -> None:
        run, piece = self.runs[number], self.pieces[number]
        if self.whiten is None:
            misfits[:, piece] *= np.sqrt(self.shares[number] * self.total / (len(self.runs) * run.samples))
        else:
            misfits[:, piece] = self.whiten(run.name, misfits[:, piece])

    def _force(self, number: int, values: Array) -> Array:
        force = np.atleast_2d(self.network.simulate(self.rows[number], values))
        return self.network.observation(values).see(force, self.runs[number].drive.dt)

    def _map(self, work: Callable[[int], Result]) -> list[Result]:
        numbers = range(len(self.runs))
        if self.jobs == 1:
            return [work(number) for number in numbers]
        with ThreadPoolExecutor(self.jobs) as pool:
            return list(pool.map(work, numbers))
