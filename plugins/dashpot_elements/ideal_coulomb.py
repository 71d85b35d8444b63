"""Dry friction that sticks."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Symbol

CREEP = 1e-5  # m/s: the smaller, the less is crept in a step, and the harder the step is to solve


class IdealCoulomb(Element):
    """Ideal dry friction: F = limit sgn(v) where it slides, any |F| <= limit where it sticks, v = 0.

    The force is the unknown: F = clip(F_before + limit v/creep) between -limit and limit, which is true of both. In a
    time step dt of rest with a change of the force by dF the slider creeps by dt creep dF/limit, creep = 0.01 mm/s,
    which goes to zero with the steps, however long it sticks. The force begins at zero.
    """

    picture = Symbol.SLIDER
    source = "Alart and Curnier, Comput. Methods Appl. Mech. Eng. 92 (1991) 353"

    limit = Parameter("N", "sliding force", bounds=(1e-3, 1e6), symbol="F_c")
    force = State("N", "force in the branch")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The projection on the forces that the slider can carry, at the end of the step."""
        force = np.minimum(np.maximum(z.force + p.limit / CREEP * x.velocity_new, -p.limit), p.limit)
        return Response(force, force=force)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """A slider stores nothing."""
        return 0.0 * z.force
