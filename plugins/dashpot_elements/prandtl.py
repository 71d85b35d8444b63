"""Friction behind a spring."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.special import wrightomega

from dashpot.model.element import Element, Motion, Parameter, Response, State

NEWTON_STEPS = 14
TINY = 1e-75  # its fourth power is still a number


class Prandtl(Element):
    """A spring in series with a Dahl slider: dF/dx = k s u^i/(1 + s u^i), u = 1 - F/limit sgn(v).

    ``sharpness`` s is the stiffness of the slider over that of the spring: the larger, the more the element is an ideal
    elastic-perfectly-plastic one. For i = 1 the step is s u + ln u = s u0 + ln u0 - way, solved by the Wright omega
    function; for other exponents by Newton's method in the variable that makes the equation convex.
    """

    source = "Corless and Jeffrey, The Wright omega function (2002), for the solution"

    stiffness = Parameter("N/m", "stiffness of the spring", bounds=(1.0, 1e9), symbol="k_p")
    limit = Parameter("N", "sliding force", bounds=(1e-3, 1e6), symbol="F_c")
    sharpness = Parameter("1", "stiffness of the slider over that of the spring", bounds=(0.1, 1e3), symbol="s",
                          default=10.0)  # fmt: skip
    exponent = Parameter("1", "shape of the approach to sliding", bounds=(0.0, 4.0), scale="linear", symbol="i",
                         default=1.0)  # fmt: skip
    force = State("N", "force in the branch")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """Move u, the distance to sliding, along the travel of the step."""
        side = np.where(x.travel < 0.0, -1.0, 1.0)
        distance = np.maximum(1.0 - side * z.force / p.limit, TINY)
        way = p.sharpness * p.stiffness * np.abs(x.travel) / p.limit
        smooth = _smooth(distance, way, p.sharpness)
        left = np.where(p.exponent == 1.0, smooth, _general(distance, way, p.sharpness, p.exponent))
        force = side * p.limit * (1.0 - left)
        return Response(force, force=force)


def _smooth(distance: Any, way: Any, sharpness: Any) -> Any:
    start = sharpness * distance
    return wrightomega(np.log(start) + start - way) / sharpness


def _general(distance: Any, way: Any, sharpness: Any, exponent: Any) -> Any:
    # unknown w = u^power: u itself above exponent 1, u^(1 - exponent) below, where the equation is concave in w
    excess = np.where(exponent == 1.0, 1.0, exponent - 1.0)
    power = np.where(exponent < 1.0, -excess, 1.0)
    begin = distance**-excess
    dahl = distance * np.exp(-np.log1p(np.maximum(excess * way / begin, 0.0)) / excess)
    below = np.maximum(distance - way / sharpness, dahl)
    w = np.where(exponent < 1.0, distance**power, below)
    for _ in range(NEWTON_STEPS):
        u = w ** (1.0 / power)
        # the integral of u^-exponent, without cancellation near exponent 1
        miss = sharpness * (distance - u) + begin * np.expm1(-excess * np.log(u / distance)) / excess - way
        slope = (sharpness * u ** (1.0 - power) + u ** (-excess - power)) / power
        w = np.maximum(w + miss / slope, TINY)
    stuck = (exponent < 1.0) & (way >= sharpness * distance - begin / excess)
    return np.where(stuck, 0.0, w ** (1.0 / power))
