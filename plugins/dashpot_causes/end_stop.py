"""A stop at the end of the free travel."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from dashpot.contract.cause import Cause, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec

PLACES = 9
SHARE = 0.5  # of the reach, from either end
FAR = 1e3  # m


class EndStop(Cause):
    """A buffer that is touched beyond a deflection near one end of the reach."""

    word = "end_stop"
    kind = "specimen"
    about = "an end stop"
    shows = "a one-sided tip of the loop beyond one deflection; higher harmonics of the even kind, earlier with preload"
    confused_with = {
        "stiffness_curve": "a finer quasi-static loop: a stop has one knee, a curve bends everywhere",
        "clipping": "another frequency: clipping comes at one force, a stop at one deflection",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A buffer beyond a deflection near either end; in compression a positive one, in rebound a negative one."""
        low, high = view.reach
        places = np.linspace(0.0, SHARE * (high - low), PLACES + 1)[1:]
        upper = tuple(place for place in high - places if place > 0.0)
        lower = tuple(place for place in low + places if place < 0.0)
        units = {"stiffness": "N/m", "compression": "m", "rebound": "m"}
        if upper:
            yield added_branch("end_stop", "end_stop", upper, _compression, units)
        if lower:
            yield added_branch("end_stop", "end_stop", lower, _rebound, units, fixed=("compression",))


def _compression(stiffness: float, place: float) -> dict[str, float]:
    return {"stiffness": stiffness, "compression": place}


def _rebound(stiffness: float, place: float) -> dict[str, float]:
    return {"stiffness": stiffness, "rebound": place, "compression": FAR}
