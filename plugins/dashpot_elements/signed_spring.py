"""A stiffness of either sign."""

from __future__ import annotations

from typing import Any

from dashpot.model.element import Element, Motion, Parameter, Response
from dashpot.model.picture import Symbol


class SignedSpring(Element):
    """A linear spring whose stiffness may be negative: F = stiffness x.

    Magnets and toggles beside a spring, or what its stiffness changes by over a setting, whatever its curve is:
    `stiffness: {fixed: 0 N/mm, over: {setting: pressure, at: 2 bar, slope: {start: 0}}}`. Not passive by
    itself: beside a spring that is stiffer it is.
    """

    picture = Symbol.SPRING
    passive = False

    stiffness = Parameter("N/m", "stiffness, of either sign", bounds=(-1e12, 1e12), scale="linear", symbol="k")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """In proportion to the deflection at the end of the step."""
        return Response(p.stiffness * x.new)
