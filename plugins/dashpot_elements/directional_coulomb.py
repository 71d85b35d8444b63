"""Dry friction without pre-sliding that is not the same in both directions."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response
from dashpot.model.picture import Symbol


class DirectionalCoulomb(Element):
    """Dry friction smoothed over a creep velocity, with a limit L for each direction: F = L tanh(v/creep_velocity).

    L is `compression` while the specimen is squeezed and `rebound` while it is released, as where a lip seal points one
    way. It has no memory and no pre-sliding spring; with one it is `directional_friction`. With equal limits it is
    `coulomb`. Half the difference of the limits shows as a mean force while it slides to and fro.
    """

    picture = Symbol.SLIDER
    source = "Andersson, Soderberg and Bjorklund, Tribology International 40 (2007) 580, for the law in each direction"

    compression = Parameter("N", "sliding force in compression", bounds=(1e-6, 1e9), symbol="F_c")
    rebound = Parameter("N", "sliding force in rebound", bounds=(1e-6, 1e9), symbol="F_r")
    creep_velocity = Parameter("m/s", "velocity over which the force changes sides", bounds=(1e-10, 1e3), symbol="v_c")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The law at the velocity at the end of the step."""
        limit = np.where(x.velocity_new < 0.0, p.rebound, p.compression)
        return Response(limit * np.tanh(x.velocity_new / p.creep_velocity))
