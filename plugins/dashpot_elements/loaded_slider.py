"""A sharp slider whose limit grows away from a middle."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Series, Symbol


class LoadedSlider(Element):
    """A spring behind a Coulomb slider under a load: |F| <= L, L = limit + growth |x - middle|.

    Below its limit the force follows the spring, dF = stiffness dx; at it the slider slides, and the force is the
    limit. The leaves of a spring, a strut that is bent by its wheel or rubber on a road are pressed together the more,
    the further they are deflected: with the ``middle`` at one end of the reach or beyond it the limit goes one way, as
    under the load of a spring, with the middle inside of it the loop is narrow there and wide at both ends. Solved
    exactly, on either side of the middle. Rate independent. The same with a smooth approach to sliding is
    `side_load_friction`.
    """

    picture = Series(Symbol.SPRING, Symbol.SLIDER)
    source = "Prandtl, ZAMM 8 (1928) 85, for the slider"

    stiffness = Parameter("N/m", "stiffness of the spring", bounds=(1.0, 1e9), symbol="k")
    limit = Parameter("N", "sliding force in the middle", bounds=(1e-3, 1e6), symbol="F_c")
    growth = Parameter(
        "N/m",
        "rise of the sliding force with the distance from the middle",
        bounds=(0.0, 1e9),
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
        force = _slide(z.force, x.old, turn, p)
        force = _slide(force, turn, x.new, p)
        return Response(force, force=force)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the spring."""
        return 0.5 * z.force * z.force / p.stiffness


def _slide(force: Any, old: Any, new: Any, p: Any) -> Any:
    """The force after a way on one side of the middle: along it the limit is a straight line, and once reached kept."""
    limit = p.limit + p.growth * np.abs(new - p.middle)
    return np.minimum(np.maximum(force + p.stiffness * (new - old), -limit), limit)
