"""A slider that gives way gradually."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot import Element, Motion, Parameter, Response, State


class SoftSlider(Element):
    """The Bouc-Wen law with n = 1 and equal shape constants, solved exactly over a monotone step.

    Towards the limit dF/dx = stiffness (1 - |F|/limit); back to zero the full stiffness.
    """

    source = "Wen, J. Eng. Mech. Div. ASCE 102 (1976) 249"

    stiffness = Parameter("N/m", "slope at zero force", bounds=(1.0, 1e9), symbol="k")
    limit = Parameter("N", "largest force", bounds=(1e-3, 1e6), symbol="F_y")
    force = State("N", "hysteretic force")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """First back to zero along a straight line, then towards the limit along an exponential."""
        side = np.where(x.travel < 0.0, -1.0, 1.0)
        level = side * z.force / p.limit
        way = p.stiffness * np.abs(x.travel) / p.limit
        behind = np.minimum(level, 0.0) + way
        ahead = 1.0 - (1.0 - np.maximum(level, 0.0)) * np.exp(-np.maximum(behind, 0.0))
        force = side * p.limit * (np.minimum(behind, 0.0) + ahead)
        return Response(force, force=force)
