"""Whitened normal equations with what a refit can absorb projected out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.assess.noise import NoiseModel
from dashpot.kernel.workers import spread

Array = NDArray[np.float64]
Places = NDArray[np.intp]
Rows = Mapping[str, Array]

STEADY = 1e-5  # of the square of a row


@dataclass(frozen=True, eq=False)
class Normal:
    """Gram matrix (c, c) of whitened rows and their products (c,) with the whitened residual, over ``samples``."""

    gram: Array
    right: Array
    samples: int


@dataclass(frozen=True, eq=False)
class Projected:
    """Scores (m,) of the free rows and their covariance ``spread`` (m, m) in pure noise.

    ``original`` (m,) is what stood in the diagonal of the covariance before the projection. ``absorbed`` (fixed, m) are
    the strengths at which the fixed rows come near to one of each free row, held where they can hardly be told apart.
    """

    scores: Array
    spread: Array
    original: Array
    samples: int
    absorbed: Array


@dataclass(frozen=True, eq=False)
class SparseRows:
    """Rows of which each run has only some: ``values[run]`` (k, n) stand at ``places[run]`` (k,) of ``size`` rows."""

    values: Rows
    places: Mapping[str, Places]
    size: int

    @classmethod
    def of(cls, rows: Rows) -> SparseRows:
        """Rows (c, n) by run, those that are zero throughout left out."""
        places = {run: np.flatnonzero(values.any(axis=1)) for run, values in rows.items()}
        size = next(iter(rows.values())).shape[0] if rows else 0
        return cls({run: values[places[run]] for run, values in rows.items()}, places, size)

    @classmethod
    def dense(cls, rows: Rows) -> SparseRows:
        """Rows (c, n) by run, all of them."""
        size = next(iter(rows.values())).shape[0] if rows else 0
        return cls(rows, {run: np.arange(size) for run in rows}, size)

    def combined(self, strengths: Array, run: str) -> Array:
        """The sum (n,) of the rows of a run, each times its strength (size,)."""
        here = strengths[self.places[run]]
        acting = np.flatnonzero(here)
        return here[acting] @ self.values[run][acting] if acting.size < here.size else here @ self.values[run]


def normal_equations(
    residual: Rows,
    rows: SparseRows | Sequence[SparseRows],
    noise: NoiseModel,
    jobs: int = 1,
    known: Array | None = None,
) -> Normal:
    """Sum over runs of residual (n,) and rows (c, n), each whitened by the noise of its run.

    Rows of several kinds stand behind one another; ``jobs`` runs are worked on at once, the longest first. ``known`` is
    the Gram matrix of all kinds behind the first one, where that is known of the same noise.
    """
    kinds = [rows] if isinstance(rows, SparseRows) else list(rows)
    first = np.cumsum([0] + [kind.size for kind in kinds])
    gram, right = np.zeros((first[-1], first[-1])), np.zeros(first[-1])

    def products(run: str) -> tuple[Array, Array]:
        kinds_of_run = [noise.whiten(run, kind.values[run]) for kind in kinds]
        white = np.concatenate(kinds_of_run)
        sought = white if known is None else kinds_of_run[0]
        return sought @ white.T, white @ noise.whiten(run, residual[run])

    runs = sorted(residual, key=lambda run: residual[run].size, reverse=True)
    for run, (squares, products_with_residual) in zip(runs, spread(products, runs, jobs=jobs), strict=True):
        at = np.concatenate([kind.places[run] + shift for kind, shift in zip(kinds, first[:-1], strict=True)])
        gram[np.ix_(at[: len(squares)], at)] += squares
        right[at] += products_with_residual
    if known is not None:
        gram[first[1] :, : first[1]] = gram[: first[1], first[1] :].T
        gram[first[1] :, first[1] :] = known
    return Normal(gram, right, sum(values.size for values in residual.values()))


def project_out(normal: Normal, fixed: int, precision: Array | None = None) -> Projected:
    """The rows behind the first ``fixed`` ones, with those projected out (Schur complement).

    ``precision`` (fixed,) is what is known of the strengths of the fixed rows beforehand, 1/variance; 0 for nothing.
    """
    gram = normal.gram.copy()
    if precision is not None:
        gram[np.arange(fixed), np.arange(fixed)] += precision
    scale = np.sqrt(np.maximum(np.diag(gram), 1e-300))
    inside, right = gram / np.outer(scale, scale), normal.right / scale
    solve = np.linalg.pinv(inside[:fixed, :fixed], rcond=1e-11, hermitian=True) @ inside[:fixed]
    spread = inside[fixed:, fixed:] - inside[fixed:, :fixed] @ solve[:, fixed:]
    scores = right[fixed:] - solve[:, fixed:].T @ right[:fixed]
    free = scale[fixed:]
    steady = np.linalg.solve(inside[:fixed, :fixed] + STEADY * np.eye(fixed), inside[:fixed, fixed:])
    absorbed = steady * free / scale[:fixed, None]
    return Projected(scores * free, spread * np.outer(free, free), np.diag(gram)[fixed:], normal.samples, absorbed)


def stack(*parts: SparseRows) -> SparseRows:
    """The rows of several kinds on top of one another, run by run."""
    first = np.cumsum([0] + [part.size for part in parts])
    runs = parts[0].values
    values = {run: np.concatenate([part.values[run] for part in parts]) for run in runs}
    places = {
        run: np.concatenate([part.places[run] + shift for part, shift in zip(parts, first[:-1], strict=True)])
        for run in runs
    }
    return SparseRows(values, places, int(first[-1]))


def side_by_side(one: SparseRows, other: SparseRows) -> SparseRows:
    """Rows of the same numbering of which each part has some, as precise as those of the other part."""
    values = {
        run: np.concatenate([one.values[run], rows], dtype=rows.dtype, casting="same_kind")
        for run, rows in other.values.items()
    }
    places = {run: np.concatenate([one.places[run], other.places[run]]) for run in one.values}
    return SparseRows(values, places, one.size)
