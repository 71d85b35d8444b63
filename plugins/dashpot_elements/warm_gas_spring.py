"""A column of gas that warms up when it is squeezed, and cools again."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Symbol

BOTTOM = 0.05  # of the column, below which nothing gets stiffer any more


class WarmGasSpring(Element):
    """A gas spring that exchanges heat: F = force T/u, u = 1 - x/length, T' = -(ratio - 1) T u'/u - (T - 1)/time.

    T is the temperature over that of the walls, u the volume over that at zero deflection. Slow motion keeps the
    temperature (force/u), fast motion follows force/u^ratio (adiabatic); in between the force is ahead of the
    deflection. Small motions find the stiffness (force/length) (1 + (ratio - 1) j w time/(1 + j w time)). Every record
    begins at the temperature of the walls. Below a twentieth of the column u stays what it is.

    Half of the cooling acts before, half after the change of volume over a step (Strang splitting, second order).
    Not passive, as the gas is under pressure from the beginning.
    """

    picture = Symbol.SPRING
    source = "Otis and Pourmovahed, J. Dynamic Systems, Measurement, and Control 107 (1985) 116, for the equation"
    exact = False
    passive = False

    force = Parameter("N", "force at zero deflection", bounds=(1e-6, 1e9), symbol="F_0")
    length = Parameter("m", "length of the column of gas at zero deflection", bounds=(1e-6, 1e3), symbol="l")
    time = Parameter("s", "time constant of the cooling at constant volume", bounds=(1e-3, 1e5), symbol="tau")
    ratio = Parameter(
        "1", "ratio of the specific heats", bounds=(1.0, 1.7), scale="linear", symbol="kappa", default=1.4
    )
    warmth = State("1", "temperature over that of the walls, less one")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """Cooling, squeezing, cooling."""
        before, after = (np.maximum(1.0 - place / p.length, BOTTOM) for place in (x.old, x.new))
        fading = np.exp(-0.5 * dt / p.time)
        squeezed = (1.0 + fading * z.warmth) * (before / after) ** (p.ratio - 1.0)
        warmth = fading * (squeezed - 1.0)
        return Response(p.force * (1.0 + warmth) / after, warmth=warmth)
