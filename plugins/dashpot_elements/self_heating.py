"""A spring and a dashpot that get soft by the heat of the dashpot."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Parallel, Symbol
from dashpot_elements.softening import mean_square

LN2 = 0.6931471805599453


class SelfHeating(Element):
    """A spring and a dashpot that warm up by what the dashpot takes up, and cool: F = 2^(-ratio w) stiffness x + D v,
    D = 2^-w damping, w' = (D v^2/power - w)/time.

    w is the rise of temperature over the one that halves the damping; there the stiffness has fallen to 2^-ratio. At a
    steady dissipated power it is that power over `power`. As a damper that is warm takes up less, it warms up less. The
    heat goes with the dissipated power and not with the square of the velocity, as in `softening`, so that it does not
    run away.

    Every record begins at the temperature of its surroundings, or warm of the runs before: w = log2(1 + log(2) share
    damping before/(power time)), which is what a dashpot has gained that moved by `before`, the integral of its squared
    velocity, and took up less as it got warm. `before: {fixed: 0 m^2/s, over: {setting: moved, kept: {start: 0.5}}}` is
    that of the run before, kept of that of the run before that one, kept^2 of the next, and so on, as of a specimen
    that cools by the same share from each run to the next. What is not in `share` has cooled since.

    The heat of a step is that of its mean squared velocity, with the damping in the middle of the step: second order.
    Not passive by itself, as a spring that cools under load takes up energy as heat.
    """

    picture = Parallel(Symbol.SPRING, Symbol.DASHPOT)
    exact = False
    passive = False

    stiffness = Parameter(
        "N/m", "stiffness of the cold specimen", bounds=(0.0, 1e12), scale="linear", symbol="k", default=0.0
    )
    damping = Parameter("N*s/m", "damping of the cold specimen", bounds=(1e-4, 1e11), symbol="d")
    power = Parameter(
        "W", "dissipated power at which the damping is halved in the end", bounds=(1e-9, 1e12), symbol="P"
    )
    time = Parameter("s", "time constant of warming and cooling", bounds=(1e-2, 1e5), symbol="T")
    ratio = Parameter(
        "1",
        "fall of the stiffness over that of the damping, of their logarithms",
        bounds=(0.0, 10.0),
        scale="linear",
        symbol="r",
        default=1.0,
    )
    before = Parameter(
        "m^2/s",
        "squared velocity, over the time of the run before, and what is kept of earlier ones",
        bounds=(0.0, 1e6),
        scale="linear",
        symbol="E_1",
        default=0.0,
    )
    share = Parameter(
        "1",
        "share of the heat of it that is still there",
        bounds=(0.0, 1.0),
        scale="linear",
        symbol="s",
        default=1.0,
    )
    warmth = State("1", "rise of temperature over that which halves the damping, less what is left of the runs before")
    cooled = State("1", "share of the heat of the runs before that is gone")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """A first guess of the warmth, then the step with the damping in between."""
        gained = -np.expm1(-dt / p.time)
        heat = p.damping * mean_square(x, dt) / p.power
        cooled = z.cooled + gained * (1.0 - z.cooled)
        old = _whole(z.warmth, z.cooled, p)
        guess = old + gained * (heat * np.exp(-LN2 * old) - old)
        middle = 0.5 * (old + np.maximum(guess, 0.0))
        warmth = z.warmth + gained * (heat * np.exp(-LN2 * middle) - z.warmth)
        whole = _whole(warmth, cooled, p)
        spring = p.stiffness * x.new * np.exp(-LN2 * p.ratio * whole)
        force = spring + p.damping * x.velocity_new * np.exp(-LN2 * whole)
        return Response(force, warmth=warmth, cooled=cooled)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the softened spring, without the warmth."""
        return 0.5 * p.stiffness * x.new * x.new * np.exp(-LN2 * p.ratio * _whole(z.warmth, z.cooled, p))


def _whole(warmth: Any, cooled: Any, p: Any) -> Any:
    # the heat of a motion without cooling: (2^w)' = log(2) damping v^2/(power time)
    left = np.log(1.0 + LN2 * p.share * p.damping * p.before / (p.power * p.time)) / LN2
    return warmth + left * (1.0 - cooled)
