"""A force channel whose gain is wrong in some runs."""

from __future__ import annotations

from collections.abc import Iterable

from dashpot.contract.cause import Cause, Suspect, View, one_of_the_runs
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
        """A relative error of the force, one for each run of a minority."""
        if len(view.runs) > 1:
            yield one_of_the_runs("gain of single runs", lambda view, run: view.force(run), "gain error", "1", view)
