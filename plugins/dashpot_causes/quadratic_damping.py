"""Turbulent damping that the network lacks."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from dashpot.contract.cause import Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec

NEARLY = (1.7, 2.3)  # powers of the velocity that still stand for turbulent flow
SHARE = 0.3  # of the largest speed: where the force of a power is told


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
        reference = float(f"{SHARE * view.speed:.2g}")
        nearly = added_branch(
            "power_law_damper",
            "quadratic_damping",
            (2.0,),
            lambda force, power: {"force": force, "exponent": power, "reference": reference},
            {"force": "N", "exponent": "1", "reference": "m/s"},
            fixed=("reference",),
            bounds={"exponent": NEARLY},
        )
        yield replace(nearly, form="a power near to two")
