"""Numbers over a setting or a channel: the law, for arrays and for graphs alike, and what follows a channel in a run.

A number over a channel follows it sample by sample. What happens at the end of a step, such as the force of a law
without memory, has the channel at that sample. The memory of a law that depends on rates or on time goes through the
step with the channel halfway: a differential equation whose coefficients move is solved to second order by that. Laws
without rates take the channel at the end of the step, at turning points within it, too. Between two samples a channel
goes along a straight line.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from dashpot.data.excitation import Excitation, mean_of
from dashpot.model.network import Branch, NetworkSpec, Over, Slot, branch_slots

Array = NDArray[np.float64]
# at which point of a step a channel is seen
Moment = Literal["channel", "halfway"]
Seen = Mapping[str, Array]

STEEPEST = 50.0  # exponent of a rate over the settings, so that a search may try what it likes
MARKS = ("channel:", "halfway:")


def channel_symbol(word: str, moment: Moment = "channel") -> str:
    """The name of what a step sees of a channel."""
    return f"{moment}:{word}"


def channel_symbols(names: Iterable[str]) -> set[str]:
    """Those of the names of symbols that stand for a channel."""
    return {name for name in names if name.startswith(MARKS)}


def moved(over: Over, base: Any, numbers: Sequence[Any], seen: Any, sensible: tuple[float, float]) -> Any:
    """The number that is ``base`` at the place of ``over``, where the setting or the channel is ``seen``, in SI.

    All of them may be arrays, which are broadcast, or nodes of a graph. Where ``seen`` is NaN, it is ``base``.
    """
    found = _moved(over, base, numbers, seen)
    low, high = sensible
    found = np.maximum(found, low) if low > -math.inf else found
    return np.minimum(found, high) if high < math.inf else found


def _moved(over: Over, base: Any, numbers: Sequence[Any], seen: Any) -> Any:
    if over.way == "factor" and isinstance(seen, float):
        return base * (1.0 + sum((numbers[place] - 1.0) * share for place, share in _near(over.at, seen)))
    known = np.equal(seen, seen)
    if over.way == "factor":
        hats = [np.where(known, hat, 0.0) for hat in _hats(over.at, seen)]
        return base * (1.0 + sum((factor - 1.0) * hat for factor, hat in zip(numbers, hats, strict=True)))
    if over.way == "arrhenius":
        return base * _exponential(numbers[0] * np.where(known, 1.0 / seen - 1.0 / over.at[0], 0.0))
    away = np.where(known, seen - over.at[0], 0.0)
    if over.way == "slope":
        return base + numbers[0] * away
    if over.way == "rate":
        return base * _exponential(numbers[0] * away)
    first, second = numbers
    # at C2 below the place nothing flows any more
    return base * _exponential(-first * away / np.maximum(second + away, 1e-3 * second) * math.log(10.0))


def _hats(at: Sequence[float], seen: Any) -> list[Any]:
    """The share of each place: 1 there, falling along straight lines to 0 at its neighbours; the outer ones go on."""
    rises = [np.clip((seen - low) / (high - low), 0.0, 1.0) for low, high in zip(at, at[1:], strict=False)]
    return [before - after for before, after in zip([1.0, *rises], [*rises, 0.0], strict=True)]


@lru_cache(maxsize=1024)
def _near(at: Sequence[float], seen: float) -> list[tuple[int, float]]:
    """The places with a share at a number, and these; none where it is NaN."""
    shares = [float(hat) for hat in _hats(at, seen)] if seen == seen else []
    return [(place, share) for place, share in enumerate(shares) if share]


def _exponential(exponent: Any) -> Any:
    return np.exp(np.clip(exponent, -STEEPEST, STEEPEST))


def keys_of(over: Over) -> tuple[str, ...]:
    """Under which names the settings of an excitation may hold what a number depends on, the first one before others.

    Where a channel was not measured, a setting of its name tells what it was all the time.
    """
    return (mean_of(over.word), over.word) if over.channel else (over.word,)


def told_to(over: Over, settings: Mapping[str, float]) -> float | None:
    """What settings tell a number of the one that it depends on; None: nothing."""
    return next((settings[key] for key in keys_of(over) if key in settings), None)


def follows(slot: Slot, spec: NetworkSpec) -> bool:
    """Whether a number of a network follows a channel along a run."""
    return slot.value.over is not None and slot.value.over.channel and slot.path not in held_at_mean(spec)


def held_at_mean(spec: NetworkSpec) -> frozenset[str]:
    """The paths of all numbers that take the mean of a channel over a run: masses, and offsets of deflections."""
    masses = (f"{joint.name}.{key}" for joint in spec.joints.values() for key in joint.masses)
    return frozenset([*masses, *(f"{name}.offset" for name, ends in spec.ends.items() if ends.offset)])


def dependences(branch: Branch) -> tuple[Hashable, ...]:
    """What the numbers of a branch that follow a channel do, as far as its graph depends on it."""
    return tuple(
        (slot.path, over.word, over.way, over.at, len(over.numbers), slot.value.sensible)
        for slot in branch_slots(branch)
        if (over := slot.value.over) and over.channel
    )


def channels_of(spec: NetworkSpec, excitation: Excitation) -> dict[str, Array]:
    """What a run tells of each channel that numbers follow: its samples (n,).

    Where there are none, as on a rig, all are what the settings tell, and NaN where nothing is known of it. Raises
    ValueError for another number of samples than that of the motion.
    """
    overs = [slot.value.over for slot in spec.slots() if slot.value.over and slot.value.over.channel]
    return {over.word: _samples(over, excitation) for over in overs}


def _samples(over: Over, excitation: Excitation) -> Array:
    count = next((drive.samples for drive in excitation.motions.values()), excitation.samples)
    if over.word not in excitation.channels:
        told = told_to(over, excitation.settings)
        return np.full(count, math.nan if told is None else told)
    signal = excitation.channels[over.word]
    if signal.shape != (count,):
        raise ValueError(f"the channel '{over.word}': expected {count} samples as the motion has, got {signal.shape}")
    return signal


def at_samples(channels: Seen) -> dict[str, Array]:
    """The symbols of the channels in the step that leads to each sample."""
    found = {}
    for word, signal in channels.items():
        found[channel_symbol(word)] = signal
        found[channel_symbol(word, "halfway")] = np.append(signal[:1], 0.5 * (signal[1:] + signal[:-1]))
    return found


def at_parts(channels: Seen, parts: int, first: int, end: int) -> dict[str, Array]:
    """The same in equal ``parts`` of every step from the sample ``first`` to the last one before ``end``."""
    found = {}
    at = np.arange(1, 1 + (end - 1 - first) * parts) / parts
    for word, signal in channels.items():
        own = signal[first:end]
        for moment, back in (("channel", 0.0), ("halfway", 0.5 / parts)):
            found[f"{moment}:{word}"] = np.interp(at - back, np.arange(own.size), own)
    return found


def at_rest(channels: Seen) -> dict[str, float]:
    """The same before the first step."""
    return {f"{moment}{word}": float(signal[0]) for word, signal in channels.items() for moment in MARKS}


def without_channels(spec: NetworkSpec) -> NetworkSpec:
    """The same network with numbers over channels as numbers over settings, their means: they rest along a run."""
    changed = {
        slot.path: replace(slot.value, over=replace(over, word=mean_of(over.word), channel=False))
        for slot in spec.slots()
        if (over := slot.value.over) and over.channel
    }
    return spec.with_values(changed) if changed else spec
