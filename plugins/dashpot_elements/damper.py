"""Viscous characteristic."""

from __future__ import annotations

from typing import Any

from dashpot.model.element import Curve, Element, Motion, Response
from dashpot.model.picture import Symbol


class Damper(Element):
    """A dashpot, linear or along a characteristic: F = f(v).

    A table over negative and positive velocities gives rebound and compression their own shapes.
    """

    picture = Symbol.DASHPOT

    damping = Curve(
        ("force", "N"),
        ("velocity", "m/s"),
        "force over velocity, or its constant slope",
        bounds=(1e-4, 1e11),
        symbol="d",
        rising=True,
    )

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The characteristic at the velocity at the end of the step."""
        return Response(p.damping(x.velocity_new))
