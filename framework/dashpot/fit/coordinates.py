"""The coordinates in which parameters are searched: logarithms where the scale is one, straight numbers elsewhere."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.model.derived import Derived
from dashpot.model.network import NetworkSpec, Slot

Array = NDArray[np.float64]

LEAST_WEIGHT = 1e-12


@dataclass(frozen=True, eq=False)
class Coordinates:
    """The searched slots of a network.

    ``which`` (p,) are their numbers among all slots, ``log`` (p,) says which are searched by logarithm, ``low`` and
    ``high`` (p,) are bounds in coordinates, ``unit`` (p,) is the size of a natural step in coordinates. Each entry of
    ``rising`` holds the coordinates of neighbouring knots of a law that must not fall. ``derived`` numbers follow from
    the others.
    """

    paths: tuple[str, ...]
    which: NDArray[np.int64]
    log: NDArray[np.bool_]
    low: Array
    high: Array
    unit: Array
    base: Array
    rising: tuple[tuple[int, ...], ...] = ()
    derived: Derived = field(default_factory=Derived)

    def to_values(self, points: Array) -> Array:
        """All slots (lanes, slots) in SI for points (lanes, p) in coordinates."""
        points = np.atleast_2d(points)
        values = np.repeat(self.base[None], points.shape[0], axis=0)
        values[:, self.which] = np.where(self.log, np.exp(np.where(self.log, points, 0.0)), points)
        return self.derived.fill(values)

    def of_values(self, values: Array) -> Array:
        """The point (p,) of a single lane of slots in SI."""
        chosen = values[self.which]
        return np.where(self.log, np.log(np.where(self.log, chosen, 1.0)), chosen)

    @property
    def start(self) -> Array:
        """The point of the file."""
        return np.clip(self.of_values(self.base), self.low, self.high)

    def allowed(self, points: Array, weights: Array | None = None) -> Array:
        """The nearest points (lanes, p) inside the bounds at which no rising law falls.

        With ``weights`` (p,) of the squared distances, knots that matter little give way to those that matter much.
        """
        from scipy.optimize import isotonic_regression

        points = np.array(points, dtype=float, ndmin=2)
        weights = np.ones(points.shape[1]) if weights is None else np.maximum(weights, LEAST_WEIGHT * np.max(weights))
        for knots in map(list, self.rising):
            for lane in np.flatnonzero((np.diff(points[:, knots]) < 0.0).any(axis=1)):
                points[lane, knots] = isotonic_regression(points[lane, knots], weights=weights[knots]).x
        return np.clip(points, self.low, self.high)

    def moved(self, point: Array, steps: Array) -> Array:
        """Where natural ``steps`` (lanes, p) lead from a point (p,).

        A number whose logarithm is searched grows in proportion to the step, as a force that is proportional to it
        does, and falls with the logarithm, since it stays positive; both begin with the same slope.
        """
        change = steps * self.unit
        grows = self.log & (change > 0.0)
        return point + np.where(grows, np.log1p(np.where(grows, change, 0.0)), change)

    def from_cube(self, cube: Array) -> Array:
        """Coordinates of points in the unit cube."""
        return self.low + cube * (self.high - self.low)

    def to_cube(self, points: Array) -> Array:
        """Points in the unit cube of coordinates."""
        return (points - self.low) / (self.high - self.low)

    def number(self, which: int, at: float) -> float:
        """The number in SI of one coordinate."""
        return float(np.exp(at) if self.log[which] else at)

    def numbers(self, point: Array) -> list[float]:
        """The parameters in SI of a point (p,)."""
        return [self.number(which, at) for which, at in enumerate(point)]

    def slopes(self, point: Array) -> Array:
        """By how much the numbers in SI of a point (p,) change with its coordinates."""
        return np.where(self.log, np.exp(np.where(self.log, point, 0.0)), 1.0)

    def held(self, number: int, at: float) -> Coordinates:
        """The coordinates of all other slots, with slot ``number`` held at the coordinate ``at``."""
        rest = np.arange(len(self.paths)) != number
        base = self.base.copy()
        base[self.which[number]] = self.number(number, at)
        paths = tuple(path for path, kept in zip(self.paths, rest, strict=True) if kept)
        place = np.cumsum(rest) - 1
        rising = tuple(tuple(int(place[knot]) for knot in knots if knot != number) for knots in self.rising)
        return Coordinates(
            paths,
            self.which[rest],
            self.log[rest],
            self.low[rest],
            self.high[rest],
            self.unit[rest],
            base,
            rising,
            self.derived,
        )


def search_coordinates(spec: NetworkSpec, chosen: Callable[[Slot], bool] = lambda slot: True) -> Coordinates:
    """The coordinates of the searched slots of a network that ``chosen`` accepts. ValueError for one without bounds."""
    slots = spec.slots()
    which = [number for number, slot in enumerate(slots) if slot.value.searched and chosen(slot)]
    values = [slots[number].value for number in which]
    unbounded = [slots[number].path for number in which if slots[number].value.bounds is None]
    if unbounded:
        names = ", ".join(unbounded)
        raise ValueError(f"expected bounds for every searched parameter, got none for {names}; see with_ranges")
    log = np.array([value.scale == "log" for value in values], dtype=bool)
    bounds = np.array([value.bounds for value in values], dtype=float).reshape(-1, 2)
    low, high = (np.where(log, np.log(np.where(log, side, 1.0)), side) for side in bounds.T)
    return Coordinates(
        tuple(slots[number].path for number in which),
        np.array(which, dtype=np.int64),
        log,
        low,
        high,
        _units(slots, which),
        np.array([slot.value.number for slot in slots]),
        _rising(spec, [slots[number].path for number in which], log),
        spec.derived,
    )


def with_point(spec: NetworkSpec, coordinates: Coordinates, point: Array) -> NetworkSpec:
    """The network with the parameters of a point."""
    values = coordinates.to_values(point)[0]
    slots = spec.slots()
    return spec.with_values(
        {slots[k].path: replace(slots[k].value, number=float(values[k])) for k in coordinates.which}
    )


def _rising(spec: NetworkSpec, paths: Sequence[str], log: NDArray[np.bool_]) -> tuple[tuple[int, ...], ...]:
    # knots that stand next to each other in a table of a rising law; a fixed knot parts them
    laws = {path for path, curve in spec.curves().items() if curve.curve.rising and curve.form == "table"}
    chains: list[list[int]] = []
    before = ("", -1)
    for number, path in enumerate(paths):
        law, _, knot = path.rstrip("]").partition("[")
        if law not in laws or log[number]:
            continue
        here = (law, int(knot))
        if chains and here == (before[0], before[1] + 1):
            chains[-1].append(number)
        else:
            chains.append([number])
        before = here
    return tuple(tuple(chain) for chain in chains if len(chain) > 1)


def _units(slots: Sequence[Slot], which: Sequence[int]) -> Array:
    # a knot of a table moves on the scale of its whole table
    largest: dict[str, float] = {}
    for slot in slots:
        curve = slot.path.partition("[")[0]
        largest[curve] = max(largest.get(curve, 0.0), abs(slot.value.number))
    units = []
    for number in which:
        value = slots[number].value
        size = largest[slots[number].path.partition("[")[0]]
        width = value.bounds[1] - value.bounds[0] if value.bounds else 1.0
        units.append(1.0 if value.scale == "log" else min(size or width, width))
    return np.array(units)
