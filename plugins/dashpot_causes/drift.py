"""A force channel whose zero wanders."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from dashpot.contract.cause import Cause, ChannelFault, Suspect, View
from dashpot.data.correction import Correction
from dashpot.model.network import NetworkSpec


class Drift(Cause):
    """The zero of the force channel moves steadily during single runs."""

    word = "drift"
    kind = "measurement"
    about = "drift of the force channel"
    shows = "the mean force of single runs moves steadily over time, whatever the motion does"
    cure = "let the amplifier warm up and zero it between runs; take the trend out of these runs"
    confused_with = {
        "creep": "a dwell after a step up and one after a step down: creep changes its sign, drift does not",
        "softening": "a reading without load before and after the run",
        "offset": "a reading without load before and after the run",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """None: no network drifts."""
        return ()

    def channel_faults(self, view: View) -> Iterable[ChannelFault]:
        """A zero that moves evenly over a run, wherever it began."""
        yield ChannelFault(
            "steady drift",
            "drift by the end",
            "N",
            lambda view, run: np.array([np.linspace(0.0, 1.0, view.force(run).size), np.ones(view.force(run).size)]),
            lambda strengths: Correction(drift=strengths[0], offset=strengths[1]),
        )
