"""A mass that is carried along by friction."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Parallel, Series, Symbol


class SlidingMass(Element):
    """A mass behind a slider: F = stiffness e + damping s', s = x - x_m, e' = s' while |stiffness e| < limit, else 0,
    m x_m'' = F.

    While the slider sticks the mass rings on its spring like a `vibration_absorber`; where its force of inertia exceeds
    the limit, it slips and lags behind. It stands for a part that is clamped, pressed or laid on.

    One step follows the trapezoidal rule, whose equation is solved in closed form, sticking or slipping: second order
    in the step, apart from the steps in which it begins or ends to slip.
    """

    picture = Series(Parallel(Series(Symbol.SPRING, Symbol.SLIDER), Symbol.DASHPOT), Symbol.INERTER)
    exact = False

    mass = Parameter("kg", "mass that is carried along", bounds=(1e-6, 1e12), symbol="m")
    stiffness = Parameter("N/m", "stiffness of the sticking contact", bounds=(1e-3, 1e12), symbol="k")
    limit = Parameter("N", "sliding force", bounds=(1e-6, 1e9), symbol="F_c")
    damping = Parameter(
        "N*s/m", "damping beside the slider", bounds=(0.0, 1e11), scale="linear", symbol="d", default=0.0
    )
    stretch = State("m", "deflection of the spring")
    speed = State("m/s", "velocity of the mass")
    force = State("N", "force on the mass")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """Free flight with the old force, then what spring, slider and dashpot at the end of the step add."""
        half = 0.5 * dt
        slowing = half / p.mass
        drawn = z.stretch + x.travel - dt * z.speed - half * slowing * z.force
        rate = x.velocity_new - z.speed - slowing * z.force
        drag, elastic = 1.0 + p.damping * slowing, p.stiffness * half * slowing
        sticking = p.stiffness * (drawn - half * slowing * p.damping * rate / drag) / (1.0 + elastic / drag)
        spring = np.minimum(np.maximum(sticking, -p.limit), p.limit)
        force = (spring + p.damping * rate) / drag
        speed = z.speed + slowing * (z.force + force)
        return Response(force, stretch=spring / p.stiffness, speed=speed, force=force)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the spring and of the moving mass."""
        return 0.5 * (p.stiffness * z.stretch * z.stretch + p.mass * z.speed * z.speed)
