"""Boosted trees on what the ridge regression leaves, where scikit-learn is installed (the extra `boosting`).

They grow on one thread: they are small, and threads that wait for each other at every split cost several times as much
where other work shares the processors. Values are sorted into bins here: the library sorts them once for each bin where
samples have weights.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

TREES = 80
RATE = 0.15
LEAVES = 15
BINS = 63
FEWEST_IN_A_LEAF = 40
TAUGHT = 12_000  # samples
FOLDS = 4


@dataclass(frozen=True, eq=False)
class Trees:
    """Trees on the numbers of bins, between ``edges`` (BINS - 1, m)."""

    grown: Any
    edges: Array

    def predict(self, leaves: Array) -> Array:
        """What all trees together tell (n,)."""
        return np.asarray(self.grown.predict(_bins(leaves, self.edges)))

    def after_each(self, leaves: Array) -> Array:
        """What the first one, two, ... of them tell (trees, n)."""
        return np.array(list(self.grown.staged_predict(_bins(leaves, self.edges))))


@dataclass(frozen=True, eq=False)
class Boosted:
    """Trees; ``left`` is the share of the ridge's error that stays with them on samples whose fold was left out."""

    trees: Trees
    left: float

    def predict(self, leaves: Array) -> Array:
        """What they add to the force (n,) N."""
        with _one_thread():
            return self.trees.predict(leaves)


def boost(parts: Sequence[Array], left: Array, weights: Array, folds: NDArray[np.intp], seed: int) -> Boosted | None:
    """Trees on ``left`` (n,) N, what the ridge leaves on samples that it did not see.

    ``parts`` (n_k, m) are what a tree may ask for, ``weights`` (n,) of the samples; ``folds`` (n,) are left out in
    turn to find how many trees predict best. None where they gain less than one standard error over the folds, and
    without scikit-learn.
    """
    if find_spec("sklearn") is None:
        return None
    thin = slice(None, None, max(1, -(-left.size // TAUGHT)))
    asked, left, weights, folds = np.vstack(parts)[thin], left[thin], weights[thin], folds[thin] % FOLDS
    with _one_thread():
        return _chosen(asked, left, weights, folds, seed)


def _one_thread() -> Any:
    import sklearn.ensemble  # noqa: F401 - only a library that is loaded can be limited
    from threadpoolctl import threadpool_limits  # type: ignore[import-untyped]

    return threadpool_limits(1, user_api="openmp")


def _chosen(asked: Array, left: Array, weights: Array, folds: NDArray[np.intp], seed: int) -> Boosted | None:
    """As many trees as predict best, or None."""
    gains = np.array([_gains(asked, left, weights, folds == fold, seed) for fold in np.unique(folds)])
    best = int(np.argmax(gains.sum(axis=0)))
    mean, scatter = gains[:, best].mean(), gains[:, best].std(ddof=1)
    if mean <= scatter / np.sqrt(len(gains)):
        return None
    share = float(np.sqrt(1.0 - gains[:, best].sum() / (weights @ left**2)))
    return Boosted(_grow(asked, left, weights, best + 1, seed), share)


def _bins(values: Array, edges: Array) -> Array:
    """The number of the bin (n, m) of each value (n, m)."""
    return np.column_stack([np.searchsorted(edge, value) for edge, value in zip(edges.T, values.T, strict=True)])


def _gains(asked: Array, left: Array, weights: Array, out: NDArray[np.bool_], seed: int) -> Array:
    """By how much 1, 2, ... trees lower the sum of squares of the samples that are left out."""
    grown = _grow(asked[~out], left[~out], weights[~out], TREES, seed)
    return weights[out] @ left[out] ** 2 - (left[out] - grown.after_each(asked[out])) ** 2 @ weights[out]


def _grow(asked: Array, left: Array, weights: Array, trees: int, seed: int) -> Trees:
    from sklearn.ensemble import HistGradientBoostingRegressor

    maker = HistGradientBoostingRegressor(
        learning_rate=RATE,
        max_iter=trees,
        max_leaf_nodes=LEAVES,
        min_samples_leaf=FEWEST_IN_A_LEAF,
        max_bins=BINS,
        early_stopping=False,
        random_state=seed,
    )
    shares = np.linspace(0.0, 1.0, BINS + 1)[1:-1]
    edges = np.quantile(asked, shares, axis=0, method="inverted_cdf", weights=weights)
    return Trees(maker.fit(_bins(asked, edges), left, sample_weight=weights), edges)
