"""Damping that is not the same in compression and rebound."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View, free_name
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import add_branch
from dashpot.text.quantity import pretty

Array = NDArray[np.float64]
COMPRESSION, REBOUND = 1.0, -1.0
NOTHING = "0.01 N*s/m"


class AsymmetricDamping(Cause):
    """A force in proportion to velocity in one direction only, beyond what a dashpot does in both."""

    word = "asymmetric_damping"
    kind = "specimen"
    about = "different damping in compression and rebound"
    shows = "a second harmonic and a mean force that grow with velocity; the mean is 1.5 times the second harmonic"
    confused_with = {
        "stiffness_curve": "a quasi-static loop: damping does not show in it",
        "preload_dependent_damping": "a second preload: the difference between the directions stays",
        "offset": "a second frequency: an offset stays",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """One dashpot that acts in compression or in rebound only."""
        yield Suspect(
            "one direction", (COMPRESSION, REBOUND), _columns, _extend, unknowns=0, quantity="damping", unit="N*s/m"
        )


def _columns(view: View, run: str) -> Array:
    velocity = view.velocity(run)
    return np.array([np.maximum(velocity, 0.0), np.minimum(velocity, 0.0)])


def _extend(text: str, atoms: Sequence[Atom]) -> str:
    strength, direction = atoms[0]
    found = f"{{start: {pretty(strength, 'N*s/m', 6)}}}"
    compression, rebound = (found, NOTHING) if direction == COMPRESSION else (NOTHING, found)
    lines = [
        f"{free_name(text, 'asymmetric_damping')}:",
        "  element: asymmetric_damper",
        f"  compression: {compression}",
        f"  rebound: {rebound}",
    ]
    return add_branch(text, "\n".join(lines))
