"""Ridge regression by Gram matrices; the strength for each family of columns is chosen by cross-validation."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Gram = tuple[Array, Array, float]  # (p, p) of the columns, (p,) with the force, and its square

STRENGTHS = (1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1.0, np.inf)  # of the mean square of a column; the last one leaves it out
FIRST = 1e-6
SWEEPS = 3
ROUNDING = 1e-13
BEYOND = 0.1  # of the range of a column in training, as far as it may go on other runs


@dataclass(frozen=True, eq=False)
class Ridge:
    """``weights`` (p,) for columns within ``low`` and ``high`` (p,).

    ``error`` is the root mean square in N on samples whose fold was left out, ``unseen`` (n,) what it predicted there;
    ``left_out`` the same where the fit to all samples counts as much as one fold, so that what the other folds hardly
    tell is not put to the test.
    """

    weights: Array
    low: Array
    high: Array
    error: float
    unseen: Array
    left_out: float

    def predict(self, columns: Array) -> Array:
        """The force (n,) N for columns (n, p); those that go beyond the training runs stop there."""
        return np.clip(columns, self.low, self.high) @ self.weights


def fit_ridge(
    parts: Iterable[Array], force: Array, weights: Array, folds: NDArray[np.intp], families: Sequence[int]
) -> Ridge:
    """The ridge regression of ``force`` (n,) N on the columns, given in ``parts`` (n_k, p).

    ``weights`` (n,) of the samples; ``folds`` (n,) are left out in turn; ``families`` are numbers of columns that share
    a strength, from the plainest to the richest family. The first family is always there.
    """
    columns = _stacked(parts, force.size)
    low, high = columns.min(axis=0), columns.max(axis=0)
    size = np.sqrt(np.einsum("i,ij,ij->j", weights, columns, columns) / weights.sum())
    size[size == 0.0] = 1.0
    columns /= size
    numbers = np.unique(folds)
    grams = [_gram(columns[folds == fold], force[folds == fold], weights[folds == fold]) for fold in numbers]
    penalty = np.repeat(_strengths(grams, families), families) * weights.sum()
    unseen = np.empty(force.size)
    for fold, others in zip(numbers, _all_but_one(grams), strict=True):
        unseen[folds == fold] = columns[folds == fold] @ _solve(others, penalty)
    slack, fit = BEYOND * (high - low), _solve(_sum(grams), penalty)
    error = float(np.sqrt(weights @ (force - unseen) ** 2 / weights.sum()))
    left_out = float(np.sqrt(_error(grams, _all_but_one(grams, fit), penalty) / weights.sum()))
    return Ridge(fit / size, low - slack, high + slack, error, unseen, left_out)


def _stacked(parts: Iterable[Array], samples: int) -> Array:
    """The parts (n_k, p) below one another, of which only one is there at a time."""
    first = next(each := iter(parts))
    found = np.empty((samples, first.shape[1]))
    found[: len(first)], at = first, len(first)
    for part in each:
        found[at : at + len(part)] = part
        at += len(part)
    return found


def _gram(columns: Array, force: Array, weights: Array) -> Gram:
    root = np.sqrt(weights)
    weighted, aim = columns * root[:, None], force * root
    return weighted.T @ weighted, weighted.T @ aim, float(aim @ aim)


def _sum(grams: Sequence[Gram]) -> Gram:
    return sum(gram[0] for gram in grams), sum(gram[1] for gram in grams), sum(gram[2] for gram in grams)  # type: ignore[return-value]


def _all_but_one(grams: Sequence[Gram], fit: Array | None = None) -> list[Gram]:
    """All but each of them; what a ``fit`` (p,) predicts of all samples joins as one more if there is one."""
    whole = _sum(grams)
    others = [(whole[0] - gram[0], whole[1] - gram[1], whole[2] - gram[2]) for gram in grams]
    if fit is None:
        return others
    told = whole[0] / len(grams)
    return [(square + told, right + told @ fit, rest) for square, right, rest in others]


def _strengths(grams: Sequence[Gram], families: Sequence[int]) -> Array:
    """A strength for each family, from the plainest model upwards and from the richest downwards; the better one."""
    others, total = _all_but_one(grams), sum(gram[0].trace() for gram in grams) / sum(families)

    def error(strengths: Array, lowest: float = np.inf) -> float:
        return _error(grams, others, np.repeat(strengths, families) * total, lowest)

    plain = np.array([FIRST] + [np.inf] * (len(families) - 1))
    return min((_descend(error, start) for start in (plain, np.full(len(families), FIRST))), key=error)


def _descend(error: Callable[[Array, float], float], chosen: Array) -> Array:
    """The strength of one family after the other, until none changes."""
    lowest, seen = error(chosen, np.inf), {tuple(chosen)}
    for _ in range(SWEEPS):
        before = chosen
        for family in range(len(chosen)):
            for strength in STRENGTHS[: -1 if family == 0 else None]:
                tried = np.where(np.arange(len(chosen)) == family, strength, chosen)
                if tuple(tried) in seen:  # what was not lower then is not lower than the lowest one now
                    continue
                seen.add(tuple(tried))
                if (found := error(tried, lowest)) < lowest:
                    lowest, chosen = found, tried
        if np.array_equal(before, chosen):
            break
    return chosen


def _error(grams: Sequence[Gram], others: Sequence[Gram], penalty: Array, lowest: float = np.inf) -> float:
    """The sum of squares on the folds left out; infinite as soon as it is above the ``lowest`` one known."""
    total = 0.0
    for (gram, right, square), other in zip(grams, others, strict=True):
        solved = _solve(other, penalty)
        # a force that is explained to the last digit leaves rounding alone, of either sign
        total += max(0.0, float(square - 2.0 * right @ solved + solved @ gram @ solved))
        if total > lowest:
            return np.inf
    return total


def _solve(gram: Gram, penalty: Array) -> Array:
    """Coefficients (p,); 0 where the penalty (p,) is infinite."""
    from scipy.linalg import cho_factor, cho_solve

    kept = np.flatnonzero(np.isfinite(penalty))
    least = ROUNDING * kept.size * float(gram[0].diagonal().max())
    matrix = gram[0].take(kept, axis=0).take(kept, axis=1)
    matrix.ravel()[:: kept.size + 1] += np.maximum(penalty[kept], least)
    solved = np.zeros(penalty.size)
    # symmetric: the transpose is what LAPACK can work on where it lies
    factor = cho_factor(matrix.T, overwrite_a=True, check_finite=False)
    solved[kept] = cho_solve(factor, gram[1][kept], check_finite=False)
    return solved
