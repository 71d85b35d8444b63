"""Slow loss of force under a load."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.path import fading_travel
from dashpot.model.picture import Series, Symbol

COUNT = 9
BEFORE = 0.7  # decades from the first relaxation time to when the fall begins


class Creep(Element):
    """A force that falls with the logarithm of time: F = sum of k_i (x - r_i), r_i' = (x - r_i)/T_i.

    After a step it falls as log(1 + t/shortest), by ``stiffness`` times the deflection per decade, for so many decades:
    9 relaxation times T_i lie evenly in the logarithm around these, each with the share exp(-shortest/T_i). What has
    crept is zero in the unloaded specimen, so the deflection with which a record begins counts as a step at its first
    sample. For a specimen that has rested under its preload take ``maxwell`` or ``springpot``.
    """

    picture = Series(Symbol.SPRING, Symbol.DASHPOT)

    stiffness = Parameter("N/m", "force lost per decade of time and deflection", bounds=(1e-3, 1e12), symbol="B")
    shortest = Parameter("s", "when the fall begins", bounds=(1e-3, 1e5), symbol="T_1", default=1.0)
    decades = Parameter("1", "how long the fall lasts", bounds=(0.5, 6.0), scale="linear", symbol="N", default=3.0)
    crept_1, crept_2, crept_3, crept_4, crept_5, crept_6, crept_7, crept_8, crept_9 = (
        State("m", f"deflection that branch {number} no longer feels") for number in range(1, COUNT + 1)
    )

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """What a branch feels fades and takes in what is remembered of the travel."""
        force, crept = 0.0, {}
        for number, (time, stiffness) in enumerate(_branches(p), 1):
            felt = np.exp(-dt / time) * (x.old - getattr(z, f"crept_{number}")) + fading_travel(x, dt, time)
            force, crept[f"crept_{number}"] = force + stiffness * felt, x.new - felt
        return Response(force, **crept)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the springs of all branches."""
        stretches = [x.new - getattr(z, f"crept_{number}") for number in range(1, COUNT + 1)]
        return sum(
            0.5 * stiffness * stretch**2 for (_, stiffness), stretch in zip(_branches(p), stretches, strict=True)
        )


def _branches(p: Any) -> list[tuple[Any, Any]]:
    """Relaxation time and stiffness of every branch."""
    distance = (p.decades + BEFORE) / (COUNT - 1)
    shares = [10.0 ** (number * distance - BEFORE) for number in range(COUNT)]
    return [(p.shortest * share, p.stiffness * distance * np.exp(-1.0 / share)) for share in shares]
