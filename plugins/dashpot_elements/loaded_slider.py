"""A sharp slider whose limit grows away from a middle."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.picture import Series, Symbol
from dashpot_elements.side_load_friction import SideLoadFriction


class LoadedSlider(SideLoadFriction):
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

    def slide(self, force: Any, old: Any, new: Any, p: Any) -> Any:
        """The force after a way on one side of the middle: a limit that is reached is kept up to its end."""
        limit = p.limit + p.growth * np.abs(new - p.middle)
        return np.minimum(np.maximum(force + p.stiffness * (new - old), -limit), limit)
