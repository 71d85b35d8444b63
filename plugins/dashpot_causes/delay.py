"""A force channel that lags."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import add_measurement
from dashpot.text.quantity import pretty

Array = NDArray[np.float64]
LONGEST = 0.05


class Delay(Cause):
    """The force channel shows the force of an earlier time (a later one if negative)."""

    word = "delay"
    kind = "measurement"
    about = "delay between the channels"
    shows = "loss stiffness changes with frequency in proportion to the storage stiffness, so it grows with preload"
    confused_with = {
        "viscous_damping": "a known steel spring on the same channels: a delay stays, damping does not",
        "relaxation": "a known steel spring on the same channels: a delay stays, relaxation does not",
        "moving_mass": "a run without specimen: a mass shows, a delay does not",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A shift of the model's force by a small time, unless the network has one already."""
        if "force.delay" not in network.measurement:
            yield Suspect("delay", (0.0,), _slope, _extend, sign=0, unknowns=0, quantity="delay", unit="s")


def _slope(view: View, run: str) -> Array:
    return -np.gradient(view.force(run), view.step(run), edge_order=2)[None]


def _extend(text: str, atoms: Sequence[Atom]) -> str:
    lag = float(np.clip(atoms[0][0], -0.9 * LONGEST, 0.9 * LONGEST))
    bounds = f"[{pretty(-LONGEST, 's')}, {pretty(LONGEST, 's')}]"
    return add_measurement(text, "delay", f"{{start: {pretty(lag, 's', 6)}, bounds: {bounds}}}")
