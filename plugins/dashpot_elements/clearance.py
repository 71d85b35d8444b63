"""A joint with play."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response
from dashpot.model.picture import Series, Symbol


class Clearance(Element):
    """A spring whose joint has play: no force while |s| < gap, beyond that F = stiffness (|s| - gap) sgn(s),
    s = x - place.

    The spring brings itself back to the middle of its play, so there is no memory. For a part that stays where it was
    pushed see ``backlash``. Not passive where the play does not hold the zero of the deflection, as it is strained from
    the beginning.
    """

    picture = Series(Symbol.PLAY, Symbol.SPRING)
    passive = False

    stiffness = Parameter("N/m", "stiffness where the play is used up", bounds=(1e-3, 1e12), symbol="k")
    gap = Parameter("m", "play to either side", bounds=(1e-8, 100.0), symbol="g")
    place = Parameter("m", "middle of the play", bounds=(-100.0, 100.0), scale="linear", symbol="x_0", default=0.0)

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The law at the end of the step."""
        away = x.new - p.place
        return Response(p.stiffness * (np.maximum(away - p.gap, 0.0) + np.minimum(away + p.gap, 0.0)))
