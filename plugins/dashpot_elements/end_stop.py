"""Stops at the ends of the free travel."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response
from dashpot.model.picture import Series, Symbol

OUT_OF_REACH = 1e3


class EndStop(Element):
    """Buffers beyond two places: F = stiffness depth (depth/reference)^(exponent - 1), against the motion.

    The depth is how far the deflection lies above ``compression`` or below ``rebound``. The rebound stop is out of
    reach unless it is given: a strap that is taut below a deflection is one. With exponent 1 the reference depth does
    not matter. Not passive where a place is beyond zero, as it is strained from the beginning.
    """

    picture = Series(Symbol.GAP, Symbol.SPRING)
    passive = False

    stiffness = Parameter("N/m", "force over depth at the reference depth", bounds=(1e-3, 1e12), symbol="k")
    compression = Parameter(
        "m",
        "deflection at which the compression stop is touched",
        bounds=(-OUT_OF_REACH, OUT_OF_REACH),
        scale="linear",
        symbol="x_c",
    )
    rebound = Parameter(
        "m",
        "deflection at which the rebound stop is touched",
        bounds=(-OUT_OF_REACH, OUT_OF_REACH),
        scale="linear",
        symbol="x_r",
        default=-OUT_OF_REACH,
    )
    exponent = Parameter("1", "power of the depth", bounds=(1.0, 5.0), scale="linear", symbol="n", default=1.0)
    reference = Parameter(
        "m", "depth at which the stiffness is given", bounds=(1e-8, 100.0), symbol="x_0", default=1e-3
    )

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """Both buffers at the end of the step."""
        compression = (np.maximum(x.new - p.compression, 0.0) / p.reference) ** p.exponent
        rebound = (np.maximum(p.rebound - x.new, 0.0) / p.reference) ** p.exponent
        return Response(p.stiffness * p.reference * (compression - rebound))
