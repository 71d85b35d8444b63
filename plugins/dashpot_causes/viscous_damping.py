"""A linear dashpot that the network lacks."""

from __future__ import annotations

from collections.abc import Iterable

from dashpot.contract.cause import Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec
from dashpot_causes.powers import NEARLY_ONE, power_near


class ViscousDamping(Cause):
    """A force in proportion to velocity."""

    word = "viscous_damping"
    kind = "specimen"
    about = "viscous damping"
    shows = "loss stiffness in proportion to frequency, alike at every amplitude and preload, no harmonics"
    confused_with = {
        "delay": "a second preload: a delay grows with the stiffness, a dashpot does not; or a known steel spring",
        "relaxation": "a sweep to higher frequency: the loss stiffness of a dashpot keeps growing",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """One dashpot in parallel; one with a power of the velocity near to one."""
        yield added_branch(
            "damper",
            "viscous_damping",
            (0.0,),
            lambda damping, _: {"damping": damping},
            {"damping": "N*s/m"},
            unknowns=0,
        )
        yield power_near(view, "viscous_damping", 1.0, NEARLY_ONE, "a power near to one")
