"""Damping that fades with time."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Symbol


class FadingDamper(Element):
    """A dashpot that fades with time, however it moves: F = damping v exp(-t/time).

    Every record begins at t = 0. Beside a dashpot it is the part of the damping that is lost, as where oil warms up at
    an even rate or foams. For one that fades with the work that it has taken up see `worn_damper`.
    """

    picture = Symbol.DASHPOT

    damping = Parameter("N*s/m", "damping that is lost in the end", bounds=(1e-4, 1e11), symbol="d")
    time = Parameter("s", "time constant of the loss", bounds=(1e-2, 1e5), symbol="T")
    lost = State("1", "share of the damping that is lost")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """What is left of the damping fades."""
        lost = 1.0 - (1.0 - z.lost) * np.exp(-dt / p.time)
        return Response(p.damping * x.velocity_new * (1.0 - lost), lost=lost)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """A dashpot stores nothing."""
        return 0.0
