"""Dry friction that the network lacks."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from dashpot.contract.cause import Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec
from dashpot_causes.levelling import levelling_force

UNITS = {
    "limit": "N",
    "compression": "N",
    "rebound": "N",
    "stiffness": "N/m",
    "exponent": "1",
    "creep_velocity": "m/s",
}
PLACES = 15
DIRECTED = 7  # yield travels, for each direction in which it rubs harder
ONE_WAY = 0.3  # of the limit in one direction, that in the other one
SPEEDS = 5
RIGID = (1e-3, 1e-2)  # of the speed: a force that is rounded off over more is a digressive damper's
ROOM = (0.1, 1.5)  # of the least and the largest of them: how far a refit may go
MOST = 3
ONE_CONTACT = 25.0  # longest over shortest yield travel: sliders spread wider are a filler network that softens
HARDLY = 0.03  # of the limits, or the stiffness, of all sliders together: no contact of its own


class Friction(Cause):
    """One dry contact: sliders of yield travels within a decade and a half. Wider, they soften with amplitude."""

    word = "friction"
    kind = "specimen"
    about = "dry friction"
    shows = "a loop that keeps its area when the test is slow; loss stiffness falls like 1/amplitude; a third harmonic"
    confused_with = {
        "relaxation": "a triangle at 0.1, 1 and 10 mm/s: the width of a friction loop does not change with speed",
        "quadratic_damping": "a slow triangle: quadratic damping disappears, friction stays",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A slider of any approach, some behind springs, over yield travels, one that rubs harder in one direction; a
        rigid contact over creep velocities, and one that rubs harder in one direction.
        """
        grid = tuple(np.geomspace(2e-4 * view.stroke, 0.6 * view.stroke, PLACES))
        yield added_branch(
            "dahl",
            "friction",
            grid,
            lambda limit, travel: {"limit": limit, "stiffness": limit / travel, "exponent": 1.0},
            UNITS,
            unknowns=2,
        )
        yield added_branch(
            "prandtl",
            "friction",
            grid,
            lambda limit, travel: {"limit": limit, "stiffness": limit / travel},
            UNITS,
            most=MOST,
            admits=is_one_contact,
        )
        yield _directed(view)
        yield levelling_force(view, "friction", RIGID, SPEEDS, ROOM)
        yield _directed_at_once(view)


def _directed(view: View) -> Suspect:
    travels = np.geomspace(5e-4 * view.stroke, 0.6 * view.stroke, DIRECTED)
    sides = [side * travel for side in (1.0, -1.0) for travel in travels]

    def values(limit: float, place: float) -> Mapping[str, float]:
        return {**_limits(limit, place), "stiffness": limit / abs(place), "exponent": 1.0}

    suspect = added_branch(
        "directional_friction", "friction", sides, values, UNITS, unknowns=3, form="a limit for each direction"
    )
    return replace(suspect, quantity="limit", unit="N")


def _directed_at_once(view: View) -> Suspect:
    low, high = (share * view.speed for share in RIGID)
    sides = [side * creep for side in (1.0, -1.0) for creep in np.geomspace(low, high, SPEEDS)]
    suspect = added_branch(
        "directional_coulomb",
        "friction",
        sides,
        lambda limit, place: {**_limits(limit, place), "creep_velocity": abs(place)},
        UNITS,
        unknowns=2,
        bounds={"creep_velocity": (ROOM[0] * low, ROOM[1] * high)},
        form="a limit for each direction, sliding at once",
    )
    return replace(suspect, quantity="limit", unit="N")


def _limits(limit: float, place: float) -> dict[str, float]:
    """The limits of a slider that rubs harder in the direction in which its place lies."""
    compression, rebound = (limit, ONE_WAY * limit) if place > 0.0 else (ONE_WAY * limit, limit)
    return {"compression": compression, "rebound": rebound}


def is_one_contact(numbers: Mapping[str, float]) -> bool:
    """Whether the yield travels of all sliders that count lie within a decade and a half.

    One of hardly any force does not count, nor the slow rise of the force of a contact that has slipped.
    """
    sliders = [
        (limit, numbers.get(key.replace("limit", "stiffness"), 0.0))
        for key, limit in numbers.items()
        if key.startswith("limit")
    ]
    felt = [(limit, k) for limit, k in sliders if limit > HARDLY * sum(limit for limit, _ in sliders)]
    travels = [limit / k for limit, k in felt if k > HARDLY * sum(k for _, k in felt)]
    return len(travels) < 2 or max(travels) < ONE_CONTACT * min(travels)
