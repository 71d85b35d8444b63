"""Whitened normal equations with what a refit can absorb projected out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.assess.noise import NoiseModel

Array = NDArray[np.float64]
Rows = Mapping[str, Array]


@dataclass(frozen=True, eq=False)
class Normal:
    """Gram matrix (c, c) of whitened rows and their products (c,) with the whitened residual, over ``samples``."""

    gram: Array
    right: Array
    samples: int


@dataclass(frozen=True, eq=False)
class Projected:
    """Scores (m,) of the free rows and their covariance ``spread`` (m, m) in pure noise.

    ``original`` (m,) is what stood in the diagonal of the covariance before the projection.
    """

    scores: Array
    spread: Array
    original: Array
    samples: int


def normal_equations(residual: Rows, rows: Rows, noise: NoiseModel) -> Normal:
    """Sum over runs of residual (n,) and rows (c, n), each whitened by the noise of its run."""
    size = next(iter(rows.values())).shape[0]
    gram, right = np.zeros((size, size)), np.zeros(size)
    for run, values in residual.items():
        white = noise.whiten(run, rows[run])
        gram += white @ white.T
        right += white @ noise.whiten(run, values)
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
    return Projected(scores * free, spread * np.outer(free, free), np.diag(gram)[fixed:], normal.samples)


def stack(*parts: Rows) -> dict[str, Array]:
    """The rows of several kinds on top of one another, run by run."""
    return {run: np.concatenate([part[run] for part in parts]) for run in parts[0]}
