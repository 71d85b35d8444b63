"""Slow loss of the force of a preload."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Series, Symbol


class PreloadCreep(Element):
    """The force with which a record begins falls with the logarithm of time: F = -stiffness x_0 lg(1 + t/shortest).

    x_0 is the deflection at the begin, and what moves on top of it does not creep: ``creep`` is the law in which every
    change of the deflection does. Beside a spring it is what that loses; not passive by itself.
    """

    picture = Series(Symbol.SPRING, Symbol.DASHPOT)
    passive = False

    stiffness = Parameter("N/m", "force lost per decade of time and deflection", bounds=(1e-3, 1e12), symbol="B")
    shortest = Parameter("s", "when the fall begins", bounds=(1e-3, 1e5), symbol="T_1", default=1.0)
    since = State("s", "time since the record began")
    preload = State("m", "deflection with which it began")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The clock goes on; the first step sees the preload."""
        since, preload = z.since + dt, np.where(z.since > 0.0, z.preload, x.old)
        force = -p.stiffness * preload * np.log(1.0 + since / p.shortest) / np.log(10.0)
        return Response(force, since=since, preload=preload)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """None that could be told from what it loses."""
        return 0.0 * x.new
