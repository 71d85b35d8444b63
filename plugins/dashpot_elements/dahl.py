"""Dry friction with a smooth pre-sliding spring."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Symbol

TINY = 1e-12


class Dahl(Element):
    """Dry friction after Dahl: dF/dx = stiffness |u|^exponent sgn(u), u = 1 - F/limit sgn(v), solved exactly.

    Rate independent. With exponent 1 the force approaches the limit exponentially; exponent 0 is the ideal slider
    behind a spring (Jenkin). Minor loops drift: the law has no memory of turning points.
    """

    picture = Symbol.SLIDER
    source = "Dahl, AIAA J. 14 (1976) 1675"

    stiffness = Parameter("N/m", "slope of the unloaded slider", bounds=(1e-3, 1e12), symbol="sigma")
    limit = Parameter("N", "sliding force", bounds=(1e-6, 1e9), symbol="F_c")
    exponent = Parameter(
        "1", "shape of the approach to sliding", bounds=(0.0, 4.0), scale="linear", symbol="i", default=1.0
    )
    force = State("N", "friction force")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """Move u, the distance to sliding, along the travel of the step."""
        side = np.where(x.travel < 0.0, -1.0, 1.0)
        distance = 1.0 - side * z.force / p.limit
        way = p.stiffness * np.abs(x.travel) / p.limit
        force = side * p.limit * (1.0 - approach(distance, way, p.exponent))
        return Response(force, force=force)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the bristles, which bend as springs of the stiffness and slip for the rest of the way."""
        return 0.5 * z.force * z.force / p.stiffness


def approach(distance: Any, way: Any, exponent: Any) -> Any:
    """The distance to sliding u after a dimensionless way: du/dway = -|u|^exponent sgn(u)."""
    smooth = distance * np.exp(-way)
    excess = np.where(exponent == 1.0, 1.0, exponent - 1.0)
    growth = excess * way * np.maximum(np.abs(distance), TINY) ** excess
    general = distance * np.exp(-np.log1p(np.maximum(growth, -1.0)) / excess)
    general = np.where(growth <= -1.0, 0.0, general)
    return np.where(exponent == 1.0, smooth, general)
