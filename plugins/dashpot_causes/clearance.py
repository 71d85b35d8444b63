"""Play in a joint or in the chain of levers."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

import numpy as np

from dashpot.contract.cause import Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec

PLACES = 9
SLIDING = np.array([0.005, 0.03, 0.15])  # of the stroke: how far the spring behind the play gives before it slides
PLAIN = 0.01  # of the stroke: friction behind less play cannot be told from friction
BEYOND = 1.05  # times that: play that a refit leaves at its least is none


class Clearance(Cause):
    """Lost motion after every reversal, or a dead zone in which a joint carries nothing."""

    word = "clearance"
    kind = "specimen"
    about = "clearance (lost motion)"
    shows = (
        "storage stiffness falls like 1/amplitude towards small strokes; odd harmonics in phase with deflection; a "
        "flat spot after each reversal or around zero force"
    )
    cure = "preload or replace the joint, or measure the displacement across the specimen"
    confused_with = {
        "friction": "a quasi-static triangle: friction makes the loop stiffer after a reversal, lost motion softer",
        "stiffness_curve": "preload the joint: a clearance vanishes",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A spring behind play, or with a dead zone around zero; friction behind play."""
        gaps = tuple(np.geomspace(2e-3 * view.stroke, 0.3 * view.stroke, PLACES))
        units = {"stiffness": "N/m", "gap": "m"}
        yield added_branch("backlash", "clearance", gaps, lambda k, gap: {"stiffness": k, "gap": gap}, units)
        low, high = view.reach
        if low < 0.0 < high:
            yield added_branch("clearance", "clearance", gaps, lambda k, gap: {"stiffness": k, "gap": gap}, units)
        least = PLAIN * view.stroke
        loose = tuple(gap for gap in gaps[:-1] if gap > least)
        for travel in SLIDING * view.stroke:
            yield added_branch(
                "loose_friction",
                "clearance",
                loose,
                _loose(travel),
                {**units, "limit": "N"},
                bounds={"gap": (least, view.stroke)},
                admits=lambda found: all(gap > BEYOND * least for gap in _gaps(found)),
            )


def _gaps(found: Mapping[str, float]) -> list[float]:
    return [number for name, number in found.items() if name.startswith("gap")]


def _loose(travel: float) -> Callable[[float, float], Mapping[str, float]]:
    return lambda limit, gap: {"limit": limit, "stiffness": limit / travel, "gap": gap}
