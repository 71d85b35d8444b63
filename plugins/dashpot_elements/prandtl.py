"""Friction behind a spring."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Series, Symbol
from dashpot.model.special import wrightomega

NEWTON_STEPS = 5
TINY = 1e-75  # its fourth power is still a number


class Prandtl(Element):
    """A spring in series with a Dahl slider: dF/dx = k s u^i/(1 + s u^i), u = 1 - F/limit sgn(v).

    k is the stiffness, i the exponent. The sharpness s is the stiffness of the slider over that of the spring: the
    larger, the more the element is an ideal elastic-perfectly-plastic one. For i = 1 the step is s u + ln u = s u0 +
    ln u0 - way, solved by the Wright omega function; for other exponents by Newton's method in the variable that makes
    the equation convex.
    """

    picture = Series(Symbol.SPRING, Symbol.SLIDER)
    source = "Corless and Jeffrey, The Wright omega function (2002), for the solution"

    stiffness = Parameter("N/m", "stiffness of the spring", bounds=(1.0, 1e9), symbol="k_p")
    limit = Parameter("N", "sliding force", bounds=(1e-3, 1e6), symbol="F_c")
    sharpness = Parameter("1", "stiffness of the slider over that of the spring", bounds=(0.1, 1e3), symbol="s",
                          default=10.0)  # fmt: skip
    exponent = Parameter("1", "shape of the approach to sliding", bounds=(0.0, 4.0), scale="linear", symbol="i",
                         default=1.0)  # fmt: skip
    force = State("N", "force in the branch")
    side = State("1", "direction of the last step")
    reach = State("1", "s u + ln(s u), which sinks by the way (i = 1)")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """Move u, the distance to sliding, along the travel of the step."""
        side = np.where(x.travel < 0.0, -1.0, 1.0)
        distance = np.maximum(1.0 - side * z.force / p.limit, TINY)
        way = p.sharpness * p.stiffness * np.abs(x.travel) / p.limit
        start = p.sharpness * distance
        # only a turn takes the logarithm: from there on the reach goes down with the way
        reach = np.where(side != z.side, np.log(start) + start, z.reach) - way
        smooth = wrightomega(reach) / p.sharpness
        left = np.where(p.exponent == 1.0, smooth, _general(distance, way, p.sharpness, p.exponent))
        force = side * p.limit * (1.0 - left)
        return Response(force, force=force, side=side, reach=reach)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the spring and of the bristles of the slider."""
        return 0.5 * z.force * z.force / p.stiffness * (1.0 + 1.0 / p.sharpness)


def _general(distance: Any, way: Any, sharpness: Any, exponent: Any) -> Any:
    return np.where(exponent > 0.5, _gradual(distance, way, sharpness, exponent),
                    _abrupt(distance, way, sharpness, exponent))  # fmt: skip


def _gradual(distance: Any, way: Any, sharpness: Any, exponent: Any) -> Any:
    # with u = unit v the equation is v - L(v) = level, L(v) = (v^-excess - 1)/excess, a Wright omega function where
    # excess is 0; it is concave, and Newton's method climbs to its root from any start below
    excess = np.where(exponent == 1.0, 1.0, exponent - 1.0)
    unit = sharpness ** (-1.0 / np.maximum(exponent, 0.5))
    begin, go = distance / unit, way / (sharpness * unit)
    level = begin - _power_law(begin, excess) - go
    v = np.maximum(_below(level, excess), TINY)
    for _ in range(NEWTON_STEPS):
        miss = begin - v + begin**-excess * np.expm1(-excess * np.log(v / begin)) / excess - go
        v = np.maximum(v + miss / (1.0 + v**-exponent), TINY)
    stuck = (exponent < 1.0) & (1.0 - excess * level <= 0.0)
    return np.where(stuck, 0.0, unit * v)


def _below(level: Any, excess: Any) -> Any:
    # from v <= max(1, level) and L(v) >= -level an upper bound, which put into L(v) = v - level gives a lower one
    above = np.minimum(np.maximum(level, 1.0), np.exp(-np.log1p(np.maximum(-excess * level, -1.0)) / excess))
    lower = np.exp(-np.log1p(np.maximum(excess * (above - level), -1.0)) / excess)
    far = np.maximum(level, 1.0)
    return np.where(level > 1.0, np.maximum(lower, far + _power_law(far, excess)), lower)


def _power_law(v: Any, excess: Any) -> Any:
    return np.expm1(-excess * np.log(v)) / excess


def _abrupt(distance: Any, way: Any, sharpness: Any, exponent: Any) -> Any:
    # with w = u^power the equation s w^(1/power) + w/power = level is convex; each term alone bounds w from above
    power = np.maximum(1.0 - exponent, 0.5)
    level = np.maximum(sharpness * distance + distance**power / power - way, TINY)
    w = np.minimum(power * level, (level / sharpness) ** power)
    for _ in range(NEWTON_STEPS):
        miss = sharpness * w ** (1.0 / power) + w / power - level
        w = np.maximum(w - power * miss / (1.0 + sharpness * w ** (1.0 / power - 1.0)), TINY)
    return w ** (1.0 / power)
