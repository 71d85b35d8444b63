"""Amplitude softening of filled rubber around one amplitude."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response
from dashpot.model.picture import Parallel, Series, Symbol
from dashpot_elements.sliders import energy, slide, stretches

COUNT = 10


class Kraus(Element):
    """Ten springs of equal stiffness in parallel, each behind a slider: F = stiffness/10 sum of e_i, |e_i| <= t_i.

    The travels at which the sliders yield are t_i = travel (q_i/(1 - q_i))^(1/exponent) with q_i = (2 i - 1)/20: the
    share that has not yet slipped at a travel x is 1/(1 + (x/travel)^exponent), the curve by which the contacts of a
    filler network break (Payne effect). The smaller the exponent, the wider the range of amplitudes over which the
    storage stiffness falls. Rate independent; minor loops close.
    """

    picture = Parallel(Series(Symbol.SPRING, Symbol.SLIDER), Series(Symbol.SPRING, Symbol.SLIDER))
    source = "Kraus, J. Applied Polymer Science: Applied Polymer Symposium 39 (1984) 75; exponent = 2 m"

    stiffness = Parameter("N/m", "stiffness at very small amplitude", bounds=(1e-3, 1e12), symbol="k")
    travel = Parameter("m", "yield travel of the middle of all sliders", bounds=(1e-8, 100.0), symbol="t_c")
    exponent = Parameter(
        "1", "how suddenly the sliders yield around it", bounds=(0.3, 4.0), scale="linear", symbol="n", default=1.0
    )
    (stretch_1, stretch_2, stretch_3, stretch_4, stretch_5, stretch_6, stretch_7, stretch_8, stretch_9, stretch_10) = (
        stretches(COUNT)
    )

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """Every spring takes the travel up to its yield travel."""
        ratios = [(2 * number + 1) / (2 * (COUNT - number) - 1) for number in range(COUNT)]
        travels = [p.travel * np.exp(np.log(ratio) / p.exponent) for ratio in ratios]
        return slide(x, z, [p.stiffness / COUNT] * COUNT, travels)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of all springs."""
        return energy(z, [p.stiffness / COUNT] * COUNT)
