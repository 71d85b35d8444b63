"""Channels on whose mean a mass or an offset depends, and that move within runs: what a fit leaves out."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from dashpot.data.channel import unit_of_channel
from dashpot.data.run import Run
from dashpot.kernel.following import held_at_mean
from dashpot.model.network import NetworkSpec
from dashpot.text.quantity import pretty

# of how far apart the means of the runs lie
_MUCH = 0.5
# a channel moves between these quantiles: single samples of a noisy sensor do not count
_LOW, _HIGH = 0.05, 0.95


def moving_channels(spec: NetworkSpec, runs: Sequence[Run]) -> list[str]:
    """A sentence for each channel that moves within one of the runs by half as much as between them, or by more.

    A mass, or the offset of a deflection, has one value in a run, that at the mean of the channel; all other numbers
    follow the channel.
    """
    held = held_at_mean(spec)
    overs = [slot.value.over for slot in spec.slots() if slot.path in held]
    words = sorted({over.word for over in overs if over and over.channel})
    signals = {word: [run.channels[word] for run in runs if word in run.channels] for word in words}
    return [sentence for word in words if signals[word] and (sentence := _sentence(word, signals[word]))]


def _sentence(channel: str, signals: Sequence[np.ndarray]) -> str:
    inside = max(float(np.subtract(*np.quantile(signal, (_HIGH, _LOW)))) for signal in signals)
    between = float(np.ptp([np.mean(signal) for signal in signals]))
    if inside <= _MUCH * between or inside == 0.0:
        return ""
    moved, apart = (pretty(value, unit_of_channel(channel) or "1", 2) for value in (inside, between))
    return (
        f"masses and offsets over '{channel}' take its mean in each run, but it moves by up to {moved} within a run, "
        f"while the means lie {apart} apart: the intervals do not allow for that; cut such runs into shorter ones"
    )
