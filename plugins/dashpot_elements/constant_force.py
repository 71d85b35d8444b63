"""A force that does not move with anything."""

from __future__ import annotations

from typing import Any

from dashpot.model.element import Element, Motion, Parameter, Response
from dashpot.model.picture import Symbol


class ConstantForce(Element):
    """A force that is always the same: F = force.

    A weight, or pressure on an area: `force: {start: 0 N, over: {setting: pressure, at: 0 bar, slope: 100 N/bar}}`.
    Not passive: it does work on whatever gives way.
    """

    picture = Symbol.BOX
    passive = False

    force = Parameter("N", "the force", bounds=(-1e9, 1e9), scale="linear", symbol="F")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The same at every place; it has to depend on the motion in form only."""
        return Response(p.force)
