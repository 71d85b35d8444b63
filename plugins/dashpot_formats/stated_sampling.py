"""The sampling rate that the lines above a text table state."""

from __future__ import annotations

import re
from collections.abc import Sequence

from dashpot.text.quantity import factor

_NUMBER = r"(?P<number>\d+(?:[.,]\d+)?(?:[eE][-+]?\d+)?)"
_RATE = re.compile(
    r"(?:sampl(?:e|ing)[ _]?(?:rate|frequency|freq)|abtast(?:rate|frequenz)|messrate|\bSR|\bfs)\s*"
    rf"(?:\[(?P<inside>\w+)\]|\((?P<inside2>\w+)\))?\s*[:=;,\t ]\s*\"?{_NUMBER}\s*(?P<unit>k?Hz)?",
    re.IGNORECASE,
)
_STEP = re.compile(
    rf"(?:Delta_X|sampl(?:e|ing)[ _](?:interval|time)|abtastzeit)\s*[:=;,\t ]\s*{_NUMBER}\s*(?P<unit>m?s\b)?", re.I
)


_LONGEST_LINE = 2000


def stated_sampling(lines: Sequence[str]) -> float | None:
    """Hz, when the lines state one rate, and only one; None otherwise."""
    short = [line for line in lines if len(line) < _LONGEST_LINE]
    rates = {_hertz(match) for line in short for match in _RATE.finditer(line)}
    rates |= {_hertz_of_step(match) for line in short for match in _STEP.finditer(line)}
    return rates.pop() if len(rates) == 1 and None not in rates else None


def _number(match: re.Match[str]) -> float:
    return float(match["number"].replace(",", "."))


def _hertz(match: re.Match[str]) -> float | None:
    unit = match["unit"] or match["inside"] or match["inside2"] or "Hz"
    if unit.lower() not in ("hz", "khz"):
        return None
    return _number(match) * factor("kHz" if unit.lower() == "khz" else "Hz", "Hz")[0] or None


def _hertz_of_step(match: re.Match[str]) -> float | None:
    step = _number(match) * (1e-3 if match["unit"] == "ms" else 1.0)
    return float(f"{1.0 / step:.12g}") if step > 0 else None
