"""Hysteresis after Bouc and Wen."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Symbol

PIECES = 2
FAR, TINY = 30.0, 1e-30


class BoucWen(Element):
    """Smooth hysteresis: dF/dx = stiffness (1 - |F/limit|^exponent (shape sgn(F v) + 1 - shape)).

    In the classical numbers A, beta, gamma and n the stiffness is A, the limit (A/(beta + gamma))^(1/n), the shape
    beta/(beta + gamma) and the exponent n. From half a shape on the law is passive: with 1/2 it unloads along a
    straight line, with 1 along a bulging one. Rate independent; minor loops drift.

    For exponent 1 solved exactly; for others by the fourth-order Runge-Kutta method in the logarithm of the distance to
    the limit, in which the rate is smooth and bounded, so that long steps do no harm.
    """

    picture = Symbol.SLIDER
    source = "Wen, J. Eng. Mech. Div. ASCE 102 (1976) 249"
    exact = False

    stiffness = Parameter("N/m", "slope at zero force", bounds=(1e-3, 1e12), symbol="k")
    limit = Parameter("N", "largest force", bounds=(1e-6, 1e9), symbol="F_y")
    shape = Parameter("1", "beta/(beta + gamma)", bounds=(0.5, 1.0), scale="linear", symbol="b", default=0.5)
    exponent = Parameter("1", "sharpness of the knee", bounds=(1.0, 10.0), scale="linear", symbol="n", default=1.0)
    force = State("N", "hysteretic force")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """Move the force, measured by the limit and along the motion, over a dimensionless way."""
        side = np.where(x.travel < 0.0, -1.0, 1.0)
        level = side * z.force / p.limit
        way = p.stiffness * np.abs(x.travel) / p.limit
        bulge = 2.0 * p.shape - 1.0
        level = np.where(p.exponent == 1.0, _plain(level, way, bulge), _curved(level, way, bulge, p.exponent))
        force = side * p.limit * level
        return Response(force, force=force)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of a spring that the force bends; it slips for the rest of the way."""
        return 0.5 * z.force * z.force / p.stiffness


def _plain(level: Any, way: Any, bulge: Any) -> Any:
    """The level after a way with exponent 1: against the motion it goes to zero, with it from there to one."""
    against = np.maximum(-level, 0.0)
    bent = np.maximum(bulge, TINY)  # a shape of 1/2 is a straight line
    back = np.log1p(bent * against) / bent
    behind = np.maximum(back - way, 0.0)
    ahead = np.maximum(way - back, 0.0)
    return (1.0 - np.exp(-ahead)) + np.maximum(level, 0.0) * np.exp(-ahead) - np.expm1(bent * behind) / bent


def _curved(level: Any, way: Any, bulge: Any, exponent: Any) -> Any:
    # with level = 1 - exp(-s)
    s = -np.log1p(-np.minimum(level, 1.0 - np.exp(-FAR)))
    piece = way / PIECES
    for _ in range(PIECES):
        first = _rate(s, bulge, exponent)
        second = _rate(s + 0.5 * piece * first, bulge, exponent)
        third = _rate(s + 0.5 * piece * second, bulge, exponent)
        last = _rate(s + piece * third, bulge, exponent)
        s = s + piece / 6.0 * (first + 2.0 * (second + third) + last)
    return -np.expm1(-s)


def _rate(s: Any, bulge: Any, exponent: Any) -> Any:
    """ds/dway = (1 - level^n)/(1 - level) with the motion, (1 + bulge |level|^n)/(1 + |level|) against it."""
    left = np.exp(-np.minimum(s, FAR))
    level = 1.0 - left
    power = np.exp(exponent * np.log(np.maximum(np.abs(level), TINY)))
    return np.where(level > 0.0, 1.0 - power, 1.0 + bulge * power) / left
