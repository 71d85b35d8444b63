"""A spring of any curve whose force relaxes."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Curve, Element, Motion, Parameter, Response, State
from dashpot.model.path import fading_travel
from dashpot.model.picture import Series, Symbol


class RelaxingSpring(Element):
    """A spring curve f whose force fades: F(t) = share times the integral of exp(-(t - s)/relaxation_time) df(x(s)).

    One term of quasi-linear viscoelasticity: beside a `spring` with the same curve each such branch adds a term
    share exp(-t/T) to the relaxation function. With a straight curve it is `maxwell`. A record begins with what the
    specimen rests under relaxed.

    Along a step f is taken as the parabola through its values at both ends and in the middle, and the fading is exact:
    third order in the step. Not passive for every curve, as the theory is none of thermodynamics.
    """

    picture = Series(Symbol.SPRING, Symbol.DASHPOT)
    source = "Fung, Biomechanics (1993) section 7.6"
    exact = False
    passive = False

    stiffness = Curve(
        ("force", "N"),
        ("deflection", "m"),
        "force over deflection of a sudden step, or its slope",
        bounds=(1e-3, 1e12),
        symbol="f",
        rising=True,
    )
    relaxation_time = Parameter("s", "time constant of the fading", bounds=(1e-5, 1e4), symbol="T")
    share = Parameter("1", "factor on the curve", bounds=(1e-4, 1e4), symbol="g", default=1.0)
    force = State("N", "force in the branch")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The old force fades, the rise of the curve over the step adds what is remembered of it."""
        middle = 0.5 * (x.old + x.new) + dt * (x.velocity_old - x.velocity_new) / 8.0
        first, half, last = p.stiffness(x.old), p.stiffness(middle), p.stiffness(x.new)
        rise, bend = last - first, 2.0 * (first + last - 2.0 * half)
        risen = Motion(first, last, (rise - bend) / dt, (rise + bend) / dt, 0.0)
        force = np.exp(-dt / p.relaxation_time) * z.force + p.share * fading_travel(risen, dt, p.relaxation_time)
        return Response(force, force=force)
