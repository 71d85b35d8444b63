"""Fluid that is pumped to and fro through a long channel."""

from __future__ import annotations

from typing import Any

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Parallel, Series, Symbol
from dashpot_elements.swinging import Swinging, slowed


class Hydro(Element):
    """A hydraulic mount with an inertia track: m x_h'' + d_1 x_h' + d_2 |x_h'| x_h' + k_2 x_h = k_b (x - x_h).

    The force is F = k_b (x - x_h). x_h and m are the displacement and the mass of the fluid in the track as felt at the
    piston (mass times the squared ratio of areas), k_b is the stiffness of the walls that bulge, k_2 that of the
    compensation chamber: in series with k_b it is the static stiffness. The dynamic stiffness k_b (k_2 - m w^2 + j w
    d)/(k_b + k_2 - m w^2 + j w d) dips below and peaks above the resonance at w^2 = (k_b + k_2)/m.

    Solved exactly along the cubic path where the quadratic damping is 0; otherwise this damping acts in two halves,
    before and after the step (Strang splitting, second order).
    """

    picture = Series(Symbol.SPRING, Parallel(Symbol.TRACK, Symbol.DASHPOT))
    source = "Strang, SIAM J. Numer. Anal. 5 (1968) 506, for the splitting"
    exact = False

    fluid_mass = Parameter("kg", "mass of the fluid in the track, felt at the piston", bounds=(1e-6, 1e12), symbol="m")
    stiffness = Parameter("N/m", "stiffness of the bulging walls", bounds=(1e-3, 1e12), symbol="k_b")
    damping = Parameter("N*s/m", "linear damping in the track", bounds=(1e-4, 1e11), symbol="d_1")
    quadratic_damping = Parameter(
        "N*s^2/m^2", "turbulent damping in the track", bounds=(0.0, 1e13), scale="linear", symbol="d_2", default=0.0
    )
    compensation_stiffness = Parameter(
        "N/m", "stiffness of the compensation chamber", bounds=(0.0, 1e12), scale="linear", symbol="k_2", default=0.0
    )
    bulge = State("m", "bulge of the walls beyond the static one")
    flow = State("m/s", "velocity of the fluid in the track")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """Half of the turbulence, the linear part over the whole step, the other half of the turbulence."""
        both = p.stiffness + p.compensation_stiffness
        matrix = Swinging(dt * p.damping / p.fluid_mass, dt * dt * both / p.fluid_mass)
        turbulence = 0.5 * dt * p.quadratic_damping / p.fluid_mass
        memory = z.bulge, dt * slowed(z.flow, turbulence)
        bulge, shift = matrix.moved(memory, x, dt, p.stiffness / both)
        static = p.compensation_stiffness * (p.stiffness / both)
        return Response(static * x.new + p.stiffness * bulge, bulge=bulge, flow=slowed(shift / dt, turbulence))

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the walls, of the compensation chamber and of the moving fluid."""
        share = p.stiffness / (p.stiffness + p.compensation_stiffness)
        displaced = share * x.new - z.bulge
        walls, chamber = x.new - displaced, displaced
        held = p.stiffness * walls * walls + p.compensation_stiffness * chamber * chamber
        return 0.5 * (held + p.fluid_mass * z.flow * z.flow)
