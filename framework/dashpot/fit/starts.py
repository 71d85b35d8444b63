"""Refining from several starts: a screening block with a start from a dictionary of branches, then the best of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.coordinates import Coordinates
from dashpot.fit.dictionary import dictionary_start
from dashpot.fit.linear import Loss
from dashpot.fit.objective import Objective
from dashpot.fit.refine import Refined, refine

Array = NDArray[np.float64]

LANES = 96
KEPT = 4
RESERVED = 2  # parameter vectors: the start of a refinement, and that of the last one
FIRST_STEPS, LAST_STEPS = 20, 60
NEAR = 1.0  # scatter of starts around the file's, in natural steps: a factor of e


@dataclass(frozen=True, eq=False)
class Best:
    """The best refinement, the losses of all starts (best first), parameter vectors spent, best loss on the way.

    ``ends`` (starts, p) are where the starts have led in their first steps, in the order of their losses.
    """

    refined: Refined
    spread: tuple[float, ...]
    evaluations: int
    history: tuple[tuple[int, float], ...]
    ends: Array


def refine_from_starts(
    objective: Objective,
    coordinates: Coordinates,
    seed: int,
    watch: Callable[[float, float], None],
    budget: int | None = None,
    loss: Loss | None = None,
) -> Best:
    """The file's start and the best of a block of others, a few steps each; the best of them to its end.

    The others are random, and one comes from a dictionary of branches where there is no ``budget``. What is refined is
    the ``loss``, by default that of the objective.

    ``watch(done, loss)`` hears of the progress; ``budget`` is the largest number of parameter vectors.
    """
    start, whole = coordinates.start, objective if loss is None else loss
    if start.size == 0:
        only = float(whole.losses(coordinates.to_values(start))[0])
        return Best(refine(whole, coordinates, start), (only,), 1, ((1, only),), start[None])
    points = _scatter(coordinates, start, np.random.default_rng(seed))
    linear = dictionary_start(objective, coordinates) if budget is None else None
    if budget is not None:
        points = points[: max(budget - RESERVED, 1)]
    points = np.concatenate([points, linear.point[None]]) if linear else points
    losses = whole.losses(coordinates.to_values(points))
    order = [0, *(int(k) for k in np.argsort(losses)[:KEPT] if k != 0)]
    spent = len(points) + (linear.evaluations if linear else 0)
    history = [(spent, float(losses.min()))]
    ends: list[Refined] = []
    for number, k in enumerate(order):
        if ends and budget is not None and budget - spent < RESERVED:
            break
        ends.append(refine(whole, coordinates, points[k], FIRST_STEPS, budget=_left(budget, spent)))
        spent += ends[-1].evaluations
        history.append((spent, min(end.loss for end in ends)))
        watch((number + 1) / (len(order) + 1), history[-1][1])
    ends.sort(key=lambda end: end.loss)
    best = refine(whole, coordinates, ends[0].point, LAST_STEPS, budget=_left(budget, spent))
    spent += best.evaluations
    history.append((spent, best.loss))
    places = np.array([end.point for end in ends])
    return Best(best, tuple(end.loss for end in ends), spent, tuple(history), places)


def _left(budget: int | None, spent: int) -> int | None:
    return None if budget is None else budget - spent


def _scatter(coordinates: Coordinates, start: Array, rng: np.random.Generator) -> Array:
    near = start + NEAR * coordinates.unit * rng.standard_normal((LANES // 2, start.size))
    far = coordinates.from_cube(rng.random((LANES - len(near) - 1, start.size)))
    return np.clip(np.concatenate([start[None], near, far]), coordinates.low, coordinates.high)
