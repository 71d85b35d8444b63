"""Turbulent damping that the network lacks."""

from __future__ import annotations

from collections.abc import Iterable

from dashpot.contract.cause import Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec
from dashpot_causes.powers import NEARLY_TWO, power_near


class QuadraticDamping(Cause):
    """A force in proportion to the square of velocity."""

    word = "quadratic_damping"
    kind = "specimen"
    about = "quadratic damping"
    shows = "loss stiffness grows with frequency and amplitude; a third harmonic of a fifth of the loss"
    confused_with = {
        "viscous_damping": "an amplitude ladder at one frequency: quadratic damping grows with amplitude",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """One quadratic dashpot in parallel; one with a power of the velocity near to two."""
        yield added_branch(
            "quadratic_damper",
            "quadratic_damping",
            (0.0,),
            lambda damping, _: {"damping": damping},
            {"damping": "N*s^2/m^2"},
            unknowns=0,
        )
        yield power_near(view, "quadratic_damping", 2.0, NEARLY_TWO, "a power near to two")
