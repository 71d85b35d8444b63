"""A column of gas under pressure."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response
from dashpot.model.picture import Symbol

BOTTOM = 0.05  # of the column, below which the force goes on along its tangent


class GasSpring(Element):
    """A gas spring: F = force (length/(length - x))^exponent.

    `force` is area times pressure over ambient at zero deflection, `length` the volume there over the area. The
    exponent is 1 where the gas keeps its temperature, about 1.4 where it is too fast for that, and in between
    elsewhere; see `warm_gas_spring` for the way from one to the other. The slope at zero is exponent force/length.
    Where less than a twentieth of the column is left the force follows its tangent, so that it stays finite. Ambient
    pressure, where it counts, is a `constant_force`. Not passive, as the gas is under pressure from the beginning.
    """

    picture = Symbol.SPRING
    passive = False

    force = Parameter("N", "force at zero deflection", bounds=(1e-6, 1e9), symbol="F_0")
    length = Parameter("m", "length of the column of gas at zero deflection", bounds=(1e-6, 1e3), symbol="l")
    exponent = Parameter("1", "polytropic exponent", bounds=(0.9, 2.0), scale="linear", symbol="n", default=1.3)

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The law at the deflection at the end of the step."""
        left = 1.0 - x.new / p.length
        column = np.maximum(left, BOTTOM)
        return Response(p.force * column**-p.exponent * (1.0 + p.exponent * (column - left) / column))
