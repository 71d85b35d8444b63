"""Damped Gauss-Newton with bounds, from products of the Jacobian: the framework's own refinement."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import product

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.bounded_step import least_within
from dashpot.fit.coordinates import Coordinates
from dashpot.fit.geodesic import bent_steps
from dashpot.fit.linear import Linear, Loss, linearise
from dashpot.fit.rising_step import rising_step

Array = NDArray[np.float64]

OWN_METHOD = "gauss_newton"  # its name in files
TOLERANCE = 1e-7  # of the loss in a step, the last one
STRIDE = 2.3  # a logarithm moves by no more than this a step: a factor of ten
BOXES = (0.7, 0.2, 0.05)  # smaller ones, each with the two smallest dampings
CREEP, PATIENCE = 1e-2, 3  # of the loss in a step; so many such steps lead along a bent valley
LEAPS = (1.0, 4.0)  # times the way of these steps
BARELY = 1e-5  # of the loss in a step: so many such steps are worth what bent ones cost, a second Jacobian each
DAMPINGS = np.array([0.0, 1e-3, 1e-2, 1e-1, 1.0, 10.0, 1e2, 1e4])
BENT = 5  # of these dampings, from the smallest on: steps of larger ones are too short to leave a valley
TRIED = len(DAMPINGS) + 2 * len(BOXES) + len(LEAPS)  # in a step, at most


class Outcome(Enum):
    """How a refinement ended; the value is the message."""

    CONVERGED = "converged"
    STEPS_SPENT = "the largest number of steps was reached before the fit converged; allow more steps"
    BUDGET_SPENT = "the budget was spent before the fit converged"
    LEFT_BEHIND = "another model was out of reach"
    FAILED = "the simulation is not finite at the start; check the start values"


@dataclass(frozen=True, eq=False)
class Refined:
    """The end of a refinement: ``point`` (p,) in coordinates, its loss in N, parameter vectors spent."""

    point: Array
    loss: float
    outcome: Outcome
    evaluations: int


def refine(
    objective: Loss,
    coordinates: Coordinates,
    start: Array,
    steps: int = 40,
    tolerance: float = TOLERANCE,
    watch: Callable[[float], None] = lambda loss: None,
    budget: int | None = None,
    hopeless: Callable[[Array, float], bool] = lambda point, loss: False,
    thorough: bool = True,
) -> Refined:
    """Walk downhill from ``start`` (p,) until the loss falls by less than ``tolerance`` of itself in a step.

    Each step solves the damped normal equations for a ladder of dampings and tries all of them in one block. A
    ``thorough`` refinement also tries steps within smaller boxes (rectangular trust regions), since a parameter that is
    hardly felt takes the longest stride and spoils every step of little damping; and after some steps that hardly help
    the way that they have come, once and several times as far: in a bent valley steps are short, however far it leads.
    After some that hardly help at all steps are bent as the valley is; see ``bent_steps``.
    Structures of a diagnosis are refitted and compared; one that happens to leap would be ahead, so
    that they do without. The Jacobian counts as one parameter vector for each coordinate, and ``budget`` is the largest
    number of vectors. The second of two steps, each to a point and a loss that are ``hopeless``, is the last one,
    unless a number grew or fell as fast as it may.
    """
    point = coordinates.allowed(start)[0]
    loss = float(objective.losses(coordinates.to_values(point))[0])
    spent, slack, hoped, trail = 1, 1.0, True, [point]
    linear: Linear | None = None
    barely = 0
    if not np.isfinite(loss) or point.size == 0:
        return Refined(point, loss, Outcome.CONVERGED if point.size == 0 else Outcome.FAILED, spent)
    for _ in range(steps):
        bent = BENT if thorough and barely >= PATIENCE else 0
        if budget is not None and spent + 1 + point.size + TRIED + (bent and 1 + point.size + 2 * bent) > budget:
            return Refined(point, loss, Outcome.BUDGET_SPENT, spent)
        if linear is None:
            linear = linearise(objective, coordinates, point)
            spent += 1 + point.size
        tries = candidates(linear, coordinates, point, slack, BOXES if thorough else ())
        tries = np.vstack([tries, *(leaps(coordinates, trail) if thorough else [])])
        if bent:
            straight, dampings = tries[:bent], (slack * DAMPINGS[:bent]).tolist()
            tries = np.vstack([tries, bent_steps(objective, linear, coordinates, point, straight, dampings)])
            spent += 1 + point.size + bent
        losses = _losses(objective, coordinates, tries)
        spent += len(tries)
        best = int(np.argmin(losses))
        watch(min(loss, float(losses[best])))
        if not losses[best] < loss:
            if slack >= 1e4:
                return Refined(point, loss, Outcome.CONVERGED, spent)
            slack *= 100.0
            continue
        strides = _strides(tries[best] - point, coordinates)
        before, loss, point, linear = loss, float(losses[best]), tries[best], None
        slack = max(DAMPINGS[best] / 10.0, 1e-3) if best < len(DAMPINGS) else slack
        barely = barely + 1 if 1.0 - loss / before < BARELY else 0
        trail = [*trail[-PATIENCE:], point] if 1.0 - loss / before < CREEP else [point]
        if 1.0 - loss / before < tolerance:
            return Refined(point, loss, Outcome.CONVERGED, spent)
        hope = not hopeless(point, loss) or strides
        if not (hope or hoped):
            return Refined(point, loss, Outcome.LEFT_BEHIND, spent)
        hoped = hope
    return Refined(point, loss, Outcome.STEPS_SPENT, spent)


def _losses(objective: Loss, coordinates: Coordinates, tries: Array) -> Array:
    """The losses (tried,) of points (tried, p), equal ones simulated once: a short step is the same in all boxes."""
    each, place = np.unique(tries, axis=0, return_inverse=True)
    return objective.losses(coordinates.to_values(each))[place.reshape(-1)]


def candidates(
    linear: Linear, coordinates: Coordinates, point: Array, slack: float = 1.0, boxes: Sequence[float] = ()
) -> Array:
    """Where Gauss-Newton steps from a point (p,) lead within the bounds (tried, p), the undamped one first.

    After the ladder of dampings come steps of which no logarithm moves by more than the half width of one of ``boxes``.
    """
    normal, downhill = linear.normal, -linear.gradient
    free = np.diag(normal) > 0.0
    scale = np.sqrt(np.diag(normal)[free])
    matrix = normal[np.ix_(free, free)] / np.outer(scale, scale)
    tried = [(STRIDE, damping) for damping in DAMPINGS * slack] + list(product(boxes, DAMPINGS[:2]))
    steps = np.zeros((len(tried), point.size))
    place, rising = (point[free], coordinates.unit[free] / scale), _among(coordinates.rising, free)
    for each, (stride, damping) in zip(steps, tried, strict=True):
        low, high = (side[free] * scale for side in _reach(coordinates, point, stride))
        damped = matrix + damping * np.eye(free.sum())
        each[free] = rising_step(least_within, damped, downhill[free] / scale, (low, high), place, rising) / scale
    return coordinates.allowed(coordinates.moved(point, steps), np.where(free, np.diag(normal), 0.0))


def leaps(coordinates: Coordinates, trail: list[Array]) -> list[Array]:
    """Where the way of the last short steps leads if it goes on (leaps, p); nothing as long as they are few."""
    if len(trail) <= PATIENCE:
        return []
    way = np.outer(LEAPS, trail[-1] - trail[0])
    return [coordinates.allowed(trail[-1] + way)]


def _among(rising: tuple[tuple[int, ...], ...], free: NDArray[np.bool_]) -> list[list[int]]:
    """The groups of knots by their places among the parameters that are free."""
    place = np.cumsum(free) - 1
    return [[int(place[knot]) for knot in knots if free[knot]] for knots in rising]


def _reach(coordinates: Coordinates, point: Array, stride: float) -> tuple[Array, Array]:
    """How far each number may move down and up in one step, in natural steps; logarithms by ``stride`` at most."""
    most = np.where(coordinates.log, stride, np.inf)
    low, high = np.maximum(coordinates.low - point, -most), np.minimum(coordinates.high - point, most)
    grown = np.where(coordinates.log, np.expm1(np.minimum(high, stride)), high)
    return low / coordinates.unit, grown / coordinates.unit


def _strides(move: Array, coordinates: Coordinates) -> bool:
    steps = np.abs(move / coordinates.unit)[coordinates.log]
    return bool(np.any(steps > 0.9 * STRIDE))
