"""Stiffness that fades with time."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Symbol


class FadingSpring(Element):
    """A spring that softens with time, however it moves: F = stiffness x exp(-t/time).

    Every record begins at t = 0. Beside a spring it is the part of the stiffness that is lost, as where the specimen
    warms up at an even rate. Not passive by itself, as a spring that stiffens again between records takes up energy.
    """

    picture = Symbol.SPRING
    passive = False

    stiffness = Parameter("N/m", "stiffness that is lost in the end", bounds=(1e-3, 1e12), symbol="k")
    time = Parameter("s", "time constant of the loss", bounds=(1e-2, 1e5), symbol="T")
    lost = State("1", "share of the stiffness that is lost")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """What is left of the stiffness fades."""
        lost = 1.0 - (1.0 - z.lost) * np.exp(-dt / p.time)
        return Response(p.stiffness * x.new * (1.0 - lost), lost=lost)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of what is left of the spring."""
        return 0.5 * p.stiffness * x.new * x.new * (1.0 - z.lost)
