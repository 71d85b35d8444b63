"""A stop at the end of the free travel."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import partial

import numpy as np

from dashpot.contract.cause import Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec

PLACES = 9
NEAREST, SHARE = 0.02, 0.5  # of the reach, from either end
DEPTH = 0.1  # of the reach: where the stiffness of a progressive buffer is told
EXPONENT = 2.0
EXPONENTS = (1.0, 4.0)
FAR = 1e3  # m
Numbers = Callable[[float, float], Mapping[str, float]]


class EndStop(Cause):
    """A buffer that is touched, or a strap that is taut, beyond a deflection near one end of the reach."""

    word = "end_stop"
    kind = "specimen"
    about = "an end stop"
    shows = "a one-sided tip of the loop beyond one deflection; higher harmonics of the even kind, earlier with preload"
    confused_with = {
        "stiffness_curve": "a finer quasi-static loop: a stop has one knee, a curve bends everywhere",
        "clipping": "another frequency: clipping comes at one force, a stop at one deflection",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A linear and a progressive buffer beyond a deflection near either end, or a strap that gets taut there."""
        low, high = view.reach
        places = (high - low) * np.geomspace(NEAREST, SHARE, PLACES)
        upper, lower = tuple(high - places), tuple(low + places)
        units = {"stiffness": "N/m", "compression": "m", "rebound": "m", "exponent": "1", "reference": "m"}
        reference = float(f"{DEPTH * (high - low):.2g}")
        for side, numbers, fixed in ((upper, _compression, ()), (lower, _rebound, ("compression",))):
            yield added_branch("end_stop", "end_stop", side, numbers, units, fixed=fixed)
            progressive = partial(_progressive, numbers, reference)
            yield added_branch(
                "end_stop",
                "end_stop",
                side,
                progressive,
                units,
                fixed=(*fixed, "reference"),
                unknowns=2,
                bounds={"exponent": EXPONENTS},
                form="a progressive buffer",
            )


def _compression(stiffness: float, place: float) -> dict[str, float]:
    return {"stiffness": stiffness, "compression": place}


def _rebound(stiffness: float, place: float) -> dict[str, float]:
    return {"stiffness": stiffness, "rebound": place, "compression": FAR}


def _progressive(numbers: Numbers, reference: float, stiffness: float, place: float) -> dict[str, float]:
    return {**numbers(stiffness, place), "exponent": EXPONENT, "reference": reference}
