"""A dashpot between dry friction and turbulence."""

from __future__ import annotations

from typing import Any

from dashpot.model.element import Element, Motion, Parameter, Response
from dashpot.model.picture import Symbol


class PowerLawDamper(Element):
    """A dashpot with a power of the velocity: F = force r (r^2 + knee^2)^((exponent - 1)/2), r = v/reference.

    Well above the knee that is force r |r|^(exponent - 1), below it a straight line, so that its slope is finite at
    rest. With a knee that the data show it is Carreau's law of fluids that thin with the shear rate, as silicone oil.

    Source: P. J. Carreau, "Rheological equations from molecular network theories", Transactions of the Society of
    Rheology 16 (1972) 99.
    """

    picture = Symbol.DASHPOT

    force = Parameter("N", "force at the reference velocity", bounds=(1e-6, 1e9), symbol="F_r")
    exponent = Parameter("1", "power of the velocity", bounds=(0.05, 4.0), scale="linear", symbol="n")
    reference = Parameter("m/s", "velocity at which the force is given", bounds=(1e-8, 1e3), symbol="v_r", default=0.1)
    knee = Parameter(
        "1", "velocity below which it is a dashpot, over the reference", bounds=(1e-3, 1e3), symbol="k", default=1e-3
    )

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The law at the velocity at the end of the step."""
        ratio = x.velocity_new / p.reference
        return Response(p.force * ratio * (ratio * ratio + p.knee * p.knee) ** (0.5 * (p.exponent - 1.0)))
