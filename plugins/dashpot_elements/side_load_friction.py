"""Dry friction that grows away from a middle position."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Picture, Symbol

SMALL = 1e-5


class SideLoadFriction(Element):
    """A Dahl slider whose limit L grows with the distance from a middle: dF/dx = stiffness (1 - F/L sgn(v)),
    L = limit + growth |x - middle|.

    A strut that is bent by its wheel, a tilted mount or a belt on its guide presses the sliding faces together the
    more, the further it is from where it stands straight; the loop is narrow in the middle and wide at both ends.
    Solved exactly, on either side of the middle. Rate independent. With no growth it is `dahl` of exponent 1. For a
    limit that goes one way over the whole reach, give `dahl` a `scale`.
    """

    picture: ClassVar[Picture] = Symbol.SLIDER
    source = "Dahl, AIAA J. 14 (1976) 1675, for the slider"

    stiffness = Parameter("N/m", "slope of the unloaded slider", bounds=(1e-3, 1e12), symbol="sigma")
    limit = Parameter("N", "sliding force in the middle", bounds=(1e-6, 1e9), symbol="F_c")
    growth = Parameter(
        "N/m",
        "rise of the sliding force with the distance from the middle",
        bounds=(0.0, 1e12),
        scale="linear",
        symbol="g",
    )
    middle = Parameter(
        "m",
        "deflection at which the sliding force is least",
        bounds=(-10.0, 10.0),
        scale="linear",
        symbol="x_0",
        default=0.0,
    )
    force = State("N", "friction force")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """Up to the middle, where the way crosses it, and on to the end."""
        turn = np.minimum(np.maximum(p.middle, np.minimum(x.old, x.new)), np.maximum(x.old, x.new))
        force = self.slide(self.slide(z.force, x.old, turn, p), turn, x.new, p)
        return Response(force, force=force)

    def slide(self, force: Any, old: Any, new: Any, p: Any) -> Any:
        """The force after a way on one side of the middle, along which the limit is a straight line.

        With y = ln(L_new/L_old)/(L_new - L_old) the mean of 1/L, what is left of the old force is
        exp(-stiffness way y).
        """
        side = np.where(new < old, -1.0, 1.0)
        way = np.abs(new - old)
        before, after = (p.limit + p.growth * np.abs(place - p.middle) for place in (old, new))
        rise = (after - before) / before
        stretched = p.stiffness * way / before * _log1p_over(rise)
        return np.exp(-stretched) * force + side * p.stiffness * way * after / before * _mean_fading(stretched, rise)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the bristles, which bend as springs of the stiffness and slip for the rest of the way."""
        return 0.5 * z.force * z.force / p.stiffness


def _mean_fading(stretched: Any, rise: Any) -> Any:
    """integral of exp(-(stretched + l) s) l/rise over s = 0..1, l = ln(1 + rise): what a way adds, over its elastic
    part and the limits' ratio.
    """
    exponent = stretched + np.log1p(rise)
    near = 1.0 - exponent * (0.5 - exponent * (1.0 / 6.0 - exponent / 24.0))
    close = np.abs(exponent) < SMALL
    faded = np.where(close, near, -np.expm1(-exponent) / np.where(close, 1.0, exponent))
    return faded * _log1p_over(rise)


def _log1p_over(rise: Any) -> Any:
    """ln(1 + rise)/rise, one at zero."""
    close = np.abs(rise) < SMALL
    near = 1.0 - rise * (0.5 - rise * (1.0 / 3.0 - rise * 0.25))
    return np.where(close, near, np.log1p(rise) / np.where(close, 1.0, rise))
