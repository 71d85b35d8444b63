"""Groups of specimens that are alike."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Groups = NDArray[np.int64]

MOST_GROUPS = 5
DRAWS = 39  # that one group more must outdo, which is by chance in one of 40 campaigns
FEWEST = 8
LEAST = 1e-6  # of the largest variance, below which a direction tells nothing
NARROWEST = 1e-3  # variance within groups, of that of all
STEPS, ENOUGH = 50, 1e-4  # of the EM algorithm, and the change of a log-likelihood with which it ends


@dataclass(frozen=True, eq=False)
class _Mixture:
    """k normal distributions of one covariance (p, p): ``shares`` (k,), ``centers`` (k, p), ``belongs`` (n, k)."""

    shares: Array
    centers: Array
    covariance: Array
    belongs: Array
    likelihood: float


def groups_alike(deviations: Array, between: Array, seed: int) -> Groups:
    """The group (n,) of each specimen, from 1, by deviations (n, p) with the covariance ``between`` (p, p).

    A mixture of normal distributions with one covariance. There is a group more as long as that makes the likelihood
    larger than it does for any of ``DRAWS`` campaigns drawn from the mixture without it.

    Source: McLachlan, Applied Statistics 36 (1987) 318.
    """
    values, vectors = np.linalg.eigh(between)
    kept = values > LEAST * values[-1]
    # the groups that EM starts from are looked for in units of each number's own scatter, too
    back = (vectors[:, kept] * np.sqrt(values[kept])).T / np.sqrt(between.diagonal().clip(LEAST * values[-1]))
    rows = deviations @ (vectors[:, kept] / np.sqrt(values[kept]))
    most = min(MOST_GROUPS, len(rows) // 4)
    if len(rows) < FEWEST or most < 2:
        return np.ones(len(rows), dtype=np.int64)
    rng, found = np.random.default_rng(seed), _fitted(rows, 1, back)
    for count in range(2, most + 1):
        more = _fitted(rows, count, back)
        if more.likelihood - found.likelihood <= max(_gains(rng, found, count, back)):
            break
        found = more
    return _numbered(np.argmax(found.belongs, axis=1))


def _gains(rng: np.random.Generator, mixture: _Mixture, count: int, back: Array) -> Sequence[float]:
    """What a group more makes of the log-likelihood of specimens drawn from a mixture."""
    found = []
    for _ in range(DRAWS):
        which = rng.choice(len(mixture.shares), len(mixture.belongs), p=mixture.shares)
        noise = rng.multivariate_normal(np.zeros(len(mixture.covariance)), mixture.covariance, len(which))
        rows = mixture.centers[which] + noise
        found.append(_fitted(rows, count, back).likelihood - _fitted(rows, count - 1, back).likelihood)
    return found


def _fitted(rows: Array, count: int, back: Array) -> _Mixture:
    """The likelier one of two that start from groups by Ward's method, in two scales."""
    if count == 1:
        return _climbed(rows, np.ones((len(rows), 1)))
    starts = [_grouped(each, count) for each in (rows, rows @ back)]
    climbed = [_climbed(rows, np.eye(count)[start - 1]) for start in starts]
    return max(climbed, key=lambda mixture: mixture.likelihood)


def _climbed(rows: Array, belongs: Array) -> _Mixture:
    """The EM algorithm from how far each row (n, p) belongs to each group (n, k)."""
    floor, before = NARROWEST * np.eye(rows.shape[1]), -np.inf
    for _ in range(STEPS):
        sizes = belongs.sum(axis=0).clip(1e-9)
        centers = belongs.T @ rows / sizes[:, None]
        apart = rows[:, None] - centers
        covariance = np.einsum("nk,nki,nkj->ij", belongs, apart, apart) / len(rows) + floor
        factor = np.linalg.cholesky(covariance)
        squares = np.sum(np.linalg.solve(factor, apart.reshape(-1, len(factor)).T) ** 2, axis=0).reshape(len(rows), -1)
        logs = np.log(sizes / sizes.sum()) - 0.5 * squares
        top = logs.max(axis=1, keepdims=True)
        total = top + np.log(np.exp(logs - top).sum(axis=1, keepdims=True))
        belongs = np.exp(logs - total)
        likelihood = float(total.sum() - len(rows) * np.log(factor.diagonal()).sum())
        if likelihood - before < ENOUGH:
            break
        before = likelihood
    return _Mixture(sizes / sizes.sum(), centers, covariance, belongs, likelihood)


def _grouped(rows: Array, count: int) -> Groups:
    from scipy.cluster.hierarchy import fcluster, ward

    return np.asarray(fcluster(ward(rows), count, "maxclust"), dtype=np.int64)


def _numbered(groups: Groups) -> Groups:
    """Groups numbered from 1 in the order of their first specimens."""
    order = list(dict.fromkeys(groups.tolist()))
    return np.array([1 + order.index(each) for each in groups.tolist()], dtype=np.int64)
