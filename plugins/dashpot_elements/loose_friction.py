"""Dry friction that acts through a joint with play."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Series, Symbol


class LooseFriction(Element):
    """A slider behind a spring behind play: no force while |s| < gap, beyond F = stiffness (|s| - gap) sgn(s),
    |s| <= gap + limit/stiffness.

    After a turn the spring relaxes, then the play is crossed without force, 2 gap long, then the spring is loaded the
    other way until the slider gives way at the limit. Rate independent; minor loops close.
    """

    picture = Series(Symbol.PLAY, Symbol.SPRING, Symbol.SLIDER)
    source = "Brokate and Sprekels, Hysteresis and Phase Transitions (1996), for the stop operator"

    limit = Parameter("N", "sliding force", bounds=(1e-6, 1e9), symbol="F_c")
    stiffness = Parameter("N/m", "stiffness between play and slider", bounds=(1e-3, 1e12), symbol="k")
    gap = Parameter("m", "play to either side", bounds=(1e-8, 100.0), symbol="g")
    stretch = State("m", "stretch of play and spring together")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The stretch takes the travel up to where the slider gives way."""
        reach = p.gap + p.limit / p.stiffness
        stretch = np.minimum(np.maximum(z.stretch + x.travel, -reach), reach)
        return Response(p.stiffness * _beyond(stretch, p.gap), stretch=stretch)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the spring."""
        taut = _beyond(z.stretch, p.gap)
        return 0.5 * p.stiffness * taut * taut


def _beyond(stretch: Any, gap: Any) -> Any:
    return stretch - np.minimum(np.maximum(stretch, -gap), gap)
