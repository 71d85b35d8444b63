"""Amplitude softening of filled rubber."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response
from dashpot.model.picture import Parallel, Series, Symbol
from dashpot_elements.sliders import energy, slide, stretches

COUNT = 8


class Iwan(Element):
    """Eight springs in parallel, each behind a slider: F = sum of k_i e_i, |e_i| <= t_i.

    The travels t_i at which the sliders yield are spread evenly over the logarithm from the shortest to the longest;
    the stiffnesses k_i go with t_i^-slope and are together ``stiffness``. With a slope of 0 the storage stiffness falls
    in proportion to the logarithm of the amplitude (Payne effect), while the loop stays near to an ellipse. Rate
    independent; minor loops close.
    """

    picture = Parallel(Series(Symbol.SPRING, Symbol.SLIDER), Series(Symbol.SPRING, Symbol.SLIDER))
    source = "Iwan, J. Applied Mechanics 33 (1966) 893"

    stiffness = Parameter("N/m", "stiffness at very small amplitude", bounds=(1e-3, 1e12), symbol="k")
    shortest = Parameter("m", "yield travel of the first slider", bounds=(1e-8, 100.0), symbol="t_1")
    longest = Parameter("m", "yield travel of the last slider", bounds=(1e-8, 100.0), symbol="t_8")
    slope = Parameter(
        "1", "how the stiffness falls with the travel", bounds=(-2.0, 2.0), scale="linear", symbol="s", default=0.0
    )
    stretch_1, stretch_2, stretch_3, stretch_4, stretch_5, stretch_6, stretch_7, stretch_8 = stretches(COUNT)

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """Every spring takes the travel up to its yield travel."""
        distance = np.log(p.longest / p.shortest) / (COUNT - 1)
        travels = [p.shortest * np.exp(number * distance) for number in range(COUNT)]
        return slide(x, z, _stiffnesses(p), travels)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of all springs."""
        return energy(z, _stiffnesses(p))


def _stiffnesses(p: Any) -> list[Any]:
    distance = np.log(p.longest / p.shortest) / (COUNT - 1)
    weights = [np.exp(-p.slope * number * distance) for number in range(COUNT)]
    return [p.stiffness * weight / sum(weights) for weight in weights]
