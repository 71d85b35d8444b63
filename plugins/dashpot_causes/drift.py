"""A force channel whose zero wanders."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, ChannelFault, Suspect, View
from dashpot.data.correction import Correction
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import add_measurement
from dashpot.text.quantity import pretty
from dashpot_causes.session import ORDER, order_of

Array = NDArray[np.float64]

DIGITS = 10


class Drift(Cause):
    """The zero of the force channel moves steadily: from run to run over the session, or during single runs."""

    word = "drift"
    kind = "measurement"
    evidence_of = "order"
    about = "drift of the force channel"
    shows = "the mean force moves steadily from run to run, or during single runs, whatever the motion does"
    cure = "let the amplifier warm up and zero it between runs; take the trend out of these runs"
    confused_with = {
        "creep": "a dwell after a step up and one after a step down: creep changes its sign, drift does not",
        "softening": "a reading without load before and after the run",
        "offset": "a reading without load before and after the run",
        "setting_dependence": "the settings in another order: drift follows the clock",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A zero that moves by the same from each run of the dataset to the next, right in the first one."""
        places = order_of(view)
        if not places or "force.offset" in network.measurement:
            return
        first = min(view.settings(run)[ORDER] for run in places)

        def columns(view: View, run: str) -> Array:
            return np.full((1, view.force(run).size), places[run])

        def extend(text: str, atoms: Sequence[Atom]) -> str:
            slope = pretty(atoms[0][0], "N", DIGITS)
            over = f"{{setting: {ORDER}, at: {first:g}, slope: {{start: {slope}}}}}"
            return add_measurement(text, "offset", f"{{fixed: 0 N, over: {over}}}")

        yield Suspect(
            "from run to run",
            (0.0,),
            columns,
            extend,
            sign=0,
            unknowns=0,
            measured=True,
            quantity="drift from a run to the next",
            unit="N",
        )

    def channel_faults(self, view: View) -> Iterable[ChannelFault]:
        """A zero that moves evenly over a run, wherever it began: where it began is an offset, and no evidence."""
        yield ChannelFault(
            "steady drift",
            "drift by the end",
            "N",
            lambda view, run: np.array([np.linspace(0.0, 1.0, view.force(run).size), np.ones(view.force(run).size)]),
            lambda strengths: Correction(drift=strengths[0], offset=strengths[1]),
            free=1,
            scatters=False,
        )
