"""The force of a column of gas."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import product

import numpy as np

from dashpot.contract.cause import Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec

UNITS = {"force": "N", "length": "m", "exponent": "1", "time": "s"}
COLUMNS = (1.15, 1.3, 1.7, 2.5, 5.0)  # over the deflection up to which gas is squeezed
TIMES = (0.1, 1.0, 10.0, 100.0)  # of 1/w at the end of the band
HEAT = 0.01  # s: 1.5 mm of gas at ambient pressure; of more gas, or denser, the exchange of heat takes longer
POLYTROPE = (1.0, 1.7)  # from constant temperature to a gas of single atoms that keeps its heat
LEAST = 1.02  # of the largest deflection: the column may not be squeezed to nothing


class GasSpring(Cause):
    """A preload inversely proportional to the remaining gas column, with a lag as the gas exchanges heat."""

    word = "gas_spring"
    kind = "specimen"
    about = "a gas spring"
    shows = "static force and stiffness that grow together with compression; quasi-static motion is softer by up to 1.4"
    confused_with = {
        "stiffness_curve": "a second pressure: preload and stiffness of gas grow in proportion to it",
        "relaxation": "a second preload: rubber relaxes by the same share, gas by more where its force is larger",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A polytropic column over lengths; one that exchanges heat over lengths and times."""
        squeezed = max(view.reach[1], 0.1 * view.stroke)
        lengths = [share * squeezed for share in COLUMNS]
        yield added_branch(
            "gas_spring",
            "gas_spring",
            tuple(lengths),
            lambda force, length: {"force": force, "length": length, "exponent": 1.3},
            UNITS,
            unknowns=2,
            bounds={"exponent": POLYTROPE, "length": (LEAST * squeezed, 100.0 * squeezed)},
            form="a column of gas",
        )
        turn = 1.0 / (2.0 * np.pi * view.highest_frequency)
        times = sorted({max(share * turn, 2.0 * HEAT) for share in TIMES})
        places = list(product(lengths, times))
        yield added_branch(
            "warm_gas_spring",
            "gas_spring",
            tuple(float(number) for number in range(len(places))),
            lambda force, number: {"force": force, "length": places[int(number)][0], "time": places[int(number)][1]},
            UNITS,
            unknowns=2,
            bounds={"length": (LEAST * squeezed, 100.0 * squeezed)},
            admits=lambda numbers: numbers["time"] >= HEAT,
            form="a column of gas that exchanges heat",
        )
