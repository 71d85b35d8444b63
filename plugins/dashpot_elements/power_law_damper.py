"""A dashpot between dry friction and turbulence."""

from __future__ import annotations

from typing import Any

from dashpot.model.element import Element, Motion, Parameter, Response
from dashpot.model.picture import Symbol

REST = 1e-3


class PowerLawDamper(Element):
    """A dashpot whose force follows a power of the velocity: F = force r |r|^(exponent - 1), r = v/reference.

    Below a thousandth of the reference velocity it goes over into a straight line through zero, r (r^2 +
    1e-6)^((exponent - 1)/2), so that its slope is finite at rest.
    """

    picture = Symbol.DASHPOT

    force = Parameter("N", "force at the reference velocity", bounds=(1e-6, 1e9), symbol="F_r")
    exponent = Parameter("1", "power of the velocity", bounds=(0.05, 4.0), scale="linear", symbol="n")
    reference = Parameter("m/s", "velocity at which the force is given", bounds=(1e-8, 1e3), symbol="v_r", default=0.1)

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The law at the velocity at the end of the step."""
        ratio = x.velocity_new / p.reference
        return Response(p.force * ratio * (ratio * ratio + REST * REST) ** (0.5 * (p.exponent - 1.0)))
