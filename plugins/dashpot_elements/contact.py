"""Bodies that touch without sticking."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Curve, Element, Motion, Response
from dashpot.model.picture import Series, Symbol


class Contact(Element):
    """A spring that can be pressed but not pulled: F = f(x) for x > 0, else 0.

    In series with a specimen, stiff against it, it lets the specimen lift off.
    """

    picture = Series(Symbol.GAP, Symbol.SPRING)

    stiffness = Curve(
        ("force", "N"),
        ("deflection", "m"),
        "force over deflection, or its constant slope",
        bounds=(1e-3, 1e12),
        symbol="k",
    )

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The characteristic at the depth at the end of the step."""
        return Response(p.stiffness(np.maximum(x.new, 0.0)))
