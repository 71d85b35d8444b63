"""Groups of specimens that are alike."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

MOST_GROUPS = 5
DRAWS = 60
FEWEST = 8
LEAST = 1e-6  # of the largest variance, below which a direction tells nothing


def groups_alike(deviations: Array, between: Array, seed: int) -> NDArray[np.int64]:
    """The group (n,) of each specimen, from 1, by deviations (n, p) with the covariance ``between`` (p, p).

    Ward's method, with as many groups as the gap statistic finds against a single normal population; all are in one
    group where that explains them.

    Sources: Ward, J. Am. Stat. Assoc. 58 (1963) 236; Tibshirani, Walther and Hastie, J. R. Stat. Soc. B 63 (2001) 411.
    """
    values, vectors = np.linalg.eigh(between)
    kept = values > LEAST * values[-1]
    white = deviations @ (vectors[:, kept] / np.sqrt(values[kept]))
    most = min(MOST_GROUPS, len(white) // 4)
    if len(white) < FEWEST or most < 2:
        return np.ones(len(white), dtype=np.int64)
    rng, spread = np.random.default_rng(seed), np.cov(white.T).reshape(white.shape[1], white.shape[1])
    drawn = np.array(
        [_dispersions(rng.multivariate_normal(np.zeros(len(spread)), spread, len(white)), most) for _ in range(DRAWS)]
    )
    gap = drawn.mean(axis=0) - _dispersions(white, most)
    doubt = np.sqrt(1.0 + 1.0 / DRAWS) * drawn.std(axis=0)
    chosen = next((k for k in range(most - 1) if gap[k] >= gap[k + 1] - doubt[k + 1]), most - 1)
    return _grouped(white, chosen + 1)


def _dispersions(rows: Array, most: int) -> Array:
    """Logarithms of the squares within 1, 2, ... groups."""
    return np.log([max(_within(rows, _grouped(rows, count)), 1e-300) for count in range(1, most + 1)])


def _grouped(rows: Array, count: int) -> NDArray[np.int64]:
    from scipy.cluster.hierarchy import fcluster, ward

    return np.asarray(fcluster(ward(rows), count, "maxclust"), dtype=np.int64)


def _within(rows: Array, groups: NDArray[np.int64]) -> float:
    return sum(float(np.sum((rows[groups == each] - rows[groups == each].mean(axis=0)) ** 2)) for each in set(groups))
