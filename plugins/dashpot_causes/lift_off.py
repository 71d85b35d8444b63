"""A specimen that loses the contact."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import add_measurement

Array = NDArray[np.float64]


class LiftOff(Cause):
    """The rig presses the specimen but does not hold it: where it would have to pull, there is no force."""

    word = "lift_off"
    kind = "specimen"
    about = "lift-off (the contact is lost)"
    shows = (
        "the force has a flat trough at zero where the model pulls; even and odd harmonics from the amplitude on at "
        "which the dynamic force reaches the static one; gone with preload"
    )
    confused_with = {
        "clipping": "a higher preload: lift-off vanishes; or a known steel spring: clipping stays",
        "stiffness_curve": "a higher frequency at the same stroke: lift-off follows the force with its damping, a "
        "curve the deflection",
        "clearance": "a higher preload: lift-off vanishes, lost motion stays",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """The force that the model would pull with, taken away."""
        yield Suspect(
            "lift-off",
            (0.0,),
            _pull,
            _pressed,
            unknowns=0,
            measured=True,
            quantity="share of the pull that is missing",
            unit="1",
            largest=1.0,
        )


def _pull(view: View, run: str) -> Array:
    return np.maximum(-view.force(run), 0.0)[None]


def _pressed(text: str, atoms: Sequence[Atom]) -> str:
    return add_measurement(text, "least", "0 N")
