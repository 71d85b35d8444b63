"""Priors in a fit: residual terms beside the data, weighed by how much the data say.

With misfits r in N and a prior of a parameter with the mean m and the deviation s, a fit minimises

    sum of r^2 / e^2 + sum of ((parameter - m) / s)^2 ,

with the logarithms of both for a lognormal prior. The error e in N is what a sample counts for: with white noise its
standard deviation, with coloured residuals or a model error so much more that the data determine the parameters as well
as the intervals of a fit without priors say; see ``effective_error``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.coordinates import Coordinates
from dashpot.fit.kept_curves import Refinement
from dashpot.fit.known import STANDARD
from dashpot.fit.linear import STEP, Loss
from dashpot.fit.objective import Objective
from dashpot.fit.refine import TOLERANCE, Refined, refine
from dashpot.fit.uncertainty import effective_error
from dashpot.model.network import NetworkSpec, Value
from dashpot.model.prior import Prior
from dashpot.text.problem import InputError, Place, Problem

Array = NDArray[np.float64]
Result = TypeVar("Result")

ROUNDS = 2  # of a refinement with priors
ONE_PERCENT = 0.01  # of the swing of the force: the error while a search has not found any better one


@dataclass(frozen=True, eq=False)
class Priors:
    """The priors of a network: the slots (k,) that have one, which are lognormal, middles and deviations (k,).

    ``paths`` are the paths of the slots. Middles and deviations are in SI, of a lognormal prior in logarithms.
    """

    paths: tuple[str, ...]
    slots: NDArray[np.int64]
    log: NDArray[np.bool_]
    middle: Array
    deviation: Array

    def pulls(self, values: Array) -> Array:
        """How many deviations (lanes, k) the parameters of lanes (lanes, slots) in SI are above the middles."""
        own = values[:, self.slots]
        with np.errstate(invalid="ignore", divide="ignore"):
            own = np.where(self.log, np.log(np.where(self.log, own, 1.0)), own)
        return (own - self.middle) / self.deviation

    def rows(self, coordinates: Coordinates, point: Array) -> Array:
        """The changes (k, p) of the pulls with natural steps around a point (p,)."""
        step = STEP * coordinates.unit
        values = coordinates.to_values(np.concatenate([point + np.diag(step), point - np.diag(step)]))
        pulls = self.pulls(values)
        return np.asarray((pulls[: point.size] - pulls[point.size :]).T / (2.0 * STEP))

    def held(self, coordinates: Coordinates) -> Coordinates:
        """The other coordinates, with each number that has a prior held at its middle, or at the nearest bound."""
        for path, log, middle in zip(self.paths, self.log, self.middle, strict=True):
            if path in coordinates.paths:
                k = coordinates.paths.index(path)
                number = np.exp(middle) if log else middle
                at = np.log(number) if coordinates.log[k] else number
                coordinates = coordinates.held(k, float(np.clip(at, coordinates.low[k], coordinates.high[k])))
        return coordinates


def priors_of(spec: NetworkSpec) -> Priors | None:
    """The priors of the free parameters of a network; None where there are none."""
    found = [
        (number, slot, slot.value.prior)
        for number, slot in enumerate(spec.slots())
        if slot.value.prior is not None and slot.value.searched
    ]
    if not found:
        return None
    log = np.array([prior.law == "lognormal" for *_, prior in found])
    middle = np.array([prior.middle for *_, prior in found])
    return Priors(
        tuple(slot.path for _, slot, _ in found),
        np.array([number for number, *_ in found], dtype=np.int64),
        log,
        np.where(log, np.log(np.where(log, middle, 1.0)), middle),
        np.array([prior.deviation for *_, prior in found]),
    )


class WithPriors:
    """A loss with the priors beside it: the root of loss^2 + error^2 / samples * (sum of the squared pulls), in N.

    ``objective`` is that of the data, ``loss`` what is refined of it. ``error`` in N is what a sample counts for.
    """

    def __init__(self, loss: Loss, objective: Objective, priors: Priors, error: float) -> None:
        self.loss, self.objective, self.priors, self.error = loss, objective, priors, error

    def losses(self, values: Array) -> Array:
        """The loss of every lane (lanes,) of slots in SI; a lane that fails costs infinity."""
        squares = np.sum(self.priors.pulls(values) ** 2, axis=1) / self.objective.total
        return np.hypot(self.loss.losses(values), self.error * np.sqrt(np.where(squares >= 0.0, squares, np.inf)))

    def residuals(self, values: Array) -> Array:
        """Misfits (lanes, values) of all runs and the priors behind them; their root mean square is the loss."""
        values = np.atleast_2d(values)
        rows = np.concatenate([self.objective.residuals(values), self.error * self.priors.pulls(values)], axis=1)
        return rows * np.sqrt(rows.shape[1] / self.objective.total)

    def linearise(self, values: Array, moves: Array, reduce: Callable[[int, Array], Result]) -> Iterator[Result]:
        """As that of an objective; the priors (1 + moves, k) come behind all runs."""
        yield from self.loss.linearise(values, moves, reduce)
        rows = self.error * self.priors.pulls(np.concatenate([values[None], values + moves]))
        rows[1:] -= rows[0]
        yield reduce(len(self.objective.runs) + 1, rows)


@dataclass(frozen=True)
class PriorTold:
    """What a fit made of a prior: how far the number is from the middle, and how much the data have added.

    ``pull`` counts deviations of the prior; ``narrowed`` is the standard error over the deviation of the prior: 1 where
    the data add nothing. ``number`` and ``prior`` are in SI.
    """

    path: str
    prior: Prior
    number: float
    unit: str
    pull: float
    narrowed: float

    @property
    def sentence(self) -> str:
        """The prior, the result and what the data added."""
        share = (
            f"the data leave {100.0 * self.narrowed:.2g} % of its deviation"
            if self.narrowed < 0.995
            else "the data add nothing to it"
        )
        away = f"{abs(self.pull):.2g} deviations {'above' if self.pull > 0.0 else 'below'}"
        return f"prior of {self.path}: {self.prior.told(self.unit)}; the fit is {away} it, {share}"


def beside_priors(loss: Objective, spec: NetworkSpec, error: float) -> Objective | WithPriors:
    """The loss of a network with its priors, if it has any; ``error`` in N is what a sample counts for."""
    priors = priors_of(spec)
    return loss if priors is None else WithPriors(loss, loss, priors, error)


def refine_beside_priors(
    whole: Refinement,
    objective: Objective,
    steps: int,
    noise: float | None,
    watch: Callable[[float], None] = lambda loss: None,
    budget: int | None = None,
    tolerance: float = TOLERANCE,
    hopeless: Callable[[Array, float], bool] = lambda point, loss: False,
) -> tuple[Refined, float]:
    """A refinement from its start with the priors of the network, and what a sample counts for in it, in N.

    For its ``tolerance`` see ``refine``; without priors it may be ``hopeless``.

    What a sample counts for is known where the network is fitted: with priors it is fitted twice. The first time it
    also starts where the other numbers fit best with those at the middles of their priors: what the data leave open is
    a narrow, bent valley, along which a descent is slow. Without priors a sample counts for 0 N.
    """
    coordinates, priors = whole.coordinates, priors_of(whole.free)
    if priors is None:
        start = coordinates.start
        return refine(whole.loss, coordinates, start, steps, tolerance, watch, budget, hopeless), 0.0
    spent, starts = 0, [coordinates.start]

    def refined(loss: Loss, among: Coordinates, start: Array) -> Refined:
        nonlocal spent
        left = None if budget is None else max(budget - spent, 0)
        found = refine(loss, among, start, steps, tolerance, watch, left)
        spent += found.evaluations
        return found

    others = priors.held(coordinates)
    beside = refined(whole.loss, others, others.start)
    starts.append(coordinates.of_values(others.to_values(beside.point)[0]))
    for _ in range(ROUNDS):
        error = effective_error(objective, coordinates, starts[0], noise)
        loss = WithPriors(whole.loss, objective, priors, error)
        found = min((refined(loss, coordinates, start) for start in starts), key=lambda end: end.loss)
        starts = [found.point]
    return replace(found, evaluations=spent), error


def rows_beside(
    objective: Objective, coordinates: Coordinates, spec: NetworkSpec, noise: float | None
) -> tuple[Array | None, float]:
    """For the intervals of a fitted network: the changes of its priors, and what a sample counts for in N."""
    priors = priors_of(spec)
    if priors is None:
        return None, 0.0
    point = coordinates.start
    return priors.rows(coordinates, point), effective_error(objective, coordinates, point, noise)


def first_error(noise: float | None, swing: float) -> float:
    """What a sample counts for, in N, while nothing is fitted: the noise where it is known, else 1 % of the swing."""
    return noise or ONE_PERCENT * swing


def told_priors(spec: NetworkSpec, coordinates: Coordinates, errors: Array) -> tuple[PriorTold, ...]:
    """What became of the priors of a fitted network; ``errors`` (p,) are standard errors in natural steps."""
    priors = priors_of(spec)
    if priors is None:
        return ()
    point, slots = coordinates.start, spec.slots()
    pulls = priors.pulls(coordinates.to_values(point))[0]
    own = np.array([coordinates.paths.index(path) for path in priors.paths])
    steps = np.abs(priors.rows(coordinates, point)[np.arange(own.size), own])
    found = []
    for path, number, pull, narrowed in zip(priors.paths, priors.slots, pulls, steps * errors[own], strict=True):
        value = slots[number].value
        assert value.prior is not None
        found.append(PriorTold(path, value.prior, value.number, value.unit, float(pull), float(narrowed)))
    return tuple(found)


def with_earlier(spec: NetworkSpec, earlier: NetworkSpec, digest: str, source: str) -> NetworkSpec:
    """The network with the identified parameters of an earlier fit as priors of the searched ones of the same path.

    The interval of 95 % of the earlier fit gives the deviation, the wider side counting: normal where the number is
    searched along a straight scale, else lognormal. ``digest`` is that of the data that are to be fitted. Raises
    InputError where the earlier fit is of the same data, and where no number agrees in path and unit.
    """
    place = Place(earlier.file)
    data = earlier.identified.record.get("data", "")
    if data and digest.startswith(data):
        raise InputError.at(
            place,
            f"expected a fit of other data as prior, got one of the data that are to be fitted ({data})",
            "the same data would count twice: fit new runs, or leave the prior out",
        )
    known = {
        slot.path: slot.value for slot in earlier.slots() if slot.value.interval and slot.value.role == "identified"
    }
    values = {
        slot.path: replace(slot.value, prior=prior)
        for slot in spec.slots()
        if slot.value.searched and slot.path in known and (prior := _from(slot.value, known[slot.path], source))
    }
    if not values:
        told = ", ".join(known) or "no identified parameter with an interval"
        problem = Problem(
            place,
            f"expected identified parameters with intervals that '{spec.name}' searches, got {told}",
            "take the network that a fit has written, of the same structure",
        )
        raise InputError([problem])
    return spec.with_values(values)


def _from(value: Value, earlier: Value, source: str) -> Prior | None:
    assert earlier.interval is not None
    low, high = earlier.interval
    bounds = value.bounds or value.sensible
    if value.unit != earlier.unit or not bounds[0] <= earlier.number <= bounds[1]:
        return None
    if value.scale == "linear":
        width = max(earlier.number - low, high - earlier.number)
        return Prior("normal", earlier.number, 2.0 * width / STANDARD, source) if width > 0.0 else None
    if low <= 0.0:
        return None
    width = float(max(np.log(earlier.number / low), np.log(high / earlier.number)))
    return Prior("lognormal", earlier.number, 2.0 * width / STANDARD, source) if width > 0.0 else None


def describe_priors(found: Sequence[PriorTold]) -> list[dict[str, object]]:
    """The priors as they stand in result files, in SI."""
    return [
        {
            "parameter": each.path,
            "law": each.prior.law,
            "middle": each.prior.middle,
            "deviation": each.prior.deviation,
            "unit": each.unit,
            "source": each.prior.source or None,
            "value": each.number,
            "pull": each.pull,
            "narrowed": each.narrowed,
            "sentence": each.sentence,
        }
        for each in found
    ]
