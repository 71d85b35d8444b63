"""A fitted model linearised on every run: one Gram matrix of residual, terms and candidates for each group of runs.

All that the search asks is answered by these matrices: what a candidate explains beside everything else, what a term
is worth, and what a structure predicts of runs that took no part in its fit.
"""

from __future__ import annotations

import ctypes
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Cause, ChannelFault
from dashpot.diagnose.candidate import Candidate
from dashpot.diagnose.columns import Columns, Layout, linearised, shapes_of
from dashpot.diagnose.folds import Folds
from dashpot.diagnose.front import RIDGE, Front, beside, front_of, in_front
from dashpot.diagnose.inside import Inside
from dashpot.diagnose.location import gather_candidates, locations_of
from dashpot.diagnose.odds import Odds
from dashpot.diagnose.refit import Refitter
from dashpot.diagnose.table_rows import moved, records, stated, weighed
from dashpot.diagnose.term import Model
from dashpot.diagnose.view import ModelView, view_of
from dashpot.diagnose.whitening import ORDER, Noise, covariance_of, filter_of, independent_share, lagged, orthonormal
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.workers import streamed

Array = NDArray[np.float64]

RESOLUTION = 1e-5  # of the deviation of the force: simulation and record are no finer
BLOCK = 2048  # samples of a run of which all columns are multiplied or made orthonormal at a time
LEFT = 0.5  # of the degrees of freedom may be taken; beyond that the residual of the model stands for the noise


@dataclass(frozen=True, eq=False)
class Doubt:
    """A fault that every run may have, and the RMS (k,) of its strengths by which repeats differ."""

    fault: ChannelFault
    strengths: Array


@dataclass(eq=False)
class Recorded:
    """The noise of the records beside all columns of a look, found when it is asked for.

    ``gram`` (c, c) is that of all runs under ``white`` noise.
    """

    refitter: Refitter
    model: Model
    view: ModelView
    candidates: Sequence[Candidate]
    kinds: Sequence[ChannelFault]
    doubted: Sequence[Doubt]
    white: Noise
    gram: Array

    @cached_property
    def found(self) -> tuple[Noise, float]:
        """The noise, and the RMS in N of what all columns together leave."""
        refitter = self.refitter
        faults = [doubt.fault for doubt in self.doubted]
        inside = _inside_of(refitter, self.model)
        columns = linearised(refitter, self.model, self.view, inside, self.candidates, faults)
        shapes = _shapes(self.kinds, self.view, refitter.runs, columns.plain)
        shapes |= {run: np.concatenate([shapes[run], errors]) for run, errors in columns.admitted.items()}
        noise, rich = recorded_noise(columns, self.gram, self.white, shapes)
        return stated(noise, refitter.sensors, refitter.runs), rich


@dataclass(frozen=True, eq=False)
class Look:
    """The whitened columns behind the ``front``, ``samples`` (groups,) of them.

    ``own`` (t,) are the coordinates of the terms' numbers, ``base`` (p,) those of the base. ``recorded`` tells the
    noise of the records alone; without it that is ``noise``. ``sizes`` (c,) are the RMS of columns in N. ``exact``
    (groups, 1 + t, 1 + t) are the Gram matrices of residual and tangents without errors of forms.
    """

    model: Model
    noise: Noise
    view: ModelView
    candidates: tuple[Candidate, ...]
    layout: Layout
    front: Front
    exact: Array
    samples: Array
    folds: Folds
    sizes: Array
    unavailable: tuple[tuple[str, str], ...]
    recorded: Recorded | None
    own: NDArray[np.intp]
    base: NDArray[np.intp]
    odds: Odds

    @property
    def measured_noise(self) -> Noise:
        """The noise of the records alone, without the error of the model."""
        return self.recorded.found[0] if self.recorded else self.noise

    @property
    def rich(self) -> float:
        """What all columns together leave, N."""
        return self.recorded.found[1] if self.recorded else 0.0


def look_at(
    refitter: Refitter,
    model: Model,
    causes: Sequence[type[Cause]],
    folds: Folds,
    noise: Noise | None = None,
    doubted: Sequence[Doubt] = (),
    known: Sequence[Candidate] | None = None,
) -> Look:
    """Linearise a model on the training runs; without a ``noise`` that of each run is learnt.

    ``folds`` say which parts of the runs are left out together. Without ``causes`` only the model itself is seen. Each
    run may have the ``doubted`` faults, as large as repeats differ. In place of all candidates of the causes some may
    be ``known``.
    """
    if known is None:
        give_back_memory()  # of the look before
    runs, view = refitter.runs, view_of(model.fitted, moved(refitter.runs), refitter.elements, refitter.jobs)
    inside = _inside_of(refitter, model)
    if known is None:
        locations = locations_of(view, model.fitted, inside)
        candidates, unavailable = gather_candidates(causes, locations, refitter.sheet, refitter.able)
    else:
        candidates, unavailable = list(known), ()
    columns = linearised(refitter, model, view, inside, candidates, [doubt.fault for doubt in doubted])
    if known is None:
        refitter.shelf.clear()  # the columns of all candidates need the memory
    layout, free, first = columns.layout, columns.free, columns.first
    precision = _known_beforehand(free, doubted, len(runs))
    learnt = noise is None
    kinds = [fault for cause in causes for fault in cause().channel_faults(view)] if learnt else []
    noise = noise or _left_by(columns, [fault for fault in kinds if fault.evidence_of == "at_rest"])
    grams, samples, squares = _grams(columns, noise, folds)
    whole: Array = sum(grams[1:], start=grams[0])
    terms = 1 + layout.tangents
    plainly = [gram[: first + terms, : first + terms].copy() for gram in grams]
    moves = in_front(whole[: first + terms, : first + terms], precision)
    moves[:, 0] *= bool(doubted)  # the residual is that of the parameters as they are
    exact = np.array([beside(gram, moves) for gram in plainly])
    front = front_of(grams, whole, precision[free:], free, layout, model, candidates)
    return Look(
        model=model,
        noise=noise,
        view=view,
        candidates=tuple(candidates),
        layout=layout,
        front=front,
        exact=exact,
        samples=samples,
        folds=folds,
        sizes=np.sqrt(squares[first:]),
        unavailable=unavailable,
        recorded=Recorded(refitter, model, view, candidates, kinds, doubted, noise, whole) if learnt else None,
        own=columns.own,
        base=columns.base,
        odds=Odds(layout.bank, refitter.missing),
    )


def look_settled(
    refitter: Refitter,
    model: Model,
    causes: Sequence[type[Cause]],
    folds: Folds,
    doubted: Sequence[Doubt] = (),
    known: Sequence[Candidate] | None = None,
) -> Look:
    """Linearise a model after a refit under the noise that it leaves.

    Structures are compared at their own optimum only: beside it the linear step promises what a refit does not keep.
    """
    view = view_of(model.fitted, moved(refitter.runs), refitter.elements, refitter.jobs)
    noise = _left_by(linearised(refitter, model, view, None, (), ()), ())
    settled = refitter.refit(model, model.terms, noise)
    return look_at(refitter, settled, causes, folds, doubted=doubted, known=known)


def give_back_memory() -> None:
    """Give memory that is free back to the system: the C library of Linux keeps most of what a look has used."""
    with suppress(OSError, AttributeError, TypeError):  # another C library
        ctypes.CDLL(None).malloc_trim(0)


def _inside_of(refitter: Refitter, model: Model) -> Inside | None:
    """The inside of a network with nodes."""
    return Inside(model.fitted, refitter.runs, refitter.elements) if model.fitted.joints else None


def _left_by(columns: Columns, lines: Sequence[ChannelFault]) -> Noise:
    """The white noise that a model leaves, beside ``lines`` that each run may have in its force channel.

    Errors within the data sheets are random effects under a first estimate of it; then it is estimated again.
    """
    runs, residual = columns.refitter.runs, columns.residual
    shapes = _shapes(lines, columns.view, runs, columns.plain)
    left = {run.name: _beside_shapes(residual[run.name], shapes[run.name]) for run in runs}
    noise = searched_noise(left, columns.plain, runs)
    if columns.admitted:
        first = replace(noise, admitted=columns.admitted)
        left = {run: first.beside_admitted(run, rest) for run, rest in left.items()}
        noise = replace(searched_noise(left, columns.plain, runs), admitted=columns.admitted)
    return weighed(noise, residual, runs)


def _known_beforehand(free: int, doubted: Sequence[Doubt], runs: int) -> Array:
    """The precision (f,) of the columns in front: none of the ``free`` ones, then that of the faults of each run."""
    each = [np.maximum(doubt.strengths, 1e-300) ** -2.0 for doubt in doubted]
    return np.concatenate([np.zeros(free), *(each * runs)])


def _shapes(
    faults: Sequence[ChannelFault], view: ModelView, runs: Sequence[ScoredRun], noise: Noise
) -> dict[str, Array]:
    """What faults of the force channel would add to each run (k, kept) by itself."""
    return {run.name: shapes_of(faults, view, run, noise) for run in runs}


def _grams(columns: Columns, noise: Noise, folds: Folds) -> tuple[list[Array], Array, Array]:
    """The Gram matrix (c, c) of columns under white ``noise`` for each fold, the number (folds,) of their samples, and
    the mean squares (c,) of the columns in N^2.

    Samples that are not independent weigh less in both. The rows of a run are made when its turn has come.
    """
    runs, size = columns.refitter.runs, columns.first + columns.layout.size

    def seen(run: ScoredRun) -> list[tuple[int, Array, int]]:
        found = noise.beside_admitted(run.name, columns.of(run))
        parts = ((fold, found[:, part]) for fold, part in folds.of_run(run.name, found.shape[1]))
        return [(fold, _gram_of(part), part.shape[1]) for fold, part in parts]

    grams = [np.zeros((size, size)) for _ in folds.names]
    samples, squares = np.zeros(len(folds.names)), np.zeros(size)
    for run, found in zip(runs, streamed(seen, runs, columns.refitter.jobs), strict=True):
        share, precision = noise.independent.get(run.name, 1.0), noise.filters[run.name][0] ** 2
        count = sum(kept for _, _, kept in found)
        for fold, gram, kept in found:
            squares += np.diag(gram) / (count * len(runs))
            samples[fold] += share * kept
            gram *= share * precision
            grams[fold] += gram
    return grams, samples, squares


def _gram_of(rows: NDArray[np.float32]) -> Array:
    """The Gram matrix (c, c) of rows (c, kept) in double precision, a block of samples at a time."""
    gram = np.zeros((len(rows), len(rows)))
    for start in range(0, rows.shape[1], BLOCK):
        block = rows[:, start : start + BLOCK].astype(float)
        gram += block @ block.T
    return gram


def _beside_shapes(signal: Array, shapes: Array) -> Array:
    """A signal (kept,) less the shapes (k, kept) in it."""
    return signal - np.linalg.lstsq(shapes.T, signal, rcond=1e-9)[0] @ shapes


def _smallest(run: ScoredRun) -> float:
    """The deviation in N below which nothing is believed."""
    return RESOLUTION * max(float(np.std(run.force)), 1e-12)


def searched_noise(residual: Mapping[str, Array], plain: Noise, runs: Sequence[ScoredRun]) -> Noise:
    """How far a model with such residuals (kept,) in N is from the records, as white noise, the same in all of them.

    A wrong model repeats its error with every cycle, so that only independent samples count; whitening the error would
    judge it by its fastest part. A noise of each run would let a fit follow some runs at the cost of the others.
    """
    shares = {run: independent_share(rest) for run, rest in residual.items()}
    recorded = records(runs)
    squares = [float(np.mean(residual[run.name] ** 2)) for run in recorded]
    samples = [shares[run.name] * residual[run.name].size for run in recorded]
    whole = np.sqrt(np.average(squares, weights=samples)) if recorded else 1.0
    deviation = max([float(whole), *map(_smallest, recorded)])
    return replace(plain.with_white(dict.fromkeys(shares, deviation)), independent=shares)


def recorded_noise(columns: Columns, gram: Array, noise: Noise, faults: Mapping[str, Array]) -> tuple[Noise, float]:
    """The noise of the records alone, an autoregressive model of what all columns together leave, and its RMS in N.

    ``gram`` (c, c) is that of all runs under the white ``noise``; ``faults`` (k, kept) that a run may have by itself
    are no noise. What the columns and faults take up of the noise itself is made up for, in its size and its spectrum,
    where at least half of the degrees of freedom of a run are left.
    """
    from scipy.linalg import cholesky, solve_triangular

    first = columns.first
    scale = np.sqrt(np.maximum(np.diag(gram), 1e-300))
    others = np.flatnonzero(np.arange(len(scale)) != first)
    gram = gram / np.outer(scale, scale)
    root = cholesky(gram[np.ix_(others, others)] + RIDGE * np.eye(others.size), lower=True)
    aim = solve_triangular(root, gram[others, first], lower=True) * scale[first]

    def left_of(run: ScoredRun) -> tuple[Array, float]:
        """The filter of a run and its square in N^2; all of its columns are there for no longer than this takes."""
        found, own = columns.of(run), orthonormal(faults[run.name])
        residual = found[first].astype(float)
        rest, taken = residual.copy(), np.zeros(min(ORDER + 1, residual.size))
        for start in range(0, residual.size, BLOCK):
            known = min(start, ORDER)
            block = slice(start - known, start + BLOCK)
            basis = solve_triangular(root, found[others, block] / scale[others, None], lower=True)
            rest[start : block.stop] -= aim @ basis[:, known:]
            taken += noise.weight(run.name) * lagged(basis, known) / residual.size
        if taken[0] > LEFT:
            rest, taken = residual, np.zeros(taken.size)
        if taken[0] + len(own) / rest.size < LEFT:
            rest, taken = rest - own @ rest @ own, taken + lagged(own) / rest.size
        covariance = covariance_of(rest, taken)
        return filter_of(covariance, rest.size, _smallest(run)), float(covariance[0])

    runs = columns.refitter.runs
    left = list(streamed(left_of, runs, columns.refitter.jobs))
    filters = {run.name: each for run, (each, _) in zip(runs, left, strict=True)}
    return replace(noise, filters=filters, independent={}), float(np.sqrt(np.mean([square for _, square in left])))
