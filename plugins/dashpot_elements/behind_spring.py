"""A dashpot of any rising law in series with a spring, moved over a step.

The spring of stiffness k is stretched by e = F/k, the dashpot has the rest of the velocity, w = v - e', and both carry
F = k e = g(w). One step is that of TR-BDF2: a trapezoid up to 2 - sqrt(2) of the step, a backward difference from
there. It is of second order and damps what is faster than the step, so that a stiff spring leaves g(v).
Both parts ask for the w at which g(w) + rate w is a given force; the law answers it.

Source: Bank, Coughran, Fichtner, Grosse, Rose and Smith, IEEE Trans. Computer-Aided Design 4 (1985) 436;
Hosea and Shampine, Applied Numerical Mathematics 20 (1996) 21.
"""

from __future__ import annotations

from collections.abc import Callable
from math import sqrt
from typing import Any

from dashpot.model.element import Motion, Response, State

PART = 2.0 - sqrt(2.0)  # of the step, up to which the trapezoid goes
SHARE = 0.5 * PART  # of the step, by which the unknown velocity counts in both parts
NEAR, FAR = 1.0 / (PART * (2.0 - PART)), (1.0 - PART) ** 2 / (PART * (2.0 - PART))

# force and velocity of the dashpot from what is given and the rate in N s/m
Law = Callable[[Any, Any], tuple[Any, Any]]


def memory() -> tuple[State, State]:
    """The states of the spring and of the dashpot."""
    return State("N", "force in the branch"), State("m/s", "velocity of the dashpot")


def pressed(x: Motion, z: Any, stiffness: Any, dt: Any, law: Law) -> Response:
    """The force of the branch and its states after a step; ``z`` has ``load`` and ``speed``."""
    rate = SHARE * dt * stiffness
    load, _ = law(z.load + rate * (x.velocity_old - z.speed + middle_velocity(x, dt)), rate)
    load, speed = law(NEAR * load - FAR * z.load + rate * x.velocity_new, rate)
    return Response(load, load=load, speed=speed)


def middle_velocity(x: Motion, dt: Any) -> Any:
    """The velocity of the cubic path in m/s where the trapezoid ends."""
    bow = x.travel / dt - 0.5 * (x.velocity_old + x.velocity_new)
    return (1.0 - PART) * x.velocity_old + PART * x.velocity_new + 6.0 * PART * (1.0 - PART) * bow
