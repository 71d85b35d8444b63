"""A mass that rattles in a clearance."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Series, Symbol


class RattlingMass(Element):
    """A mass that is moved through play: F = stiffness o (1 + loss o'), o = |s| - gap where that is positive, else 0.

    s = x - x_m is the way between the specimen and the mass, and m x_m'' = F. Within the play the mass flies freely;
    where the play is used up it is struck, rings on the contact and flies off again. `loss` takes energy from each
    contact (Hunt and Crossley); the contact never pulls. It stands for a piston, a pin or a bracket with clearance.

    One step follows the trapezoidal rule, whose equation for the force of the contact is quadratic and solved in closed
    form: second order in the step, apart from the steps in which a contact begins or ends.
    """

    picture = Series(Symbol.PLAY, Symbol.SPRING, Symbol.INERTER)
    source = "Hunt and Crossley, J. Applied Mechanics 42 (1975) 440, for the contact"
    exact = False

    mass = Parameter("kg", "mass that flies", bounds=(1e-6, 1e12), symbol="m")
    stiffness = Parameter("N/m", "stiffness of the contact", bounds=(1e-3, 1e12), symbol="k")
    gap = Parameter("m", "play to either side", bounds=(0.0, 100.0), scale="linear", symbol="g")
    loss = Parameter(
        "s/m",
        "damping of the contact over its stiffness and depth",
        bounds=(0.0, 1e8),
        scale="linear",
        symbol="c",
        default=0.0,
    )
    way = State("m", "way between specimen and mass")
    speed = State("m/s", "velocity of the mass")
    force = State("N", "force on the mass")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """Free flight with the old force, then what the contact at the end of the step adds."""
        half = 0.5 * dt
        free = z.way + x.travel - dt * z.speed - half * half * z.force / p.mass
        rate = x.velocity_new - z.speed - half * z.force / p.mass
        side = np.where(free < 0.0, -1.0, 1.0)
        depth = np.maximum(side * free - p.gap, 0.0)
        pressed = _contact(depth, side * rate, p.stiffness, p.loss, half / p.mass, half)
        force = side * pressed
        way, speed = free - half * half * force / p.mass, z.speed + half * (z.force + force) / p.mass
        return Response(force, way=way, speed=speed, force=force)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the contact and of the moving mass."""
        depth = np.maximum(np.abs(z.way) - p.gap, 0.0)
        return 0.5 * (p.stiffness * depth * depth + p.mass * z.speed * z.speed)


def _contact(depth: Any, rate: Any, stiffness: Any, loss: Any, slowing: Any, half: Any) -> Any:
    """P = stiffness (depth - half slowing P) (1 + loss (rate - slowing P)), where it pushes."""
    damped = np.maximum(1.0 + loss * rate, 0.0)
    spring, dashpot = stiffness * half * slowing * damped, stiffness * depth * loss * slowing
    size = 1.0 + spring + dashpot
    root = np.sqrt(1.0 + 2.0 * (spring + dashpot) + (spring - dashpot) ** 2)
    return 2.0 * stiffness * depth * damped / (size + root)
