"""A dashpot of any power with a spring in series."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response
from dashpot.model.picture import Series, Symbol
from dashpot_elements.behind_spring import memory, pressed

STEPS = 3
REST = 1e-3  # of the reference velocity, below which the curve is a straight line


class CompliantDamper(Element):
    """A dashpot in series with a spring: F = force r |r|^(exponent - 1), r = (v - F'/stiffness)/reference.

    The exponent 1 is `maxwell`, 2 turbulent flow behind the compliance of oil, hoses and mounts, and towards 0 a slider
    behind a spring. A piston rod in a soft mount looks like a delay of the force where the spring is stiff, and like a
    spring where the damper is strong. Below a thousandth of the reference velocity the curve is a straight line through
    zero, so that its slope is finite at rest. A `series:` of a spring and any other law does the same for all laws;
    this one is a single branch.

    One step follows TR-BDF2, of second order in the step; its equation is solved by Householder's method in
    logarithms, where it converges for every number.
    """

    picture = Series(Symbol.SPRING, Symbol.DASHPOT)
    source = "Hosea and Shampine, Applied Numerical Mathematics 20 (1996) 21, for TR-BDF2"
    exact = False

    stiffness = Parameter("N/m", "stiffness in series", bounds=(1e-3, 1e12), symbol="k")
    force = Parameter("N", "force at the reference velocity", bounds=(1e-6, 1e9), symbol="F_r")
    exponent = Parameter("1", "power of the velocity", bounds=(0.05, 4.0), scale="linear", symbol="n", default=1.0)
    reference = Parameter("m/s", "velocity at which the force is given", bounds=(1e-8, 1e3), symbol="v_r", default=0.1)
    load, speed = memory()

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """Spring and dashpot together."""

        def law(given: Any, rate: Any) -> tuple[Any, Any]:
            drag = rate * p.reference / p.force
            size = np.maximum(np.abs(given) / p.force, REST**p.exponent + REST * drag)
            share, ratio = _flow(size, drag, p.exponent)
            return given * share, given / (size * p.force) * ratio * p.reference

        return pressed(x, z, p.stiffness, dt, law)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the spring."""
        return 0.5 * z.load * z.load / p.stiffness


def _flow(given: Any, drag: Any, exponent: Any) -> tuple[Any, Any]:
    """The share that r^exponent has in r^exponent + drag r = given, and r.

    Householder's method in y = log(r), in which both terms are exponential functions. The start, one of both terms
    alone, is at most ln 2 too large for the logarithm of their sum; three steps of fourth order leave 1e-14.
    """
    aim, straight = np.log(given), np.log(drag)
    excess = exponent - 1.0
    y = np.minimum(aim - straight, aim / exponent)
    for _ in range(STEPS):
        power, line = exponent * y, straight + y
        lesser = np.exp(-np.abs(power - line))
        share = np.where(power > line, 1.0, lesser) / (1.0 + lesser)
        first, bend = 1.0 + excess * share, excess * excess * share * (1.0 - share)
        move = (aim - np.maximum(power, line) - np.log1p(lesser)) / first
        part = move / first
        last = excess * bend * (1.0 - 2.0 * share)
        y = y + move * (1.0 + 0.5 * bend * part) / (1.0 + bend * part + last * part * move / 6.0)
    return np.exp(exponent * y - aim), np.exp(y)
