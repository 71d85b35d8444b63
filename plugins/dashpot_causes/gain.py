"""A force channel whose gain is wrong in some runs."""

from __future__ import annotations

from collections.abc import Iterable

from dashpot.contract.cause import Cause, ChannelFault, Suspect, View
from dashpot.data.correction import Correction
from dashpot.model.network import NetworkSpec


class Gain(Cause):
    """The force channel of single runs shows too much or too little of everything, of the static force as well."""

    word = "gain"
    kind = "measurement"
    about = "wrong gain of the force channel"
    shows = "the force of single runs is wrong in proportion to itself, while their repeats and neighbours are right"
    cure = "check range and calibration of these runs, or write 'gain' under their force channel"
    faults = ("unit",)
    confused_with = {
        "offset": "a second preload under the same settings of the amplifier: a gain grows with the force",
        "stiffness_curve": "repeat the run: a gain of one run does not come again",
        "softening": "repeat the run after a rest: a gain does not fade over the run",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """None: a gain of all runs is part of every stiffness and damping."""
        return ()

    def channel_faults(self, view: View) -> Iterable[ChannelFault]:
        """A relative error of the force; no gain turns it round."""
        yield ChannelFault(
            "gain",
            "gain error",
            "1",
            lambda view, run: view.force(run)[None],
            lambda strengths: Correction(gain=1.0 / (1.0 + strengths[0])),
            possible=lambda strengths: strengths[0] > -1.0,
        )
