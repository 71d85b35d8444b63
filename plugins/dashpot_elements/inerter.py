"""Inertia between two ends."""

from __future__ import annotations

from typing import Any

from dashpot.model.element import Element, Motion, Parameter, Response
from dashpot.model.picture import Symbol


class Inerter(Element):
    """A force that follows the relative acceleration: F = inertance a.

    It stands for the part of a fixture that moves between the driven end and the load cell.
    """

    picture = Symbol.INERTER
    passive = False  # a negative inertance stands for a mass that was subtracted from the measurement

    inertance = Parameter("kg", "moving mass", bounds=(-1e12, 1e12), scale="linear", symbol="b")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The law at the acceleration at the end of the step."""
        return Response(p.inertance * x.acceleration)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The kinetic energy."""
        return 0.5 * p.inertance * x.velocity_new * x.velocity_new
