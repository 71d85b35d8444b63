"""The columns of a look: what the residual, each number, each term and each candidate are on every run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import ChannelFault
from dashpot.diagnose.bends import bends_of_tables
from dashpot.diagnose.candidate import Candidate
from dashpot.diagnose.data_sheet import admitted
from dashpot.diagnose.inside import Inside
from dashpot.diagnose.plainest import not_shown
from dashpot.diagnose.refit import Refitter
from dashpot.diagnose.table_rows import step_of
from dashpot.diagnose.term import Model
from dashpot.diagnose.term_forces import term_forces
from dashpot.diagnose.view import ModelView
from dashpot.diagnose.whitening import Noise
from dashpot.fit.scored import ScoredRun

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Layout:
    """Where columns stand: the residual first, then the tangents of the terms' numbers, what each term adds to the
    force, and the candidates.
    """

    tangents: int
    terms: int
    bank: int

    def term(self, number: int) -> int:
        """The column of what a term adds to the force."""
        return 1 + self.tangents + number

    @property
    def first_candidate(self) -> int:
        """The first column of the candidates."""
        return 1 + self.tangents + self.terms

    @property
    def size(self) -> int:
        """How many columns there are."""
        return self.first_candidate + self.bank


@dataclass(frozen=True, eq=False)
class Columns:
    """What is linear about a model on each run, by name of the run, reduced to the band that carries signal.

    ``residual`` (kept,) and ``tangents`` (p, kept) are those of the model, ``own`` (t,) the coordinates of the terms'
    numbers and ``base`` (p - t,) those of the base, ``bends`` (b, n) the functions by which its tables may bend,
    ``forces`` what each term adds (n,), ``inner`` the candidates that sit between nodes, ``unseen`` the columns of
    candidates that these runs cannot show, ``admitted`` (k, kept) what the data sheets of the channel admit. In front
    of the columns of the ``layout`` stand those of the base, and of each run the ``doubted`` columns of the ``faults``.
    """

    refitter: Refitter
    view: ModelView
    plain: Noise
    residual: Mapping[str, Array]
    tangents: Mapping[str, Array]
    own: NDArray[np.intp]
    base: NDArray[np.intp]
    bends: Mapping[str, Array]
    faults: Sequence[ChannelFault]
    doubted: int
    forces: Sequence[Mapping[str, Array]]
    candidates: Sequence[Candidate]
    inner: Mapping[str, tuple[NDArray[np.intp], Array]] | None
    unseen: NDArray[np.intp]
    admitted: Mapping[str, Array]

    @property
    def layout(self) -> Layout:
        """Where the columns behind those in front stand."""
        return Layout(self.own.size, len(self.forces), self.candidates[-1].columns.stop if self.candidates else 0)

    @property
    def free(self) -> int:
        """How many columns in front are of the base."""
        return self.base.size + len(next(iter(self.bends.values())))

    @property
    def first(self) -> int:
        """How many columns there are in front, which are projected out."""
        return self.free + self.doubted * len(self.refitter.runs)

    def of(self, run: ScoredRun) -> NDArray[np.float32]:
        """All columns of a run, as rows (c, kept); in single precision, to save memory: sums are to be double."""
        name, layout = run.name, self.layout
        faults = shapes_of(self.faults, self.view, run, self.plain)
        runs, first = [one.name for one in self.refitter.runs], self.first
        rows = np.zeros((first + layout.size, self.plain.kept(name, run.samples)), np.float32)
        rows[: self.base.size] = self.tangents[name][self.base]
        rows[self.base.size : self.free] = self.plain.reduce(name, self.bends[name])
        at = self.free + self.doubted * runs.index(name)
        rows[at : at + self.doubted] = faults
        rows[first] = self.residual[name]
        rows[first + 1 : first + 1 + self.own.size] = self.tangents[name][self.own]
        for number, force in enumerate(self.forces):
            rows[first + layout.term(number)] = self.plain.reduce(name, force[name][run.first :])
        self._fill(rows[first + layout.first_candidate :], run)
        return rows

    def _fill(self, bank: NDArray[np.float32], run: ScoredRun) -> None:
        """Write the columns of the candidates."""
        for candidate in (candidate for candidate in self.candidates if candidate.site is None):
            bank[candidate.columns] = self.refitter.columns(candidate, self.view, run, self.plain)
        bank[self.unseen] = 0.0
        if self.inner is not None:
            places, values = self.inner[run.name]
            bank[places] = self.plain.reduce(run.name, values)


def linearised(
    refitter: Refitter,
    model: Model,
    view: ModelView,
    inside: Inside | None,
    candidates: Sequence[Candidate],
    faults: Sequence[ChannelFault],
) -> Columns:
    """The columns of a model and of candidates beside it; what each term adds only where there are candidates."""
    runs = refitter.runs
    steps = {run.name: step_of(run, view.highest_frequency) for run in runs}
    plain = Noise(steps).with_white({run.name: 1.0 for run in runs})
    residual, tangents = refitter.linearise(model, plain)
    own, base = _own_and_base(model)
    return Columns(
        refitter=refitter,
        view=view,
        plain=plain,
        residual=residual,
        tangents=tangents,
        own=own,
        base=base,
        bends=bends_of_tables(runs, view, model.fitted),
        faults=faults,
        doubted=len(shapes_of(faults, view, runs[0], plain)),
        forces=term_forces(refitter, model) if candidates else [],
        candidates=candidates,
        inner=inside.bank(candidates, refitter.jobs, refitter.watch) if inside else None,
        unseen=not_shown(candidates, view, runs),
        admitted=admitted(refitter.sensors, view, runs, plain),
    )


def _own_and_base(model: Model) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """The coordinates of the terms' numbers, and those of the base."""
    mine = {path for owned in model.owned for path in owned}
    own = np.array([path in mine for path in model.coordinates.paths], dtype=bool)
    return np.flatnonzero(own), np.flatnonzero(~own)


def shapes_of(faults: Sequence[ChannelFault], view: ModelView, run: ScoredRun, noise: Noise) -> Array:
    """What faults of the channel add to a run (k, kept) at unit strength, reduced."""
    shapes = [np.atleast_2d(fault.shapes(view, run.name))[:, run.first :] for fault in faults]
    return noise.reduce_shapes(run.name, np.concatenate([np.zeros((0, run.samples)), *shapes]))
