"""Stiffness that is lost for good where the specimen has been."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Symbol


class BeddingIn(Element):
    """A spring softened by the largest deflection so far: F = stiffness x (1 + reach/depth)^-exponent, reach = max |x|.

    The Mullins effect: below a deflection that was reached before nothing changes any more. Every record begins with a
    fresh specimen, or with one that was deflected as far as `before` says: `{setting: reached, value: 0 mm}` is the
    largest deflection in all runs before. Beside a spring it is the part of the stiffness that gets lost.
    """

    picture = Symbol.SPRING
    source = "Mullins, Rubber Chemistry and Technology 42 (1969) 339, for the effect"

    stiffness = Parameter("N/m", "stiffness of the fresh specimen", bounds=(1e-3, 1e12), symbol="k")
    depth = Parameter("m", "reach that halves the stiffness, its exponent being 1", bounds=(1e-8, 100.0), symbol="x_h")
    exponent = Parameter("1", "steepness of the loss", bounds=(0.1, 20.0), symbol="n", default=1.0)
    before = Parameter(
        "m", "largest deflection before the record", bounds=(0.0, 100.0), scale="linear", symbol="x_0", default=0.0
    )
    reach = State("m", "largest deflection to either side so far")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The reach grows to the end of the step."""
        reach = np.maximum(z.reach, np.abs(x.new))
        return Response(_softened(p, np.maximum(reach, p.before)) * x.new, reach=reach)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the softened spring."""
        return 0.5 * _softened(p, np.maximum(z.reach, p.before)) * x.new * x.new


def _softened(p: Any, reach: Any) -> Any:
    return p.stiffness * np.exp(-p.exponent * np.log1p(reach / p.depth))
