"""Damping that fades with the work that it has taken up."""

from __future__ import annotations

from typing import Any

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Symbol
from dashpot_elements.softening import mean_square


class WornDamper(Element):
    """A dashpot that loses damping with the work W done on it: F = damping v exp(-W/work).

    As W' = F v, exp(W/work) = 1 + (damping/work) integral of v^2 dt, and the law is solved exactly along the cubic
    path. Every record begins fresh. Beside a dashpot it is the part of the damping that is lost: oil that heats up
    faster than it cools within a run, gas that comes out of the oil. With cooling see `self_heating`.
    """

    picture = Symbol.DASHPOT

    damping = Parameter("N*s/m", "damping at the beginning", bounds=(1e-4, 1e11), symbol="d")
    work = Parameter("J", "work that leaves 37 % of the damping", bounds=(1e-9, 1e12), symbol="W")
    moved = State("m^2/s", "integral of the squared velocity")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The squared velocity of the step is added to that of all steps before."""
        moved = z.moved + dt * mean_square(x, dt)
        return Response(p.damping * x.velocity_new / (1.0 + p.damping * moved / p.work), moved=moved)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """A dashpot stores nothing."""
        return 0.0
