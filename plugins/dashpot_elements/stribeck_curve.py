"""Dry friction that falls with speed, without pre-sliding."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response
from dashpot.model.picture import Symbol

TINY = 1e-12


class StribeckCurve(Element):
    """Dry friction over speed: F = L tanh(v/creep_velocity),
    L = limit + (breakaway - limit) exp(-|v/stribeck_velocity|^decay).

    It has no memory and no pre-sliding spring: for contacts whose yield travel is below what the sensor resolves.
    """

    picture = Symbol.SLIDER
    source = "Andersson, Soderberg and Bjorklund, Tribology International 40 (2007) 580"

    limit = Parameter("N", "sliding force at high speed", bounds=(1e-6, 1e9), symbol="F_c")
    breakaway = Parameter("N", "sliding force at very low speed", bounds=(1e-6, 1e9), symbol="F_s")
    stribeck_velocity = Parameter("m/s", "speed over which the force falls", bounds=(1e-8, 1e3), symbol="v_s")
    decay = Parameter("1", "steepness of the fall", bounds=(0.5, 4.0), scale="linear", symbol="delta", default=2.0)
    creep_velocity = Parameter("m/s", "velocity over which the force changes sides", bounds=(1e-10, 1e3), symbol="v_c")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The law at the velocity at the end of the step."""
        ratio = np.maximum(np.abs(x.velocity_new) / p.stribeck_velocity, TINY)
        limit = p.limit + (p.breakaway - p.limit) * np.exp(-np.exp(p.decay * np.log(ratio)))
        return Response(limit * np.tanh(x.velocity_new / p.creep_velocity))
