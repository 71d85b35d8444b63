"""A force that levels out with velocity: at once it is friction, by and by it is a digressive damper's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from dashpot.contract.cause import Suspect, View, added_branch

UNITS = {"limit": "N", "creep_velocity": "m/s"}


def levelling_force(
    view: View, branch: str, shares: tuple[float, float], places: int, room: tuple[float, float], about: str = ""
) -> Suspect:
    """The suspect of such a force over velocities between two ``shares`` of the largest one, and what it is.

    A refit may go as far as ``room`` times the first and the last of them.
    """
    low, high = shares[0] * view.speed, shares[1] * view.speed
    suspect = added_branch(
        "coulomb",
        branch,
        tuple(np.geomspace(low, high, places)),
        lambda limit, speed: {"limit": limit, "creep_velocity": speed},
        UNITS,
        bounds={"creep_velocity": (room[0] * low, room[1] * high)},
    )
    return replace(suspect, about=about)
