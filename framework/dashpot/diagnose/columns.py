"""The columns of a look: what the residual, each number, each term and each candidate are on every run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import ChannelFault
from dashpot.diagnose.bends import bends_of_tables
from dashpot.diagnose.candidate import Candidate
from dashpot.diagnose.inside import Inside
from dashpot.diagnose.plainest import not_shown
from dashpot.diagnose.refit import Refitter
from dashpot.diagnose.table_rows import step_of
from dashpot.diagnose.term import Model
from dashpot.diagnose.view import ModelView
from dashpot.diagnose.whitening import Noise
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.workers import spread

Array = NDArray[np.float64]

HELD_BYTES = 125e6  # of rows of a look


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
    candidates that these runs cannot show. In front of the columns of
    the ``layout`` stand those of the base, and of each run the ``doubted`` columns of the ``faults``.
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

    def of(self, run: ScoredRun) -> Array:
        """All columns of a run, as rows (c, kept)."""
        name, layout = run.name, self.layout
        faults = shapes_of(self.faults, self.view, run, self.plain)
        runs, first = [one.name for one in self.refitter.runs], self.first
        rows = np.zeros((first + layout.size, self.plain.kept(name, run.samples)))
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

    def kept(self, run: ScoredRun) -> tuple[NDArray[np.intp], list[NDArray[np.float32]]]:
        """The rows of a run that its refitter keeps in memory anyway: their places (k,), and they themselves."""
        places, found = [np.arange(0)], []
        for candidate in (candidate for candidate in self.candidates if candidate.site is None):
            at = np.arange(candidate.columns.start, candidate.columns.stop)
            rows = self.refitter.kept_columns(candidate, run)
            if rows is not None and not np.isin(at, self.unseen).any():
                places.append(self.first + self.layout.first_candidate + at)
                found.append(rows)
        return np.concatenate(places), found

    def _fill(self, bank: Array, run: ScoredRun) -> None:
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
        forces=refitter.term_forces(model) if candidates else [],
        candidates=candidates,
        inner=inside.bank(candidates, refitter.jobs, refitter.watch) if inside else None,
        unseen=not_shown(candidates, view, runs),
    )


@dataclass(frozen=True, eq=False)
class _Parted:
    """Rows in two parts: ``rows`` (c - k, kept) of their own, and at ``places`` (k,) others that are ``kept``."""

    rows: NDArray[np.float32]
    places: NDArray[np.intp]
    kept: Sequence[NDArray[np.float32]]

    def whole(self) -> Array:
        """All of them (c, kept)."""
        found = np.empty((len(self.rows) + self.places.size, self.rows.shape[1]))
        found[np.delete(np.arange(len(found)), self.places)] = self.rows
        if self.kept:
            found[self.places] = np.concatenate(self.kept)
        return found


class Rows(Mapping[str, Array]):
    """The rows (c, kept) of each run by its name: held in memory as far as ``HELD_BYTES`` go, else made each time.

    Their values have single precision, to save memory; sums over them are to be double. What the refitter keeps is not
    held twice.
    """

    def __init__(self, columns: Columns, jobs: int) -> None:
        runs = columns.refitter.runs
        self._runs, self._columns = {run.name: run for run in runs}, columns
        width = columns.free + columns.doubted * len(runs) + columns.layout.size
        ends = np.cumsum([4 * width * columns.plain.kept(run.name, run.samples) for run in runs])
        held = [run for run, end in zip(runs, ends, strict=True) if end < HELD_BYTES]
        self._held = dict(zip((run.name for run in held), spread(self._parted, held, jobs=jobs), strict=True))

    def _single(self, run: ScoredRun) -> NDArray[np.float32]:
        return self._columns.of(run).astype(np.float32)

    def _parted(self, run: ScoredRun) -> _Parted:
        whole, (places, kept) = self._single(run), self._columns.kept(run)
        return _Parted(np.delete(whole, places, axis=0), places, kept)

    def __getitem__(self, name: str) -> Array:
        return self._held[name].whole() if name in self._held else self._single(self._runs[name]).astype(float)

    def __iter__(self) -> Iterator[str]:
        return iter(self._runs)

    def __len__(self) -> int:
        return len(self._runs)


def _own_and_base(model: Model) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """The coordinates of the terms' numbers, and those of the base."""
    mine = {path for owned in model.owned for path in owned}
    own = np.array([path in mine for path in model.coordinates.paths], dtype=bool)
    return np.flatnonzero(own), np.flatnonzero(~own)


def shapes_of(faults: Sequence[ChannelFault], view: ModelView, run: ScoredRun, noise: Noise) -> Array:
    """What faults of the channel add to a run (k, kept) at unit strength, reduced."""
    shapes = [np.atleast_2d(fault.shapes(view, run.name))[:, run.first :] for fault in faults]
    return noise.reduce_shapes(run.name, np.concatenate([np.zeros((0, run.samples)), *shapes]))
