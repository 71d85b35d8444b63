"""A force channel whose zero wanders."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Cause, Suspect, View, one_of_the_runs
from dashpot.model.network import NetworkSpec

Array = NDArray[np.float64]
FASTER = 5.0  # how many times a zero settles within a run


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
        """A force that rises evenly over a run, or settles within it, one for each run of a minority."""
        for form, shape in (("steady drift", _steady), ("settling drift", _settling)):
            yield one_of_the_runs(f"{form} of single runs", shape, "drift by the end", "N", view, share=0.5)


def _steady(view: View, run: str) -> Array:
    return np.linspace(0.0, 1.0, view.force(run).size)


def _settling(view: View, run: str) -> Array:
    rise = -np.expm1(-FASTER * _steady(view, run))
    return rise / rise[-1]
