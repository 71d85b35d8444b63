"""Dry friction that is not the same in both directions."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Symbol
from dashpot_elements.dahl import approach


class DirectionalFriction(Element):
    """A Dahl slider with a limit L for each direction: dF/dx = stiffness |u|^exponent sgn(u), u = 1 - F/L sgn(v).

    L is `compression` while the specimen is squeezed and `rebound` while it is released, as where a lip seal points one
    way. Solved exactly. Rate independent. With exponent 0 it is the ideal slider behind a spring. With equal limits it
    is `dahl`. Half the difference of the limits shows as a mean force while it slides to and fro.
    """

    picture = Symbol.SLIDER
    source = "Dahl, AIAA J. 14 (1976) 1675, for the law in each direction"

    stiffness = Parameter("N/m", "slope of the unloaded slider", bounds=(1e-3, 1e12), symbol="sigma")
    compression = Parameter("N", "sliding force in compression", bounds=(1e-6, 1e9), symbol="F_c")
    rebound = Parameter("N", "sliding force in rebound", bounds=(1e-6, 1e9), symbol="F_r")
    exponent = Parameter(
        "1", "shape of the approach to sliding", bounds=(0.0, 4.0), scale="linear", symbol="i", default=1.0
    )
    force = State("N", "friction force")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """Move u, the distance to sliding, along the travel of the step."""
        outward = x.travel < 0.0
        side = np.where(outward, -1.0, 1.0)
        limit = np.where(outward, p.rebound, p.compression)
        left = approach(1.0 - side * z.force / limit, p.stiffness * np.abs(x.travel) / limit, p.exponent)
        force = side * limit * (1.0 - left)
        return Response(force, force=force)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the bristles, which bend as springs of the stiffness and slip for the rest of the way."""
        return 0.5 * z.force * z.force / p.stiffness
