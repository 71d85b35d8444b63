"""Elastic characteristic."""

from __future__ import annotations

from typing import Any

from dashpot.model.element import Curve, Element, Motion, Response
from dashpot.model.picture import Symbol


class Spring(Element):
    """A spring, linear or along a characteristic: F = f(x).

    A table is interpolated by a monotone cubic with continuous slope and continued linearly outside its knots.
    """

    picture = Symbol.SPRING
    source = "Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300 for the monotone cubic"

    stiffness = Curve(
        ("force", "N"),
        ("deflection", "m"),
        "force over deflection, or its constant slope",
        bounds=(1e-3, 1e12),
        symbol="k",
    )

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The characteristic at the end of the step."""
        return Response(p.stiffness(x.new))
