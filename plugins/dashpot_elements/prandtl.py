"""Friction behind a spring."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Series, Symbol
from dashpot.model.special import wrightomega

STEPS = 2
TINY = 1e-75  # its fourth power is still a number
NEARLY = 1e-12 - 1.0


class Prandtl(Element):
    """A spring in series with a Dahl slider: dF/dx = k s u^i/(1 + s u^i), u = 1 - F/limit sgn(v).

    k is the stiffness, i the exponent. The sharpness s is the stiffness of the slider over that of the spring: the
    larger, the more the element is an ideal elastic-perfectly-plastic one. For i = 1 the step is s u + ln u = s u0 +
    ln u0 - way, solved by the Wright omega function; for other exponents by Householder's method in ln u.
    """

    picture = Series(Symbol.SPRING, Symbol.SLIDER)
    source = "Corless and Jeffrey, The Wright omega function (2002), for the solution"

    stiffness = Parameter("N/m", "stiffness of the spring", bounds=(1e-3, 1e12), symbol="k_p")
    limit = Parameter("N", "sliding force", bounds=(1e-6, 1e9), symbol="F_c")
    sharpness = Parameter(
        "1", "stiffness of the slider over that of the spring", bounds=(0.1, 1e3), symbol="s", default=10.0
    )
    exponent = Parameter(
        "1", "shape of the approach to sliding", bounds=(0.0, 4.0), scale="linear", symbol="i", default=1.0
    )
    force = State("N", "force in the branch")
    side = State("1", "direction of the last step")
    reach = State("1", "what sinks in proportion to the way; s u + ln(s u) for i = 1")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """Move u, the distance to sliding, along the travel of the step."""
        side = np.where(x.travel < 0.0, -1.0, 1.0)
        distance = np.maximum(1.0 - side * z.force / p.limit, TINY)
        way = p.sharpness * p.stiffness * np.abs(x.travel) / p.limit
        form = _Form.of(p.sharpness, p.exponent)
        # only a turn takes the logarithm: from there on the reach goes down with the way
        reach = np.where(side != z.side, form.reach(distance / form.unit), z.reach) - way / form.pace
        left = np.where(p.exponent == 1.0, wrightomega(reach) / p.sharpness, form.unit * form.place(reach))
        force = side * p.limit * (1.0 - left)
        return Response(force, force=force, side=side, reach=reach)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the spring and of the bristles of the slider."""
        return 0.5 * z.force * z.force / p.stiffness * (1.0 + 1.0 / p.sharpness)


@dataclass(frozen=True)
class _Form:
    """The equation of a step: v = u/unit with slope v + (1 - v^-excess)/excess = reach, which sinks by way/pace.

    It is a Wright omega function where the excess of the exponent over one is 0. Up to an exponent of 1/2 it is that of
    u itself; above it the scale is such that both terms weigh the same at v = 1.
    """

    exponent: Any
    excess: Any
    abrupt: Any
    unit: Any
    slope: Any
    pace: Any

    @classmethod
    def of(cls, sharpness: Any, exponent: Any) -> _Form:
        excess = np.where(exponent == 1.0, 1.0, exponent - 1.0)
        abrupt = exponent <= 0.5
        unit = np.where(abrupt, 1.0, sharpness ** (-1.0 / np.maximum(exponent, 0.5)))
        slope = np.where(abrupt, sharpness, 1.0)
        return cls(exponent, excess, abrupt, unit, slope, sharpness * unit / slope)

    def reach(self, v: Any) -> Any:
        """The reach at a place."""
        low = np.log(v)
        return self.slope * v + np.where(self.exponent == 1.0, low, -np.expm1(-self.excess * low) / self.excess)

    def place(self, reach: Any) -> Any:
        """The place of a reach, by Householder's method in y = log(v): both terms are exponential functions of it, and
        so are their derivatives. Two steps of fourth order leave 1e-13."""
        y = self._start(reach)
        for _ in range(STEPS):
            line, bend = self.slope * np.exp(y), np.expm1(-self.excess * y)
            curved = 1.0 + bend
            first, second = line + curved, line - self.excess * curved
            third = line + self.excess * self.excess * curved
            move = (reach - line + bend / self.excess) / first
            part = move / first
            y = y + move * (1.0 + 0.5 * second * part) / (1.0 + second * part + third * part * move / 6.0)
        # below exponent one the slider slips fully after a finite way
        return np.where((self.exponent < 1.0) & (self.excess * reach >= 1.0), 0.0, np.exp(y))

    def _start(self, reach: Any) -> Any:
        # the straight term alone, or the curved one beside what the other is at most
        over = reach > 1.0
        rest = np.maximum(self.excess * (1.0 - reach), -0.7 * self.excess * reach - 0.3)
        gradual = np.where(over, reach - 1.0, rest)
        low = np.log1p(np.maximum(np.where(self.abrupt, reach - 1.0 / self.excess - 1.0, gradual), NEARLY))
        straight, curved = low - np.log(self.slope), -(low + np.log(np.abs(self.excess))) / self.excess
        return np.where(self.abrupt, np.minimum(straight, curved), np.where(over, low, -low / self.excess))
