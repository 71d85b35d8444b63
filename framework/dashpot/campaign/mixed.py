"""How specimens scatter, beyond what each of them is known to: a linear model with mixed effects.

The parameters of a specimen are y = B' x + b + e: what its properties x make of the mean, its own deviation b with the
covariance that all specimens share, and its error e whose covariance is known.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

LEVEL = 0.975
MOST_STEPS = 3000
ENOUGH = 1e-8  # relative change of the covariance in a step
LEAST = 1e-12  # of the first covariance, so that it can grow and be inverted


@dataclass(frozen=True, eq=False)
class Mixed:
    """The population of p numbers whose means depend on q columns of a design.

    ``means`` (q, p) with ``widths`` (q, p), half of their 95 % intervals; ``between`` (p, p) is the covariance of the
    specimens' own deviations, ``deviations`` (n, p), and ``scatter`` (p, 2) the 95 % interval of its standard
    deviations. ``covariance`` (p q, p q) is that of the means, number by number; ``freedom`` their degrees of freedom.
    ``moments`` (n, p, p) are the expected squares of each deviation, of which ``between`` is the weighted mean.
    """

    means: Array
    widths: Array
    between: Array
    deviations: Array
    scatter: Array
    covariance: Array
    freedom: float
    moments: Array


def fit_mixed(at: Array, errors: Array, design: Array, weights: Array | None = None) -> Mixed:
    """Restricted maximum likelihood for numbers ``at`` (n, p) with known ``errors`` (n, p, p) over a design (n, q).

    ``weights`` (n,) from 0 to 1 say how far each specimen counts. Every step of the EM algorithm makes the likelihood
    larger and keeps the covariance positive. The interval of a standard deviation takes the variance of the parameters,
    between specimens and of typical errors together, as a multiple of chi-square, as it is where errors are alike.

    Sources: Laird and Ware, Biometrics 38 (1982) 963; Searle, Casella and McCulloch, Variance components (1992);
    Higgins and Thompson, Statistics in Medicine 21 (2002) 1539, for the typical error.
    """
    weights = np.ones(len(at)) if weights is None else weights
    scale = np.sqrt(np.average((at - np.average(at, axis=0, weights=weights)) ** 2, axis=0, weights=weights))
    scale = np.where(scale > 0.0, scale, 1.0)
    y, noise = at / scale, errors / np.outer(scale, scale)
    between = np.eye(at.shape[1])
    for _ in range(MOST_STEPS):
        before, (means, covariance, deviations, moments) = between, _step(y, noise, design, weights, between)
        between = _mean_moment(moments, weights)
        if np.abs(between - before).max() <= ENOUGH * np.abs(before).max():
            break
    return _in_units(scale, means, covariance, between, deviations, moments, noise, weights)


def _step(y: Array, noise: Array, design: Array, weights: Array, between: Array) -> tuple[Array, Array, Array, Array]:
    """Means (q, p), their covariance, the deviations of the specimens and their expected squares."""
    p, q = y.shape[1], design.shape[1]
    inverse = np.linalg.inv(between + noise)
    normal = np.einsum("n,njk,na,nb->jakb", weights, inverse, design, design).reshape(p * q, p * q)
    covariance = np.linalg.inv(normal)
    right = np.einsum("n,njk,nk,na->ja", weights, inverse, y, design).reshape(p * q)
    means = (covariance @ right).reshape(p, q).T
    gain = between @ inverse
    deviations = np.einsum("njk,nk->nj", gain, y - design @ means)
    told = np.einsum("na,jakb,nb->njk", design, covariance.reshape(p, q, p, q), design)
    left = between - gain @ between + gain @ told @ gain.transpose(0, 2, 1)
    return means, covariance, deviations, deviations[:, :, None] * deviations[:, None, :] + left


def _mean_moment(moments: Array, weights: Array) -> Array:
    found = np.einsum("n,njk->jk", weights, moments) / weights.sum()
    return 0.5 * (found + found.T) + LEAST * np.eye(len(found))


def _in_units(
    scale: Array,
    means: Array,
    covariance: Array,
    between: Array,
    deviations: Array,
    moments: Array,
    noise: Array,
    weights: Array,
) -> Mixed:
    from scipy.special import stdtrit

    q = len(means)
    freedom = max(float(weights.sum()) - q, 1.0)
    long = np.repeat(scale, q)
    covariance = covariance * np.outer(long, long)
    widths = stdtrit(freedom, LEVEL) * np.sqrt(covariance.diagonal()).reshape(-1, q).T
    typical = _typical(noise.diagonal(axis1=1, axis2=2), weights)
    square = np.outer(scale, scale)
    return Mixed(
        means * scale,
        widths,
        between * square,
        deviations * scale,
        scale[:, None] * _scatter_interval(between.diagonal(), typical, freedom),
        covariance,
        freedom,
        moments * square,
    )


def _typical(variances: Array, weights: Array) -> Array:
    """The variance (p,) of errors that stands for those of all specimens (n, p): the precise ones count most."""
    known = weights[:, None] / variances
    return (weights.sum() - 1.0) * known.sum(axis=0) / (known.sum(axis=0) ** 2 - (known**2).sum(axis=0))


def _scatter_interval(between: Array, errors: Array, freedom: float) -> Array:
    from scipy.special import chdtri

    total = freedom * (between + errors)
    ends = np.array([total / chdtri(freedom, 1.0 - LEVEL), total / chdtri(freedom, LEVEL)]).T - errors[:, None]
    return np.sqrt(np.maximum(ends, 0.0))
