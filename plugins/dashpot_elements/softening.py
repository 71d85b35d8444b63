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
    squared velocity along the cubic path. Beside a spring it is the part of the stiffness that warmth takes away. Not
    passive by itself, as a spring that cools under load takes up energy as heat.

    Every record begins cold, or with a warmth of kept before/(speed^2 time). With `before: {setting: moved, value: 0
    m^2/s}`, the integral of the squared velocity over the run before, that is a share of what this run gained; `before:
    {fixed: 0 m^2/s, over: {setting: moved, kept: {start: 0.5}}}` adds what is left of earlier runs.
    """

    picture = Symbol.SPRING
    exact = False
    passive = False

    stiffness = Parameter("N/m", "stiffness of the cold specimen", bounds=(1e-3, 1e12), symbol="k")
    speed = Parameter("m/s", "r.m.s. velocity that halves the stiffness in the end", bounds=(1e-8, 1e3), symbol="v_h")
    time = Parameter("s", "time constant of warming and cooling", bounds=(1e-2, 1e5), symbol="T")
    exponent = Parameter("1", "how the stiffness falls with warmth", bounds=(0.3, 10.0), symbol="p", default=1.0)
    before = Parameter(
        "m^2/s",
        "squared velocity, over the time of the run before",
        bounds=(0.0, 1e6),
        scale="linear",
        symbol="E_1",
        default=0.0,
    )
    kept = Parameter(
        "1",
        "share of the warmth that a run leaves to the next",
        bounds=(0.0, 1.0),
        scale="linear",
        symbol="q",
        default=0.0,
    )
    warmth = State("1", "rise of temperature over that which halves the stiffness, of this record")
    cooled = State("1", "share of the warmth of the run before that is gone")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The old warmth fades towards that of the step."""
        gained = -np.expm1(-dt / p.time)
        warmth = z.warmth + gained * (mean_square(x, dt) / (p.speed * p.speed) - z.warmth)
        cooled = z.cooled + gained * (1.0 - z.cooled)
        return Response(p.stiffness * x.new * _left(warmth, cooled, p), warmth=warmth, cooled=cooled)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the softened spring, without the warmth."""
        return 0.5 * p.stiffness * x.new * x.new * _left(z.warmth, z.cooled, p)


def _left(warmth: Any, cooled: Any, p: Any) -> Any:
    inherited = p.kept * p.before / (p.speed * p.speed * p.time)
    whole = warmth + inherited * (1.0 - cooled)
    return np.exp(-p.exponent * np.log(1.0 + np.expm1(np.log(2.0) / p.exponent) * whole))


def mean_square(x: Motion, dt: Any) -> Any:
    """The mean of v^2 over a step, v = v_old (1 - u) + v_new u + 6 bow u (1 - u)."""
    old, new = x.velocity_old, x.velocity_new
    bow = x.travel / dt - 0.5 * (old + new)
    return (old * old + old * new + new * new) / 3.0 + bow * (old + new) + 1.2 * bow * bow
