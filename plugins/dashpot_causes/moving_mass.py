"""Fixture mass between the driven end and the load cell."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from dashpot.contract.cause import Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec

MOUNTINGS = (4.0, 12.0)  # resonance of the mass on its mounting, in parts of the end of the measured band
MOUNTING_RATIO = 0.06
STIFF = 2.0  # times the end of the band: a mass on a spring that is stiffer is a mass
UNITS = {"mass": "kg", "stiffness": "N/m", "damping": "N*s/m"}


class MovingMass(Cause):
    """A force in proportion to acceleration, of either sign, depending on the side of the load cell."""

    word = "moving_mass"
    kind = "measurement"
    about = "moving mass between drive and load cell"
    shows = "storage stiffness changes with the square of frequency, alike at every amplitude and preload"
    evidence_of = "phase"
    confused_with = {
        "relaxation": "a run without specimen: force over acceleration is the mass",
        "delay": "a run without specimen: force over acceleration is the mass",
        "resonance": "a sweep to higher frequency: a resonance turns round, a mass does not",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """One inerter in parallel, or a mass on a mounting that resonates far above what was driven."""
        yield added_branch(
            "inerter",
            "moving_mass",
            (0.0,),
            lambda mass, _: {"inertance": mass},
            {"inertance": "kg"},
            sign=0,
            unknowns=0,
        )
        end = view.highest_frequency

        def mounted(mass: float, frequency: float) -> Mapping[str, float]:
            stiffness = mass * (2.0 * np.pi * frequency) ** 2
            return {"mass": mass, "stiffness": stiffness, "damping": 2.0 * MOUNTING_RATIO * np.sqrt(stiffness * mass)}

        def is_mass(found: Mapping[str, float]) -> bool:
            return bool(np.sqrt(found["stiffness"] / found["mass"]) > 2.0 * np.pi * STIFF * end)

        yield added_branch(
            "vibration_absorber",
            "moving_mass",
            [share * end for share in MOUNTINGS],
            mounted,
            UNITS,
            unknowns=2,
            admits=is_mass,
            form="a mass on its mounting",
        )
