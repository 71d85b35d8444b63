"""A force channel whose zero is wrong in some runs."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from dashpot.contract.cause import Cause, Suspect, View, one_of_the_runs
from dashpot.model.network import NetworkSpec


class Offset(Cause):
    """The force channel of single runs is shifted. A shift of all runs alike is part of the elastic curve."""

    word = "offset"
    kind = "measurement"
    about = "zero error of the force channel"
    shows = "the mean force of single runs is off by a constant, their dynamic stiffness is right"
    cure = "zero the channel before each run, or write 'offset' under the force channel of these runs"
    confused_with = {
        "gain": "a second preload under the same settings of the amplifier: an offset stays the same",
        "drift": "a reading without load before and after the run",
        "creep": "a dwell at the same preload: creep goes on, an offset does not",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A constant force, one for each run of a minority."""
        if len(view.runs) > 1:
            yield one_of_the_runs("offset of single runs", lambda view, run: np.ones(view.force(run).size),
                                  "offset", "N", view)  # fmt: skip
