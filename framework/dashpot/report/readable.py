"""Texts around numbers: what somebody set, shares in percent, lists in a sentence. `text.digits` rounds."""

from __future__ import annotations

import math
from collections.abc import Sequence

from dashpot.text.digits import MISSING, is_interval, number, number_within, typeset
from dashpot.text.quantity import pretty

FAR = 1000.0  # times the noise floor: beyond three decades the ratio says nothing of the model any more


def set_value(value: float, unit: str) -> str:
    """An SI value somebody set (an amplitude, the edge of a band), without zeros nobody wrote: "0.5 mm"."""
    return typeset(pretty(value, unit))


def percent_interval(interval: Sequence[float] | None) -> str | None:
    """(0.71, 0.8) is "71 to 80"."""
    if not is_interval(interval):
        return None
    ends = [100.0 * end for end in interval]
    return " to ".join(number_within(end, ends) for end in ends)


def percent(share: float | None, digits: int = 2) -> str:
    """0.76 is "76 %"."""
    if share is None or not math.isfinite(share):
        return MISSING
    return f"{number(100.0 * share, digits)} %"


def above_floor(error: float, floor: float) -> str:
    """An error against the noise floor, both in N: "4.2 × the noise floor", or that it is far above it."""
    ratio = error / floor
    return f"{number(ratio, 2)} × the noise floor" if ratio <= FAR else "far above the noise floor"


def counted_words(count: int, word: str) -> str:
    """2 and "run" are "2 runs"."""
    return f"{count} {word}{'s' * (count != 1)}"


def listed(words: Sequence[str]) -> str:
    """a, b and c; (1) a, (2) b or c and (3) d where one of several holds an "or", so that each reads as one."""
    if len(words) < 2 or not any(" or " in text for text in words):
        return join(words)
    return join([f"({place}) {text}" for place, text in enumerate(words, 1)])


def join(words: Sequence[str]) -> str:
    """a, b and c."""
    *head, tail = words
    return f"{', '.join(head)} and {tail}" if head else tail
