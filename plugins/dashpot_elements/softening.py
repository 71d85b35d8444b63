"""Stiffness that falls as the specimen warms up."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Symbol


class Softening(Element):
    """A spring that heats itself: F = stiffness x (1 + c warmth)^-exponent, warmth' = ((v/speed)^2 - warmth)/time.

    A warmth of one halves the stiffness, c = 2^(1/exponent) - 1: with an exponent of one F = stiffness x/(1 + warmth),
    with a large one it falls exponentially. At rest it cools again. The warmth gained in a step is that of its mean
    squared velocity along the cubic path. Every record begins cold. Beside a spring it is the part of the stiffness
    that warmth takes away. Not passive by itself, as a spring that cools under load takes up energy as heat.
    """

    picture = Symbol.SPRING
    exact = False
    passive = False

    stiffness = Parameter("N/m", "stiffness of the cold specimen", bounds=(1.0, 1e9), symbol="k")
    speed = Parameter("m/s", "r.m.s. velocity that halves the stiffness in the end", bounds=(1e-5, 100.0), symbol="v_h")
    time = Parameter("s", "time constant of warming and cooling", bounds=(1e-2, 1e5), symbol="T")
    exponent = Parameter("1", "how the stiffness falls with warmth", bounds=(0.3, 10.0), symbol="p", default=1.0)
    warmth = State("1", "rise of temperature over that which halves the stiffness")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The old warmth fades towards that of the step."""
        gained = -np.expm1(-dt / p.time)
        warmth = z.warmth + gained * (mean_square(x, dt) / (p.speed * p.speed) - z.warmth)
        return Response(p.stiffness * x.new * _left(warmth, p), warmth=warmth)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the softened spring, without the warmth."""
        return 0.5 * p.stiffness * x.new * x.new * _left(z.warmth, p)


def _left(warmth: Any, p: Any) -> Any:
    return np.exp(-p.exponent * np.log(1.0 + np.expm1(np.log(2.0) / p.exponent) * warmth))


def mean_square(x: Motion, dt: Any) -> Any:
    """The mean of v^2 over a step, v = v_old (1 - u) + v_new u + 6 bow u (1 - u)."""
    old, new = x.velocity_old, x.velocity_new
    bow = x.travel / dt - 0.5 * (old + new)
    return (old * old + old * new + new * new) / 3.0 + bow * (old + new) + 1.2 * bow * bow
