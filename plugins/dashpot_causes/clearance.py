"""Play in a joint or in the chain of levers."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

import numpy as np

from dashpot.contract.cause import Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec

UNITS = {"stiffness": "N/m", "damping": "N*s/m", "limit": "N", "gap": "m", "place": "m"}
PLACES = 9
SLIDING = np.array([0.005, 0.03, 0.15])  # of the stroke: how far the spring behind the play gives before it slides
PLAIN = 0.01  # of the stroke: friction behind less play cannot be told from friction
PHASES = np.array([0.1, 0.4, 1.5])  # tangent of the loss angle of rubber behind the play at the end of the band
BEYOND = 1.05  # times that: play that a refit leaves at its least is none
Numbers = Callable[[float, float], Mapping[str, float]]


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
        """A spring behind play, or with a dead zone around where the force is zero; rubber or friction behind play."""
        gaps = tuple(np.geomspace(2e-3 * view.stroke, 0.3 * view.stroke, PLACES))
        yield added_branch("backlash", "clearance", gaps, lambda k, gap: {"stiffness": k, "gap": gap}, UNITS)
        least, middle = PLAIN * view.stroke, _without_force(view)
        loose = tuple(gap for gap in gaps[:-1] if gap > least)
        within = {"gap": (least, view.stroke), "place": view.reach}

        def has_play(found: Mapping[str, float]) -> bool:
            return all(gap > BEYOND * least for name, gap in found.items() if name.startswith("gap"))

        def behind(element: str, numbers: Numbers, unknowns: int = 1) -> Suspect:
            return added_branch(
                element, "clearance", loose, numbers, UNITS, unknowns=unknowns, bounds=within, admits=has_play
            )

        if middle is not None:
            place = {"place": middle} if abs(middle) > least else {}  # nearer to zero it is at zero
            unknowns = 1 + len(place)
            yield added_branch("clearance", "clearance", gaps, _dead_zone(place), UNITS, unknowns=unknowns)
            for time in PHASES / (2.0 * np.pi * view.highest_frequency):
                yield behind("loose_kelvin_voigt", _rubber(time, place), unknowns)
        for travel in SLIDING * view.stroke:
            yield behind("loose_friction", _friction(travel))


def _without_force(view: View) -> float | None:
    """The deflection in m at which the force of the model passes zero, the median over the runs; None where none does.

    In the middle of its play a joint carries nothing, wherever the rig has its zero.
    """
    passes = [np.flatnonzero(np.diff(np.sign(view.force(run)))) for run in view.runs]
    ends = [view.displacement(run)[[at, at + 1]] for run, at in zip(view.runs, passes, strict=True)]
    places = np.concatenate(ends, axis=1).mean(axis=0)
    return float(f"{np.median(places):.3g}") if places.size else None


def _friction(travel: float) -> Numbers:
    return lambda limit, gap: {"limit": limit, "stiffness": limit / travel, "gap": gap}


def _dead_zone(place: Mapping[str, float]) -> Numbers:
    return lambda stiffness, gap: {"stiffness": stiffness, "gap": gap, **place}


def _rubber(time: float, place: Mapping[str, float]) -> Numbers:
    return lambda stiffness, gap: {"stiffness": stiffness, "damping": stiffness * time, "gap": gap, **place}
