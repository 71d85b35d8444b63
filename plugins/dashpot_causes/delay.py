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
LAGS = tuple(float(lag) for lag in np.geomspace(5e-5, 2e-2, 20))  # s


class Delay(Cause):
    """The force channel shows the force of an earlier time (a later one if negative), or lags behind a filter."""

    word = "delay"
    kind = "measurement"
    about = "delay between the channels"
    shows = "loss stiffness changes with frequency in proportion to the storage stiffness, so it grows with preload"
    evidence_of = "phase"
    confused_with = {
        "viscous_damping": "a known steel spring on the same channels: a delay stays, damping does not",
        "relaxation": "a known steel spring on the same channels: a delay stays, relaxation does not",
        "moving_mass": "a run without specimen: a mass shows, a delay does not",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """A shift of the model's force by a small time or a low-pass, unless the network has one of them already.

        To first order in the frequency they are the same: both together, one against the other, would be any law.
        """
        if not {"force.delay", "force.lag"} & set(network.measurement):
            yield Suspect(
                "delay", (0.0,), _slope, _extend, sign=0, unknowns=0, measured=True, quantity="delay", unit="s"
            )
            yield Suspect(
                "low-pass of first order", LAGS, _lagging, _low_pass, measured=True, quantity="share", unit="1"
            )


def _slope(view: View, run: str) -> Array:
    return -np.gradient(view.force(run), view.step(run), edge_order=2)[None]


def _lagging(view: View, run: str) -> Array:
    """What a low-pass of first order by each of the lags takes away; before the run the force did not change."""
    from scipy.signal import lfilter

    force, step = view.force(run), view.step(run)
    rise, rows = force - force[0], []
    for lag in LAGS:
        half = 0.5 * step / lag
        rows.append(lfilter([half / (1.0 + half)] * 2, [1.0, (half - 1.0) / (1.0 + half)], rise) - rise)
    return np.array(rows)


def _low_pass(text: str, atoms: Sequence[Atom]) -> str:
    share, lag = atoms[0]
    start = float(np.clip(share * lag, LAGS[0], LAGS[-1]))
    return add_measurement(text, "lag", f"{{start: {pretty(start, 's', 6)}, bounds: [1 us, {pretty(LONGEST, 's')}]}}")


def _extend(text: str, atoms: Sequence[Atom]) -> str:
    lag = float(np.clip(atoms[0][0], -0.9 * LONGEST, 0.9 * LONGEST))
    bounds = f"[{pretty(-LONGEST, 's')}, {pretty(LONGEST, 's')}]"
    return add_measurement(text, "delay", f"{{start: {pretty(lag, 's', 6)}, bounds: {bounds}}}")
