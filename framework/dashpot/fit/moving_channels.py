"""Channels on whose mean a number depends, and that move within runs: what the intervals of a fit leave out."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from dashpot.data.channel import unit_of_channel
from dashpot.data.run import Run
from dashpot.model.network import NetworkSpec
from dashpot.text.quantity import pretty

# of how far apart the means of the runs lie
_MUCH = 0.5
# a channel moves between these quantiles: single samples of a noisy sensor do not count
_LOW, _HIGH = 0.05, 0.95


def moving_channels(spec: NetworkSpec, runs: Sequence[Run]) -> list[str]:
    """A sentence for each channel that moves within one of the runs by half as much as between them, or by more.

    A number over a channel has one value in a run, that at the mean of the channel, as if it rested there.
    """
    found = {slot.value.over.word for slot in spec.slots() if slot.value.over and slot.value.over.channel}
    return [sentence for word in sorted(found) if (sentence := _sentence(word, [run.channels[word] for run in runs]))]


def _sentence(channel: str, signals: Sequence[np.ndarray]) -> str:
    inside = max(float(np.subtract(*np.quantile(signal, (_HIGH, _LOW)))) for signal in signals)
    between = float(np.ptp([np.mean(signal) for signal in signals]))
    if inside <= _MUCH * between or inside == 0.0:
        return ""
    moved, apart = (pretty(value, unit_of_channel(channel) or "1", 2) for value in (inside, between))
    return (
        f"numbers over '{channel}' take its mean in each run, but it moves by up to {moved} within a run, while the "
        f"means lie {apart} apart: the intervals do not allow for that; cut such runs into shorter ones"
    )
