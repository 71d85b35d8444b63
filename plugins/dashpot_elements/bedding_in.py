"""Stiffness that is lost for good where the specimen has been."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Symbol


class BeddingIn(Element):
    """A spring softened by the largest deflection so far: F = stiffness x/(1 + reach/depth), reach = max |x|.

    The Mullins effect: below a deflection that was reached before nothing changes any more. Every record begins with a
    fresh specimen. Beside a spring it is the part of the stiffness that gets lost.
    """

    picture = Symbol.SPRING
    source = "Mullins, Rubber Chemistry and Technology 42 (1969) 339, for the effect"

    stiffness = Parameter("N/m", "stiffness of the fresh specimen", bounds=(1.0, 1e9), symbol="k")
    depth = Parameter("m", "reach that halves the stiffness", bounds=(1e-6, 10.0), symbol="x_h")
    reach = State("m", "largest deflection to either side so far")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The reach grows to the end of the step."""
        reach = np.maximum(z.reach, np.abs(x.new))
        return Response(p.stiffness * x.new / (1.0 + reach / p.depth), reach=reach)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the softened spring."""
        return 0.5 * p.stiffness * x.new * x.new / (1.0 + z.reach / p.depth)
