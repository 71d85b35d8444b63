"""Dry friction that sticks."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Symbol

# m: 1e-8 of the shortest travels that are measured, and 1e5 times the rounding of a place half a metre away
WAY = 1e-11


class IdealCoulomb(Element):
    """Ideal dry friction: F = limit sgn(v) where it slides, any |F| <= limit where it sticks, v = 0.

    The force is the unknown: F = clip(F_before + limit v dt/way) between -limit and limit, which is true of both. While
    it sticks the slider gives way by way dF/limit, way = 1e-11 m, where the force changes by dF: by no more than twice
    the way, however long it sticks and however long the time steps dt are. The force begins at zero.
    """

    picture = Symbol.SLIDER
    source = "Alart and Curnier, Comput. Methods Appl. Mech. Eng. 92 (1991) 353"

    limit = Parameter("N", "sliding force", bounds=(1e-6, 1e9), symbol="F_c")
    force = State("N", "force in the branch")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The projection on the forces that the slider can carry, at the end of the step."""
        force = np.minimum(np.maximum(z.force + p.limit / WAY * x.velocity_new * dt, -p.limit), p.limit)
        return Response(force, force=force)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """A slider stores nothing."""
        return 0.0 * z.force
