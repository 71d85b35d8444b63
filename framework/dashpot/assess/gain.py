"""What an extension gains on runs that took no part in it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

BLOCK_SECONDS = 0.25
DRAWS = 1000
HELD_OUT = "held-out runs"


@dataclass(frozen=True)
class Gain:
    """``value`` = 1 - RMSE after / RMSE before, with its 95 % interval; ``runs`` says on which runs."""

    value: float
    interval: tuple[float, float]
    runs: str = HELD_OUT


def measure_gain(before: Sequence[Array], after: Sequence[Array], steps: Sequence[float], seed: int = 0) -> Gain | None:
    """The gain from misfits (samples,) of every held-out run; None without one.

    All runs weigh the same. The interval comes from resampling blocks of a quarter of a second within every run.
    """
    if not before:
        return None
    means = [_block_means(b, a, step) for b, a, step in zip(before, after, steps, strict=True)]
    value = _gain(np.mean([m.mean(axis=1) for m in means], axis=0))
    rng = np.random.default_rng(seed)
    draws = np.zeros((DRAWS, 2))
    for mean in means:
        picks = rng.integers(0, mean.shape[1], (DRAWS, mean.shape[1]))
        draws += mean[:, picks].mean(axis=2).T
    low, high = np.quantile([_gain(draw) for draw in draws], [0.025, 0.975])
    return Gain(value, (float(low), float(high)))


def crossed(misfit: Array, rows: Array, step: float) -> Array:
    """A misfit (n,) with ``rows`` (k, n) taken out whose strengths were found on the other half of its pieces.

    Pieces of a quarter of a second belong to the halves in turn.
    """
    half = (np.arange(misfit.size) * step / BLOCK_SECONDS).astype(int) % 2 == 0
    left = np.empty_like(misfit)
    for judged in (half, ~half):
        found = np.linalg.lstsq(rows[:, ~judged].T, misfit[~judged], rcond=1e-10)[0]
        left[judged] = misfit[judged] - found @ rows[:, judged]
    return left


def _block_means(before: Array, after: Array, step: float) -> Array:
    count = max(2, int(before.size * step / BLOCK_SECONDS))
    edges = np.linspace(0, before.size, count + 1).astype(int)[:-1]
    sizes = np.diff(np.append(edges, before.size))
    return np.array([np.add.reduceat(errors**2, edges) / sizes for errors in (before, after)])


def _gain(squares: Array) -> float:
    return float(1.0 - np.sqrt(squares[1] / squares[0])) if squares[0] > 0.0 else 0.0
