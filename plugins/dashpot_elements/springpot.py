"""Filled rubber: a loss angle that does not change with frequency."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.path import fading_travel
from dashpot.model.picture import Symbol

INSIDE = 11
MARGIN = 2  # branches beyond either end of the range
FAR = 100.0


class Springpot(Element):
    """The fractional derivative between spring and dashpot: K* = stiffness (j f/reference)^order.

    Its loss angle is order times 90 degrees at every frequency f. It is made of Maxwell branches, each solved exactly
    along the cubic path: 11 evenly over the logarithm of the frequency from two places below the range to two above
    it, which is two a decade over the default range, and one far beyond either end for all that lies there.
    Their stiffnesses follow from the spectrum sin(pi order)/pi T^-order d(ln T) of the relaxation times T by the
    trapezoidal rule. Over the default range |K*| is good to 0.2 %, the loss tangent to 3 % at its ends and 0.7 %
    half a decade inside. The deflection with which a record begins was reached ``dwell`` seconds before; without a
    number so long ago that all of its force has relaxed.
    """

    picture = Symbol.FRACTIONAL
    source = "Schmidt and Gaul, Nonlinear Dynamics 29 (2002) 37, for the law"

    stiffness = Parameter("N/m", "dynamic stiffness at the reference frequency", bounds=(1e-3, 1e12), symbol="k_a")
    order = Parameter("1", "0 of a spring, 1 of a dashpot", bounds=(0.01, 0.99), scale="linear", symbol="a")
    reference = Parameter(
        "Hz", "frequency at which the stiffness is given", bounds=(1e-4, 1e5), symbol="f_r", default=1.0
    )
    lowest = Parameter("Hz", "low end of the range of frequencies", bounds=(1e-6, 1e5), symbol="f_1", default=0.1)
    decades = Parameter(
        "1", "length of the range of frequencies", bounds=(0.5, 8.0), scale="linear", symbol="N", default=3.0
    )
    dwell = Parameter(
        "s", "time under the first deflection before the record", bounds=(1e-3, 1e9), symbol="t_0", default=1e9
    )
    (
        force_1,
        force_2,
        force_3,
        force_4,
        force_5,
        force_6,
        force_7,
        force_8,
        force_9,
        force_10,
        force_11,
        force_12,
        force_13,
    ) = (State("N", f"force in branch {number}") for number in range(1, INSIDE + 3))
    begun = State("1", "whether the first step has been taken")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """Every branch fades and adds what is remembered of the travel, at the first step also of the dwell."""
        forces = {}
        first = np.where(z.begun > 0.5, 0.0, x.old)
        for number, (stiffness, time) in enumerate(_branches(p), 1):
            old = getattr(z, f"force_{number}") + stiffness * np.exp(-p.dwell / time) * first
            forces[f"force_{number}"] = np.exp(-dt / time) * old + stiffness * fading_travel(x, dt, time)
        return Response(sum(forces.values()), begun=1.0, **forces)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the springs of all branches."""
        forces = [getattr(z, f"force_{number}") for number in range(1, INSIDE + 3)]
        return 0.5 * sum(force * force / stiffness for force, (stiffness, _) in zip(forces, _branches(p), strict=True))


def _branches(p: Any) -> list[tuple[Any, Any]]:
    """Stiffness (N/m) and relaxation time (s) of every branch."""
    distance = np.log(10.0) * p.decades / (INSIDE - 1 - 2 * MARGIN)
    strength = p.stiffness * np.sin(np.pi * p.order) / np.pi

    def density(time: Any) -> Any:
        return strength * np.exp(-p.order * np.log(2.0 * np.pi * p.reference * time))

    def at(number: float) -> Any:
        return np.exp((MARGIN - number) * distance) / (2.0 * np.pi * p.lowest)

    inside = [(distance * density(at(number)), at(number)) for number in range(INSIDE)]
    long, short = at(-0.5), at(INSIDE - 0.5)
    # all shorter times together are a dashpot, all longer ones a spring
    dashpot = FAR * density(short) / (1.0 - p.order), short / FAR
    spring = density(long) / p.order, FAR * long
    return [spring, *inside, dashpot]
