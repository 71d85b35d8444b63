"""A dashpot that goes with the stiffness of a curve."""

from __future__ import annotations

from typing import Any

from dashpot.model.element import Curve, Element, Motion, Parameter, Response
from dashpot.model.picture import Symbol


class ProportionalDamper(Element):
    """Damping in proportion to the slope of a stiffness curve f: F = time f'(x) v.

    Beside a `spring` with the same curve the loss angle is the same at every preload, as rubber has it: its tangent is
    the angular frequency times this time. With a straight curve it is `damper`.
    """

    picture = Symbol.DASHPOT
    source = "Clough and Penzien, Dynamics of Structures (1993) section 12-3, for damping in proportion to stiffness"

    stiffness = Curve(
        ("force", "N"),
        ("deflection", "m"),
        "force over deflection of the spring beside it, or its slope",
        bounds=(1e-3, 1e12),
        symbol="f",
        rising=True,
    )
    time = Parameter("s", "damping over stiffness", bounds=(1e-6, 10.0), symbol="T")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The velocity at the end of the step, with the slope of the curve there."""
        return Response(p.time * p.stiffness.slope(x.new) * x.velocity_new)
