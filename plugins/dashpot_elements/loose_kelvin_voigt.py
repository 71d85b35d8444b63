"""A rubber part in a joint with play."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Series, Symbol


class LooseKelvinVoigt(Element):
    """A spring and a dashpot side by side behind play: F = stiffness s + damping s' where they touch,
    s = |x - place| - gap.

    Where the drive goes back faster than the part follows, they part without force, and s fades by the time
    damping/stiffness until they touch again. Exact but for a step within which they part. Not passive where the play
    does not hold the zero of the deflection, as it is strained from the beginning.
    """

    picture = Series(Symbol.PLAY, Symbol.SPRING, Symbol.DASHPOT)
    passive = False
    exact = False

    stiffness = Parameter("N/m", "stiffness behind the play", bounds=(1e-3, 1e12), symbol="k")
    damping = Parameter("N*s/m", "damping beside it", bounds=(1e-4, 1e11), symbol="d")
    gap = Parameter("m", "play to either side", bounds=(1e-8, 100.0), symbol="g")
    place = Parameter("m", "middle of the play", bounds=(-100.0, 100.0), scale="linear", symbol="x_0", default=0.0)
    stretch = State("m", "deflection behind the play")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The part fades, and the drive takes it along where it touches."""
        faded = z.stretch * np.exp(-dt * p.stiffness / p.damping)
        away = x.new - p.place
        stretch = np.minimum(np.maximum(faded, away - p.gap), away + p.gap)
        force = p.stiffness * stretch + p.damping * x.velocity_new
        pressed = np.where(stretch > faded, np.maximum(force, 0.0), np.minimum(force, 0.0))
        held = np.where(stretch == faded, 0.0, pressed)
        return Response(held, stretch=stretch)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the spring."""
        return 0.5 * p.stiffness * z.stretch * z.stretch
