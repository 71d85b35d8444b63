"""A force channel whose zero is wrong in some runs."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from dashpot.contract.cause import Cause, ChannelFault, Suspect, View
from dashpot.data.correction import Correction
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
        """None: a shift of all runs is part of the elastic curve."""
        return ()

    def channel_faults(self, view: View) -> Iterable[ChannelFault]:
        """A constant force."""
        yield ChannelFault(
            "offset",
            "offset",
            "N",
            lambda view, run: np.ones((1, view.force(run).size)),
            lambda strengths: Correction(offset=strengths[0]),
        )
