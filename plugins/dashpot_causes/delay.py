"""A force channel that lags."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import add_measurement, remove_measurement
from dashpot.text.quantity import pretty

Array = NDArray[np.float64]
LONGEST = 0.05  # s
# of 1/w at the end of the band: delays so short that the force changes in proportion to them, and longer ones
SHARES = (1e-2, *(side * 0.0625 * 2.0**step for step in range(7) for side in (1.0, -1.0)))
LAGS = tuple(float(share) for share in np.geomspace(0.008, 3.2, 20))
BEYOND = 2.0  # times the longest that is tried: where a refit may go in a test so slow that this is more


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
        """A shift of the model's force by a small time or a low-pass, in the place of the other one where there is one.

        To first order in the frequency they are the same: both together, one against the other, would be any law.
        """
        natural = 1.0 / (2.0 * np.pi * view.highest_frequency)
        longest = max(LONGEST, BEYOND * max(SHARES) * natural)
        if "force.delay" not in network.measurement:
            delays = tuple(share * natural for share in SHARES)
            yield Suspect(
                "delay",
                delays,
                partial(_shifted, delays),
                partial(_extend, longest),
                sign=0,
                unknowns=0,
                measured=True,
                quantity="delay",
                unit="s",
            )
        if "force.lag" not in network.measurement:
            lags = tuple(share * natural for share in LAGS)
            yield Suspect(
                "low-pass of first order",
                lags,
                partial(_lagging, lags),
                partial(_low_pass, (lags[0], lags[-1]), longest),
                measured=True,
                quantity="share",
                unit="1",
            )


def _shifted(delays: Sequence[float], view: View, run: str) -> Array:
    """The change of the force over a delay, as the force channel of a network shows it."""
    from dashpot.kernel.observe import Observation

    force, step, one = view.force(run), view.step(run), np.ones(1)

    def late(delay: float) -> Array:
        return Observation(one, 0.0 * one, delay * one).see(force[None], step)[0]

    return np.array([(late(delay) - force) / delay for delay in delays])


def _lagging(lags: Sequence[float], view: View, run: str) -> Array:
    """What a low-pass of first order by each of the lags takes away; before the run the force did not change."""
    from scipy.signal import lfilter

    force, step = view.force(run), view.step(run)
    rise, rows = force - force[0], []
    for lag in lags:
        half = 0.5 * step / lag
        rows.append(lfilter([half / (1.0 + half)] * 2, [1.0, (half - 1.0) / (1.0 + half)], rise) - rise)
    return np.array(rows)


def _low_pass(ends: tuple[float, float], longest: float, text: str, atoms: Sequence[Atom]) -> str:
    share, lag = atoms[0]
    start = float(np.clip(share * lag, *ends))
    text = remove_measurement(text, "delay")
    return add_measurement(text, "lag", f"{{start: {pretty(start, 's', 6)}, bounds: [1 us, {pretty(longest, 's')}]}}")


def _extend(longest: float, text: str, atoms: Sequence[Atom]) -> str:
    lag = float(np.clip(atoms[0][0], -0.9 * longest, 0.9 * longest))
    bounds = f"[{pretty(-longest, 's')}, {pretty(longest, 's')}]"
    text = remove_measurement(text, "lag")
    return add_measurement(text, "delay", f"{{start: {pretty(lag, 's', 6)}, bounds: {bounds}}}")
