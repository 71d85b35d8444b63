"""Relaxation with one time constant."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.path import fading_travel
from dashpot.model.picture import Series, Symbol


class Maxwell(Element):
    """A spring in series with a dashpot: dF/dt = k v - F/T, solved exactly along the cubic path.

    k is the stiffness, T the relaxation time. The dynamic stiffness is k j w T/(1 + j w T); its loss part peaks with
    k/2 at w = 1/T.
    """

    picture = Series(Symbol.SPRING, Symbol.DASHPOT)

    stiffness = Parameter("N/m", "stiffness of the spring", bounds=(1e-3, 1e12), symbol="k")
    relaxation_time = Parameter("s", "damping over stiffness", bounds=(1e-5, 1e4), symbol="T")
    force = State("N", "force in the branch")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The old force fades, the travel of the step adds what is remembered of it."""
        fading = np.exp(-dt / p.relaxation_time)
        force = fading * z.force + p.stiffness * fading_travel(x, dt, p.relaxation_time)
        return Response(force, force=force)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the spring."""
        return 0.5 * z.force * z.force / p.stiffness
