"""A fitted model linearised on every run: one Gram matrix of residual, terms and candidates for each group of runs.

All that the search asks is answered by these matrices: what a candidate explains beside everything else, what a term
is worth, and what a structure predicts of runs that took no part in its fit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Cause, ChannelFault
from dashpot.diagnose.candidate import Candidate
from dashpot.diagnose.columns import Layout, Rows, linearised, shapes_of
from dashpot.diagnose.folds import Folds
from dashpot.diagnose.front import RIDGE, Front, beside_base, front_of
from dashpot.diagnose.inside import Inside
from dashpot.diagnose.location import gather_candidates, locations_of, renumbered
from dashpot.diagnose.refit import Refitter
from dashpot.diagnose.term import Model
from dashpot.diagnose.view import ModelView, view_of
from dashpot.diagnose.whitening import Noise, independent_share, learn_filter
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.workers import streamed

Array = NDArray[np.float64]

RESOLUTION = 1e-5  # of the deviation of the force: simulation and record are no finer
LEFT = 0.5  # of the degrees of freedom; with fewer the residual of the model stands for the noise


@dataclass(frozen=True, eq=False)
class Doubt:
    """A fault that every run may have, and the RMS (k,) of its strengths by which repeats differ."""

    fault: ChannelFault
    strengths: Array


@dataclass(frozen=True, eq=False)
class Look:
    """The whitened columns behind the ``front``, ``samples`` (groups,) of them.

    ``own`` (t,) are the coordinates of the terms' numbers, ``base`` (p,) those of the base. ``rich`` is what all
    columns together leave, N. ``measured_noise`` is that of the records alone, without the error of the model,
    ``sizes`` (c,) the RMS of columns in N. ``exact`` (groups, 1 + t, 1 + t) are the Gram matrices of residual and
    tangents without errors of forms.
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
    measured_noise: Noise
    rich: float
    own: NDArray[np.intp]
    base: NDArray[np.intp]


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
    run may have the ``doubted`` faults, as large as repeats differ. The candidates may be ``known`` from an earlier
    look.
    """
    runs, view = refitter.runs, view_of(model.fitted, refitter.runs, refitter.elements, refitter.jobs)
    inside = Inside(model.fitted, runs, refitter.elements) if model.fitted.joints else None
    if known is None:
        candidates, unavailable = gather_candidates(causes, locations_of(view, model.fitted, inside), refitter.sheet)
    else:
        candidates, unavailable = renumbered(known, causes), ()
    columns = linearised(refitter, model, view, inside, candidates, [doubt.fault for doubt in doubted], bool(causes))
    layout, free, plain = columns.layout, columns.free, columns.plain
    precision = _known_beforehand(free, doubted, len(runs))
    first = precision.size  # columns in front, which are projected out
    rows = Rows(columns, refitter.jobs)
    alone, rich = noise, 0.0
    if noise is None:
        noise, alone, rich = learn_noise(rows, first, plain, refitter, _shown_at_rest(causes, view, runs, plain))
    grams, samples, squares = _grams(rows, noise, folds, refitter.jobs)
    del rows
    terms = 1 + layout.tangents
    exact = beside_base(grams[:, : first + terms, : first + terms], precision, free)[0]
    front = front_of(grams, precision[free:], free, layout, model, candidates)
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
        measured_noise=alone or noise,
        rich=rich,
        own=columns.own,
        base=columns.base,
    )


def _known_beforehand(free: int, doubted: Sequence[Doubt], runs: int) -> Array:
    """The precision (f,) of the columns in front: none of the ``free`` ones, then that of the faults of each run."""
    each = [np.maximum(doubt.strengths, 1e-300) ** -2.0 for doubt in doubted]
    return np.concatenate([np.zeros(free), *(each * runs)])


def _shown_at_rest(
    causes: Sequence[type[Cause]], view: ModelView, runs: Sequence[ScoredRun], noise: Noise
) -> dict[str, Array]:
    """What faults that need no motion would add to each run (k, kept)."""
    still = [fault for cause in causes for fault in cause().channel_faults(view) if fault.evidence_of == "at_rest"]
    return {run.name: shapes_of(still, view, run, noise) for run in runs}


def _grams(rows: Mapping[str, Array], noise: Noise, folds: Folds, jobs: int) -> tuple[Array, Array, Array]:
    """Gram matrices (folds, c, c) of whitened rows, the number (folds,) of their samples, the mean squares (c,) in N^2.

    Samples that are not independent weigh less in both.
    """

    def seen(run: str) -> tuple[Array, list[tuple[int, Array, float]]]:
        found = rows[run]
        white, share = noise.filter(run, found), noise.independent.get(run, 1.0)
        parts = folds.of_run(run, white.shape[1])
        return np.mean(found**2, axis=1), [
            (fold, share * (white[:, part] @ white[:, part].T), share * (part.stop - part.start))
            for fold, part in parts
        ]

    size = len(next(iter(rows.values())))
    grams, samples, squares = np.zeros((len(folds.names), size, size)), np.zeros(len(folds.names)), np.zeros(size)
    for mean, found in streamed(seen, rows, jobs):
        squares += mean / len(rows)
        for fold, gram, count in found:
            grams[fold] += gram
            samples[fold] += count
    return grams, samples, squares


def learn_noise(
    rows: Mapping[str, Array], first: int, plain: Noise, refitter: Refitter, lines: Mapping[str, Array]
) -> tuple[Noise, Noise, float]:
    """How far the model is from each run, the noise of the records alone, and its RMS in N.

    The first weighs runs and counts independent samples in the search: a model that errs repeats its error with every
    cycle, and whitening that error would judge it by its fastest part. The second is an autoregressive model of what
    all columns together leave. The residual is row ``first``; ``lines`` (k, kept) that a run may show at rest are
    neither. What the columns take up of the noise itself is made up for by the degrees of freedom, where more than
    half of them are left.
    """
    from scipy.linalg import cho_factor, cho_solve

    def weighed(run: str) -> tuple[Array, int]:
        found = rows[run]
        return (found @ found.T) / max(float(np.mean(found[first] ** 2)), 1e-300), found.shape[1]

    size = len(next(iter(rows.values())))
    gram, count = np.zeros((size, size)), 0
    for found, samples in streamed(weighed, rows, refitter.jobs):
        gram += found
        count += samples
    scale = np.sqrt(np.maximum(np.diag(gram), 1e-300))
    matrix, others = gram / np.outer(scale, scale), np.arange(len(scale)) != first
    steadied = matrix[np.ix_(others, others)] + RIDGE * np.eye(len(scale) - 1)
    factor = cho_factor(steadied)
    strengths = np.zeros(len(scale))
    strengths[others] = cho_solve(factor, matrix[others, first])
    strengths *= scale[first] / scale
    used = len(steadied) - RIDGE * float(np.trace(cho_solve(factor, np.eye(len(steadied)))))
    left = 1.0 - used / count
    deviations, shares, filters, squares = {}, {}, {}, []
    for run in refitter.runs:
        found = rows[run.name]
        rest, shapes = found[first] - strengths @ found, lines[run.name]
        line = np.linalg.lstsq(shapes.T, rest, rcond=1e-9)[0] @ shapes
        residual, rest = found[first] - line, rest - line
        smallest = RESOLUTION * max(float(np.std(run.force)), 1e-12)
        deviations[run.name] = max(float(np.sqrt(np.mean(residual**2))), smallest)
        shares[run.name] = independent_share(residual)
        freed = rest / np.sqrt(left) if left > LEFT else residual
        filters[run.name] = learn_filter(freed, smallest)
        squares.append(float(np.mean(freed**2)))
    noise = replace(plain.with_white(deviations), independent=shares)
    return noise, replace(plain, filters=filters), float(np.sqrt(np.mean(squares)))
