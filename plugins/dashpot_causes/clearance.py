"""Play in a joint or in the chain of levers."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from dashpot.contract.cause import Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec

PLACES = 9
CENTRES = 3


class Clearance(Cause):
    """Lost motion after every reversal, or a dead zone in which a joint carries nothing."""

    word = "clearance"
    kind = "specimen"
    about = "clearance (lost motion)"
    shows = (
        "storage stiffness falls like 1/amplitude towards small strokes; odd harmonics in phase with deflection; a "
        "flat spot after each reversal or around zero force"
    )
    confused_with = {
        "friction": "a quasi-static triangle: friction makes the loop stiffer after a reversal, lost motion softer",
        "stiffness_curve": "preload the joint: a clearance vanishes",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A spring behind play that is pushed to and fro; a spring with a dead zone around some deflections."""
        gaps = tuple(np.geomspace(2e-3 * view.stroke, 0.3 * view.stroke, PLACES))
        units = {"stiffness": "N/m", "gap": "m", "centre": "m"}
        yield added_branch("backlash", "clearance", gaps, lambda k, gap: {"stiffness": k, "gap": gap}, units)
        low, high = view.reach
        for centre in np.linspace(low, high, CENTRES + 2)[1:-1]:
            yield added_branch(
                "clearance",
                "clearance",
                gaps,
                lambda k, gap, centre=centre: {"stiffness": k, "gap": gap, "centre": float(centre)},
                units,
                unknowns=2,
            )
