"""How much the parameters depend on which runs were measured: refits on runs drawn with replacement."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.algebra import single_threaded_algebra
from dashpot.fit.coordinates import Coordinates
from dashpot.fit.objective import Objective
from dashpot.fit.order import Interchangeable, in_order
from dashpot.fit.refine import refine
from dashpot.kernel.workers import pieces

if TYPE_CHECKING:
    from dashpot.kernel.workers import Jobs

Array = NDArray[np.float64]

STEPS = 8
TOLERANCE = 1e-5
QUANTILES = (2.5, 97.5)


def bootstrap_intervals(
    objective: Objective,
    coordinates: Coordinates,
    point: Array,
    groups: Sequence[tuple[str, str]],
    draws: int,
    seed: int,
    jobs: Jobs = 1,
    families: tuple[Interchangeable, ...] = (),
) -> tuple[tuple[float, float], ...]:
    """95 % percentile intervals in SI from ``draws`` refits, each from the fitted point (p,).

    ``groups`` (runs,) holds for each run of the objective its kind and its group of repeats: whole groups are drawn,
    each kind for itself, so that a kind of test that was made once takes part in every draw. The intervals hold what
    differs from run to run, such as model errors, beside the noise. Branches of the ``families`` stand in order in
    each refit, and each refit is a piece of work for ``jobs``.

    Source: Davison and Hinkley, Bootstrap methods and their application (1997), section 2.4 and 3.8.
    """
    rng = np.random.default_rng(seed)
    drawn = [objective.shares * _drawn(groups, rng) for _ in range(draws)]
    found = pieces(_refitted, (objective, coordinates, point, families), drawn, jobs)
    low, high = np.percentile(np.array(found), QUANTILES, axis=0)
    return tuple(zip(coordinates.numbers(low), coordinates.numbers(high), strict=True))


@single_threaded_algebra
def _refitted(shared: tuple[Objective, Coordinates, Array, tuple[Interchangeable, ...]], weights: Array) -> Array:
    objective, coordinates, point, families = shared
    refined = refine(objective.weighing(weights.tolist()), coordinates, point, STEPS, TOLERANCE).point
    return coordinates.of_values(in_order(families, coordinates.to_values(refined))[0])


def _drawn(groups: Sequence[tuple[str, str]], rng: np.random.Generator) -> Array:
    """How often each run was drawn (runs,)."""
    counts: dict[tuple[str, str], int] = dict.fromkeys(groups, 0)
    for kind in dict.fromkeys(kind for kind, _ in groups):
        alike = [group for group in counts if group[0] == kind]
        for number in rng.integers(len(alike), size=len(alike)):
            counts[alike[number]] += 1
    return np.array([counts[group] for group in groups], dtype=float)
