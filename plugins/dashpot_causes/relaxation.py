"""Stress relaxation that the network lacks."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from dashpot.contract.cause import Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec
from dashpot_causes.band import end_of_band

UNITS = {"stiffness": "N/m", "relaxation_time": "s"}
PLACES = 18
MOST = 3
FASTEST = 0.2  # over the angular frequency at the end of the measured band: what relaxes faster is a dashpot


class Relaxation(Cause):
    """Maxwell branches of one or several relaxation times."""

    word = "relaxation"
    kind = "specimen"
    about = "relaxation (dynamic stiffening)"
    shows = "storage stiffness rises with frequency and loss stiffness has a broad maximum, alike at every amplitude"
    confused_with = {
        "friction": "an amplitude ladder at one frequency: friction softens with amplitude, relaxation does not",
        "delay": "a known steel spring on the same channels: a delay stays",
        "viscous_damping": "a sweep to higher frequency: the loss stiffness of relaxation falls off again",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """Maxwell branches on a logarithmic grid of relaxation times."""
        grid = np.geomspace(2.0 * view.dt, 0.3 * view.duration, PLACES)
        fastest = FASTEST / (2.0 * np.pi * end_of_band(view))

        def relaxes(found: Mapping[str, float]) -> bool:
            return all(time > fastest for name, time in found.items() if name.startswith("relaxation_time"))

        yield added_branch(
            "maxwell",
            "relaxation",
            tuple(grid),
            lambda k, time: {"stiffness": k, "relaxation_time": time},
            UNITS,
            most=MOST,
            admits=relaxes,
        )
