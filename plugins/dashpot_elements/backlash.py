"""Lost motion."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Series, Symbol


class Backlash(Element):
    """A spring that is pushed to and fro through play: F = stiffness s, s follows x at a distance of at most the gap.

    After a turn nothing moves until the play is crossed, 2 gap long. It stands for lost motion in a chain of sensors or
    levers. As the spring follows late, the force gives work back.
    """

    picture = Series(Symbol.PLAY, Symbol.SPRING)
    source = "Brokate and Sprekels, Hysteresis and Phase Transitions (1996), for the play operator"
    passive = False

    stiffness = Parameter("N/m", "stiffness behind the play", bounds=(1e-3, 1e12), symbol="k")
    gap = Parameter("m", "play to either side", bounds=(1e-8, 100.0), symbol="g")
    follower = State("m", "deflection behind the play")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The play operator at the end of the step."""
        follower = np.minimum(np.maximum(z.follower, x.new - p.gap), x.new + p.gap)
        return Response(p.stiffness * follower, follower=follower)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the spring behind the play."""
        return 0.5 * p.stiffness * z.follower * z.follower
