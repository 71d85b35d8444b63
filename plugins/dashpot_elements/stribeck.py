"""Dry friction that falls with speed."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Symbol
from dashpot_elements.dahl import approach

TINY = 1e-12


class Stribeck(Element):
    """A Dahl slider whose limit L falls with speed: dF/dx = stiffness |u|^exponent sgn(u), u = 1 - F/L sgn(v),
    L = limit + (breakaway - limit) exp(-|v/stribeck_velocity|^decay).

    A force above a limit that fell comes down with dF/dx = stiffness u, whatever the exponent.

    The limit is frozen over a step at the mean speed; where the path turns, both pieces have their own. Second order in
    the step.
    """

    picture = Symbol.SLIDER
    source = "Canudas de Wit et al., IEEE Trans. Automatic Control 40 (1995) 419, for the limit"
    exact = False

    stiffness = Parameter("N/m", "slope of the unloaded slider", bounds=(1.0, 1e9), symbol="sigma")
    limit = Parameter("N", "sliding force at high speed", bounds=(1e-3, 1e6), symbol="F_c")
    breakaway = Parameter("N", "sliding force at very low speed", bounds=(1e-3, 1e6), symbol="F_s")
    stribeck_velocity = Parameter("m/s", "speed over which the force falls", bounds=(1e-5, 10.0), symbol="v_s")
    decay = Parameter("1", "steepness of the fall", bounds=(0.5, 4.0), scale="linear", symbol="delta", default=2.0)
    exponent = Parameter(
        "1", "shape of the approach to sliding", bounds=(0.0, 4.0), scale="linear", symbol="i", default=1.0
    )
    force = State("N", "friction force")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """From the beginning of the step to its turning point, and on to its end."""
        turns = x.velocity_old * x.velocity_new < 0.0
        middle = np.where(turns, _turning_place(x, dt), x.new)
        speed = 0.5 * np.abs(np.where(turns, x.velocity_old, x.velocity_old + x.velocity_new))
        force = _slide(z.force, middle - x.old, speed, p)
        force = _slide(force, x.new - middle, 0.5 * np.abs(x.velocity_new), p)
        return Response(force, force=force)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the bristles, which bend as springs of the stiffness and slip for the rest of the way."""
        return 0.5 * z.force * z.force / p.stiffness


def _slide(force: Any, travel: Any, speed: Any, p: Any) -> Any:
    ratio = np.maximum(speed / p.stribeck_velocity, TINY)
    limit = p.limit + (p.breakaway - p.limit) * np.exp(-np.exp(p.decay * np.log(ratio)))
    side = np.where(travel < 0.0, -1.0, 1.0)
    way = p.stiffness * np.abs(travel) / limit
    distance = 1.0 - side * force / limit
    left = np.where(distance < 0.0, distance * np.exp(-way), approach(distance, way, p.exponent))
    return side * limit * (1.0 - left)


def _turning_place(x: Motion, dt: Any) -> Any:
    """Where the cubic path turns whose velocity v_old + b u + c u^2 changes its sign once over u = 0..1."""
    rise = x.travel / dt
    c = 3.0 * (x.velocity_old + x.velocity_new) - 6.0 * rise
    b = x.velocity_new - x.velocity_old - c
    root = np.sqrt(np.maximum(b * b - 4.0 * c * x.velocity_old, 0.0))
    u = 2.0 * x.velocity_old / (np.where(x.velocity_old < 0.0, -root, root) - b)
    return x.old + dt * u * (x.velocity_old + u * (0.5 * b + u * (c / 3.0)))
