"""Stiffness that comes back where the specimen is pressed as far as ever before."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Symbol


class Mullins(Element):
    """A spring that is soft below its largest deflection so far: F = stiffness x (1 - tanh((reach^2 - x^2)/d^2)).

    The Mullins effect as a pseudo-elastic law, reach = max |x| and d^2 = depth^2 + widening reach^2: on virgin ground
    nothing is lost, on the way there the more, the further the largest energy so far is above the present one. Every
    record begins with a fresh specimen, or with one that was deflected as far as `before` says: `{setting: reached,
    value: 0 mm}` is the largest deflection in all runs before.
    """

    picture = Symbol.SPRING
    source = "Dorfmann and Ogden, Int. J. Solids and Structures 41 (2004) 1855, with the energy of a spring"

    stiffness = Parameter("N/m", "stiffness of the fresh specimen", bounds=(1e-3, 1e12), symbol="k")
    depth = Parameter("m", "root of the difference of squares that leaves 24 %", bounds=(1e-8, 100.0), symbol="x_m")
    widening = Parameter(
        "1",
        "share of the largest energy so far that is added",
        bounds=(0.0, 10.0),
        scale="linear",
        symbol="beta",
        default=0.0,
    )
    before = Parameter(
        "m", "largest deflection before the record", bounds=(0.0, 100.0), scale="linear", symbol="x_0", default=0.0
    )
    reach = State("m", "largest deflection to either side so far")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """The reach grows to the end of the step."""
        reach = np.maximum(z.reach, np.abs(x.new))
        return Response(p.stiffness * x.new * _left(x.new, np.maximum(reach, p.before), p), reach=reach)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy that the way back to zero gives."""
        reach = np.maximum(z.reach, p.before)
        way = np.log1p(_grip(x.new, reach, p)) - np.log1p(_grip(0.0, reach, p))
        return 0.5 * p.stiffness * _width(reach, p) * way


def _left(x: Any, reach: Any, p: Any) -> Any:
    grip = _grip(x, reach, p)
    return 2.0 * grip / (1.0 + grip)


def _grip(x: Any, reach: Any, p: Any) -> Any:
    return np.exp(2.0 * (x * x - reach * reach) / _width(reach, p))


def _width(reach: Any, p: Any) -> Any:
    return p.depth * p.depth + p.widening * reach * reach
