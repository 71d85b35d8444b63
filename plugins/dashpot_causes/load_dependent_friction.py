"""Dry friction that grows with the load, or with a side load."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Pair, Suspect, View, added_branch, branch_lines, free_name
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import add_branch
from dashpot.text.quantity import pretty_all

Array = NDArray[np.float64]
UNITS = {"limit": "N", "stiffness": "N/m", "exponent": "1", "creep_velocity": "m/s", "growth": "N/m", "middle": "m"}
YIELDS, PLACES = (5e-4, 0.6), 7  # of the stroke: yield travels, and how many of them
CREEPS = (1e-3, 1e-2)  # of the largest speed
ROOM = (0.1, 1.5)  # times the least and the largest of them: how far a refit may go
KNOTS = 5  # of the factor over the reach
FACTORS = (0.06, 0.4)
BOUNDS = "[0.02, 1.5]"
BACK = 0.4  # of how far the factor goes one way it may come back: at the ends of the reach little is known of it
MIDDLES, TRAVELS, LEAST = (0.35, 0.5, 0.65), (2e-3, 0.02, 0.2), 0.2  # of the reach, of the stroke, of the limit
CHANGES = 0.9  # friction that changes by less does not depend on the load


class LoadDependentFriction(Cause):
    """A slider whose force has a factor over deflection: it changes from one end of the reach to the other, or grows
    from a middle to both ends.
    """

    word = "load_dependent_friction"
    kind = "specimen"
    about = "dry friction that depends on the load"
    shows = "the width of a slow loop changes along the deflection; otherwise like dry friction"
    confused_with = {
        "friction": "a second preload: the width of the loop changes with it, or not",
        "preload_dependent_damping": "a slow triangle: damping disappears, friction stays",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """Smooth sliders over yield travels, rigid contacts over creep velocities, their force growing or falling along
        the reach; smooth sliders whose limit grows to both sides of a middle, as under a side load; sharp ones whose
        limit grows along the reach or to both sides.
        """
        yield _to_both_sides(view)
        yield _under_a_load(view)
        travels = tuple(view.stroke * np.geomspace(*YIELDS, PLACES))
        creeps = tuple(creep * view.speed for creep in CREEPS)
        within = {"creep_velocity": (ROOM[0] * creeps[0], ROOM[1] * creeps[-1])}
        for rising in (True, False):
            for least in FACTORS:
                yield _Scaled("dahl", travels, _yielding, view.reach, least, rising).suspect(KNOTS + 1)
            yield _Scaled("coulomb", creeps, _creeping, view.reach, FACTORS[0], rising, within).suspect(KNOTS + 1)


def _to_both_sides(view: View) -> Suspect:
    """A smooth slider whose limit grows to both sides of some place."""
    return _around_a_place("side_load_friction", "growing to both sides", MIDDLES, TRAVELS, min, view)


def _under_a_load(view: View) -> Suspect:
    """A sharp slider whose limit grows with the distance from some place, which may be an end of the reach."""
    travels = np.geomspace(*YIELDS, PLACES).tolist()
    return _around_a_place("loaded_slider", "a sharp slider under a load", (0.0, 0.5, 1.0), travels, max, view)


def _around_a_place(
    element: str,
    form: str,
    shares: Sequence[float],
    travels: Sequence[float],
    grows_to: Callable[[float, float], float],
    view: View,
) -> Suspect:
    """A slider whose limit grows away from a place; the strength is the limit at the end that is further.

    Places are tried at ``shares`` of the reach, yield travels at ``travels`` of the stroke. The limit has to grow to
    the nearer end of the reach, which is the ``min``, or to the further one.
    """
    low, high = view.reach
    places = [(low + share * (high - low), travel * view.stroke) for share in shares for travel in travels]

    def values(limit: float, number: float) -> Mapping[str, float]:
        middle, travel = places[int(number)]
        furthest = max(high - middle, middle - low)
        return {
            "limit": LEAST * limit,
            "growth": (1.0 - LEAST) * limit / furthest,
            "middle": middle,
            "stiffness": limit / travel,
        }

    def admits(found: Mapping[str, float]) -> bool:
        way = grows_to(high - found["middle"], found["middle"] - low)
        return CHANGES * (found["limit"] + found["growth"] * way) > found["limit"]

    grid = tuple(float(number) for number in range(len(places)))
    suspect = added_branch(
        element,
        "load_dependent_friction",
        grid,
        values,
        UNITS,
        unknowns=3,
        bounds={"middle": (low, high)},
        admits=admits,
        form=form,
    )
    return replace(suspect, quantity="largest limit")


def _yielding(limit: float, travel: float) -> Mapping[str, float]:
    return {"limit": limit, "stiffness": limit / travel, "exponent": 1.0}


def _creeping(limit: float, speed: float) -> Mapping[str, float]:
    return {"limit": limit, "creep_velocity": speed}


@dataclass(frozen=True)
class _Scaled:
    element: str
    grid: tuple[float, ...]
    values: Callable[[float, float], Mapping[str, float]]
    reach: tuple[float, float]
    least: float
    rising: bool
    bounds: Mapping[str, Pair] = field(default_factory=dict)

    def suspect(self, unknowns: int) -> Suspect:
        way = "growing" if self.rising else "falling"
        return Suspect(
            f"{self.element} {way} with deflection",
            self.grid,
            self,
            self.extend,
            unknowns=unknowns,
            quantity="limit",
            unit="N",
            admits=self.admits,
            of_motion=True,
        )

    @property
    def places(self) -> tuple[float, ...]:
        return tuple(np.linspace(*self.reach, KNOTS).tolist())

    @property
    def factors(self) -> tuple[float, ...]:
        ends = (self.least, 1.0) if self.rising else (1.0, self.least)
        return tuple(np.linspace(*ends, KNOTS).tolist())

    def admits(self, found: Mapping[str, float]) -> bool:
        """Whether the factor goes mostly one way, and far enough."""
        factors = [found.get(f"scale[{number}]", 1.0) for number in range(KNOTS)]
        rising = factors if self.rising else factors[::-1]
        steps = [high - low for low, high in pairwise(rising)]
        up, down = sum(step for step in steps if step > 0.0), sum(-step for step in steps if step < 0.0)
        return down <= BACK * up and rising[0] < CHANGES * rising[-1]

    def __call__(self, view: View, run: str) -> Array:
        plain = view.respond(run, self.element, [self.values(1.0, place) for place in self.grid])
        return plain * np.interp(view.displacement(run), self.places, self.factors)

    def extend(self, text: str, atoms: Sequence[Atom]) -> str:
        values = self.values(*atoms[0])
        factors = ["1" if factor == 1.0 else f"{{start: {factor:g}, bounds: {BOUNDS}}}" for factor in self.factors]
        lines = [
            branch_lines(free_name(text, "load_dependent_friction"), self.element, values, UNITS, bounds=self.bounds),
            "  scale:",
            f"    deflection: [{', '.join(pretty_all(self.places, 'm', 6))}]",
            f"    factor: [{', '.join(factors)}]",
        ]
        return add_branch(text, "\n".join(lines))
