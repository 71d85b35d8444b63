"""A run whose force has the wrong sign or the wrong unit, told by the other runs."""

from __future__ import annotations

import math

from dashpot.assess.triage.fault import Fault
from dashpot.assess.triage.likeness import Likeness
from dashpot.text.quantity import pretty

FACTORS = {
    1000.0: "kN written as N", 0.001: "N written as kN", 9.80665: "N written as kgf", 1.0 / 9.80665: "kgf written as N",
    10.0: "a decimal point", 0.1: "a decimal point", 4.4482216: "N written as lbf", 1.0 / 4.4482216: "lbf written as N",
}  # fmt: skip
NEAR = 0.06
LIKE = 0.9
LONELY = 3.0  # how many times farther from one than any other gain


def wrong_scale(odd: Likeness) -> Fault | None:
    """Wrong polarity or a wrong unit of the odd run; None where its force is like that of the others, or unlike."""
    if odd.likeness < LIKE or odd.gain == 0.0 or not all(gain > 0.0 for gain in odd.others):
        return None
    spread = max(abs(math.log(gain)) for gain in odd.others)
    size = abs(odd.gain)
    if odd.gain < 0.0 and abs(math.log(size)) < max(math.log(2.0), spread):
        return Fault(odd.run, "polarity",
                     f"its force is {odd.gain:.3g} times what all others foretell: the channel has the wrong sign",
                     "Write 'sign: -1' under its force channel, or swap the wires", -1.0)  # fmt: skip
    factor = min(FACTORS, key=lambda known: abs(math.log(size / known)))
    near = abs(math.log(size / factor)) < NEAR
    if odd.gain > 0.0 and near and abs(math.log(size)) > LONELY * spread:
        return Fault(odd.run, "unit",
                     f"its force is {pretty(odd.gain, '1', 4)} times what all others foretell, like {FACTORS[factor]}",
                     "Correct the 'unit' of its force channel", 1.0 / factor)  # fmt: skip
    return None
