"""A mass that hangs on a spring and a dashpot."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Parallel, Series, Symbol
from dashpot_elements.swinging import Swinging, slowed


class VibrationAbsorber(Element):
    """A mass that hangs on a spring and moves freely: F = k s + d_1 s' + d_2 |s'| s'.

    s = x - x_m is the deflection of the spring, and m x_m'' = F.
    It stands for whatever swings along without being held: the belt of a tire, an intermediate plate, a bracket, the
    frame of a rig. The dynamic stiffness -m w^2 (k + j w d)/(k - m w^2 + j w d) is that of the mass below the
    resonance at w^2 = k/m, turns round there, and is that of the dashpot above.

    Solved exactly along the cubic path where the quadratic damping is 0; otherwise this damping acts in two halves,
    before and after the step (Strang splitting, second order).
    """

    picture = Series(Parallel(Symbol.SPRING, Symbol.DASHPOT), Symbol.INERTER)
    source = "Den Hartog, Mechanical Vibrations (1956) section 3.2; Strang, SIAM J. Numer. Anal. 5 (1968) 506"
    exact = False

    mass = Parameter("kg", "mass that swings along", bounds=(1e-6, 1e12), symbol="m")
    stiffness = Parameter("N/m", "stiffness of the spring that it hangs on", bounds=(1e-3, 1e12), symbol="k")
    damping = Parameter("N*s/m", "linear damping beside the spring", bounds=(1e-4, 1e11), symbol="d_1")
    quadratic_damping = Parameter(
        "N*s^2/m^2",
        "damping that grows with the square of the speed",
        bounds=(0.0, 1e13),
        scale="linear",
        symbol="d_2",
        default=0.0,
    )
    stretch = State("m", "deflection of the spring")
    speed = State("m/s", "velocity of the mass")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """Half of the quadratic damping, the linear part over the whole step, the other half."""
        drag = dt * p.damping / p.mass
        swinging = Swinging(drag, dt * dt * p.stiffness / p.mass)
        turbulence = 0.5 * dt * p.quadratic_damping / p.mass
        slower = x.velocity_old - slowed(x.velocity_old - z.speed, turbulence)
        stretch, shift = swinging.moved((z.stretch, dt * slower), x, dt, drag=drag)
        rate = slowed(x.velocity_new - shift / dt, turbulence)
        drawn = p.damping * rate + p.quadratic_damping * np.abs(rate) * rate
        return Response(p.stiffness * stretch + drawn, stretch=stretch, speed=x.velocity_new - rate)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the spring and of the moving mass."""
        return 0.5 * (p.stiffness * z.stretch * z.stretch + p.mass * z.speed * z.speed)
