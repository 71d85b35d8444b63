"""Dry friction without pre-sliding."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response
from dashpot.model.picture import Symbol


class Coulomb(Element):
    """Dry friction smoothed over a creep velocity: F = limit tanh(v/creep_velocity).

    It has no memory and no pre-sliding spring: for contacts whose yield travel is below what the sensor resolves.
    """

    picture = Symbol.SLIDER
    source = "Andersson, Soderberg and Bjorklund, Tribology International 40 (2007) 580"

    limit = Parameter("N", "sliding force", bounds=(1e-6, 1e9), symbol="F_c")
    creep_velocity = Parameter("m/s", "velocity over which the force changes sides", bounds=(1e-10, 1e3), symbol="v_c")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The law at the velocity at the end of the step."""
        return Response(p.limit * np.tanh(x.velocity_new / p.creep_velocity))
