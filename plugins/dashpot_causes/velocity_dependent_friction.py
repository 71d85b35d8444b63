"""Dry friction that falls with speed."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import product

from dashpot.contract.cause import NOTHING, Cause, Pair, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec

UNITS = {
    "limit": "N",
    "breakaway": "N",
    "stribeck_velocity": "m/s",
    "stiffness": "N/m",
    "creep_velocity": "m/s",
    "decay": "1",
    "exponent": "1",
    "bristle_damping": "N*s/m",
}
TRAVELS = (1e-3, 8e-3, 6e-2, 0.3)  # of the stroke
SPEEDS = (8e-3, 4e-2, 0.2)  # of the largest speed
RATIO = 3.0
CREEPS = (1e-3, 1e-2)  # of the largest speed
ROOM = (0.1, 1.5)  # times the least and the largest of them: how far a refit may go
FALLS = 1.35  # breakaway over sliding: dry friction that falls by less is ordinary


class VelocityDependentFriction(Cause):
    """A slider whose limit falls from breakaway to sliding (Stribeck effect)."""

    word = "velocity_dependent_friction"
    kind = "specimen"
    about = "dry friction that falls with speed"
    shows = "loss and storage stiffness fall with frequency like those of friction that fades; horns at the reversals"
    confused_with = {
        "friction": "a triangle at three speeds: the width of the loop falls with speed, or not",
        "relaxation": "an amplitude ladder at one frequency: friction softens with amplitude, relaxation does not",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A slider whose breakaway force is a multiple of its sliding force, over Stribeck speeds.

        It yields over travels, with damped bristles as well (LuGre), or, without pre-sliding, over creep velocities.
        """
        yields = [(t * view.stroke, s * view.speed) for t, s in product(TRAVELS, SPEEDS)]

        def bristles(limit: float, travel: float) -> dict[str, float]:
            return {"stiffness": RATIO * limit / travel, "decay": 2.0, "exponent": 1.0}

        def damped(limit: float, travel: float) -> dict[str, float]:
            # at the largest speed unbent bristles resist as much as sliding does at none
            return {**bristles(limit, travel), "bristle_damping": RATIO * limit / view.speed}

        yield _falling("stribeck", yields, bristles, unknowns=5)
        yield _falling("stribeck", yields, damped, unknowns=6, form="LuGre")
        creeps = [(c * view.speed, s * view.speed) for c, s in product(CREEPS, SPEEDS)]
        yield _falling(
            "stribeck_curve",
            creeps,
            lambda limit, speed: {"creep_velocity": speed, "decay": 2.0},
            unknowns=4,
            bounds={"creep_velocity": (ROOM[0] * creeps[0][0], ROOM[1] * creeps[-1][0])},
        )


def _falling(
    element: str,
    places: Sequence[Pair],
    rest: Callable[[float, float], Mapping[str, float]],
    unknowns: int,
    bounds: Mapping[str, Pair] = NOTHING,
    form: str = "",
) -> Suspect:
    return added_branch(
        element,
        "velocity_dependent_friction",
        tuple(float(number) for number in range(len(places))),
        lambda limit, place: {
            "limit": limit,
            "breakaway": RATIO * limit,
            "stribeck_velocity": places[int(place)][1],
            **rest(limit, places[int(place)][0]),
        },
        UNITS,
        unknowns=unknowns,
        bounds=bounds,
        admits=lambda found: found["breakaway"] > FALLS * found["limit"],
        form=form,
    )
