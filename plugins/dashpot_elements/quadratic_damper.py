"""Turbulent flow through an orifice."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response
from dashpot.model.picture import Symbol


class QuadraticDamper(Element):
    """A dashpot whose force grows with the square of the velocity: F = damping v |v|."""

    picture = Symbol.DASHPOT

    damping = Parameter("N*s^2/m^2", "force at 1 m/s", bounds=(1e-4, 1e13), symbol="d_2")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The law at the velocity at the end of the step."""
        return Response(p.damping * (x.velocity_new * np.abs(x.velocity_new)))
