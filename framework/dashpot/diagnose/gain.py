"""What a cause is worth on runs that took no part: how the error grows without it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.diagnose.folds import FEWEST, whole_cycles

Array = NDArray[np.float64]

PIECES = 8  # of a run
DRAWS = 1000


@dataclass(frozen=True)
class Gain:
    """``value`` = 1 - RMSE with / RMSE without the cause, with its 95 % interval, on ``runs``."""

    value: float
    interval: tuple[float, float]
    runs: str


def measure_gain(
    without: Mapping[str, Array],
    with_it: Mapping[str, Array],
    groups: Mapping[str, str],
    displacement: Mapping[str, Array],
    runs: str,
    seed: int = 0,
) -> Gain | None:
    """The gain from residuals (n,) by run, all runs weighing the same; None without a run.

    The interval comes from drawing groups of runs with replacement, repeats together; where there are few, pieces of
    whole cycles of each run are drawn.
    """
    if not without:
        return None
    names = list(dict.fromkeys(groups[run] for run in without))
    rng = np.random.default_rng(seed)
    if len(names) >= FEWEST:
        squares = np.array(
            [
                [np.mean([np.mean(of[run] ** 2) for run in without if groups[run] == name]) for name in names]
                for of in (without, with_it)
            ]
        )
        draws = squares[:, rng.integers(0, len(names), (DRAWS, len(names)))].mean(axis=2).T
    else:
        draws = np.zeros((DRAWS, 2))
        for run in without:
            edges = whole_cycles(displacement[run], PIECES)
            means = np.array(
                [
                    [np.mean(of[run][first:last] ** 2) for first, last in zip(edges, edges[1:], strict=False)]
                    for of in (without, with_it)
                ]
            )
            draws += means[:, rng.integers(0, means.shape[1], (DRAWS, means.shape[1]))].mean(axis=2).T
    total = np.array([np.mean([np.mean(of[run] ** 2) for run in without]) for of in (without, with_it)])
    low, high = np.quantile([_gain(draw) for draw in draws], [0.025, 0.975])
    return Gain(_gain(total), (float(low), float(high)), runs)


def _gain(squares: Array) -> float:
    return float(1.0 - np.sqrt(squares[1] / squares[0])) if squares[0] > 0.0 else 0.0
