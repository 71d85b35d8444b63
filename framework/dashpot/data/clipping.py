"""A signal cut off at the end of its range, told from signals that are flat for good reasons."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from dashpot.data.checks import Where
from dashpot.data.trouble import Trouble
from dashpot.text.quantity import pretty

SHORTEST = 4
ENOUGH_FLATS = 3
ENOUGH_SAMPLES = 12

# Around a smooth extreme a signal in steps of q is flat over L samples and L/2 samples further at most 4 q below.
_SHARP = 8.0

# a motion of these kinds never rests at its ends
_MOVING = ("sweep", "harmonic", "random")

_UNITS = {"force": "N", "displacement": "m"}


def clipped_channels(channels: Mapping[str, np.ndarray], kind: str, where: Where) -> list[Trouble]:
    """The forces, and in moving runs the displacements, that stay at their very maximum or minimum.

    Flat for good reasons are: steps of the digits near a slow extreme, a lost contact (exactly zero), a motion that
    rests, and a friction that slides right up to the reversal.
    """
    troubles: list[Trouble] = []
    for name, values in channels.items():
        quantity = name.partition("@")[0]
        if quantity == "force" or (quantity == "displacement" and kind in _MOVING):
            motion = channels.get("displacement") if name == "force" else None
            for side, word in ((1.0, "maximum"), (-1.0, "minimum")):
                flats = _clipped(side * values, None if motion is None else side * motion)
                troubles += [_tell(name, word, values, flats, where)] if flats else []
    return troubles


def _tell(name: str, word: str, values: np.ndarray, flats: list[tuple[int, int]], where: Where) -> Trouble:
    lengths = [end - start for start, end in flats]
    level = pretty(float(values[flats[0][0]]), _UNITS[name.partition("@")[0]])
    message = (
        f"the {name} stays at exactly {level}, its {word}, for up to {max(lengths)} samples in a row "
        f"({len(flats)} times, first in {where(flats[0][0])}): it is clipped"
    )
    hint = "measure with a larger range, cut it off with 'rows', or write 'accept: [clipping]' if it is sound"
    return Trouble(message, hint, fault="clipping")


def _clipped(values: np.ndarray, motion: np.ndarray | None) -> list[tuple[int, int]]:
    """The flats [start, end) at the maximum that have no good reason."""
    top = values.max()
    if top == 0 or values.min() == top:
        return []
    step = _usual_step(values)
    flats = [flat for flat in _flats(values == top) if _is_sharp(values, *flat, step)]
    if motion is not None:
        rest = _usual_step(motion)
        flats = [flat for flat in flats if np.ptp(motion[slice(*flat)]) > 2 * rest]
    enough = len(flats) >= ENOUGH_FLATS or sum(end - start for start, end in flats) >= ENOUGH_SAMPLES
    return flats if enough and not _slides(motion, flats) else []


def _flats(at_top: np.ndarray) -> list[tuple[int, int]]:
    edges = np.flatnonzero(np.diff(np.concatenate([[0], at_top.astype(np.int8), [0]])))
    return [(int(start), int(end)) for start, end in edges.reshape(-1, 2) if end - start >= SHORTEST]


def _usual_step(values: np.ndarray) -> float:
    """What a signal moves by from sample to sample where it is slow: its digits, or its noise."""
    steps = np.abs(np.diff(values))
    steps = steps[steps > 1e-9 * np.ptp(values)]
    return float(np.percentile(steps, 10)) if steps.size else 0.0


def _is_sharp(values: np.ndarray, start: int, end: int, step: float) -> bool:
    """Whether a signal comes and leaves fast. A flat at the very beginning or end is the rest around the test."""
    if start == 0 or end == values.size:
        return False
    half = (end - start) // 2
    outside = values[[max(0, start - half), min(values.size, end + half) - 1]]
    return bool(values[start] - outside.max() > _SHARP * step)


def _slides(motion: np.ndarray | None, flats: list[tuple[int, int]]) -> bool:
    """Whether nearly all flats end where the motion turns round."""
    if motion is None:
        return False
    return sum(_ends_at_reversal(motion, *flat) for flat in flats) > 0.8 * len(flats)


def _ends_at_reversal(motion: np.ndarray, start: int, end: int) -> bool:
    length = end - start
    first = max(0, start - length)
    farthest = first + int(np.argmax(motion[first : end + length]))
    return abs(farthest - (end - 1)) <= max(2, length // 20)
