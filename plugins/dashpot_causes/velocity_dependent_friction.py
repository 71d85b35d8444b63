"""Dry friction that falls with speed."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import product

import numpy as np

from dashpot.contract.cause import Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec

UNITS = {"limit": "N", "breakaway": "N", "stribeck_velocity": "m/s", "stiffness": "N/m",
         "decay": "1", "exponent": "1"}  # fmt: skip
TRAVELS = (1e-3, 8e-3, 6e-2, 0.3)  # of the stroke
SPEEDS = (8e-3, 4e-2, 0.2)  # of the largest speed
RATIO = 3.0
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
        """A slider whose breakaway force is a multiple of its sliding force, over yield travels and Stribeck speeds."""
        places = [(t * view.stroke, s * view.speed) for t, s in product(TRAVELS, SPEEDS)]
        yield added_branch(
            "stribeck",
            "velocity_dependent_friction",
            tuple(float(number) for number in np.arange(len(places))),
            lambda limit, place: {
                "limit": limit,
                "breakaway": RATIO * limit,
                "stribeck_velocity": places[int(place)][1],
                "stiffness": RATIO * limit / places[int(place)][0],
                "decay": 2.0,
                "exponent": 1.0,
            },
            UNITS,
            unknowns=5,
            admits=lambda found: found["breakaway"] > FALLS * found["limit"],
            imitates=("friction",),
        )
