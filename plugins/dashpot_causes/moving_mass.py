"""Fixture mass between the driven end and the load cell."""

from __future__ import annotations

from collections.abc import Iterable

from dashpot.contract.cause import Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec


class MovingMass(Cause):
    """A force in proportion to acceleration, of either sign, depending on the side of the load cell."""

    word = "moving_mass"
    kind = "measurement"
    about = "moving mass between drive and load cell"
    shows = "storage stiffness changes with the square of frequency, alike at every amplitude and preload"
    confused_with = {
        "relaxation": "a run without specimen: force over acceleration is the mass",
        "delay": "a run without specimen: force over acceleration is the mass",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """One inerter in parallel."""
        yield added_branch(
            "inerter",
            "moving_mass",
            (0.0,),
            lambda mass, _: {"inertance": mass},
            {"inertance": "kg"},
            sign=0,
            unknowns=0,
        )
