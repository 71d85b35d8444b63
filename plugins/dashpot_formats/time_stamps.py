"""Columns of dates and times of day as seconds."""

from __future__ import annotations

import math
import re
from array import array
from collections.abc import Iterable
from datetime import date

import numpy as np

_CLOCK = r"(?P<hour>\d{1,2}):(?P<minute>\d{2}):(?P<second>\d{2}(?:[.,:]\d{1,9})?)\s*(?P<half>[AaPp][Mm])?"
_DATE = r"(?P<first>\d{1,4})(?P<sign>[-./])(?P<middle>\d{1,2})(?P=sign)(?P<last>\d{1,4})"
_STAMP = re.compile(rf"(?:{_DATE}(?:T|[ _,;]\s*))?{_CLOCK}(?:Z|[+-]\d{{2}}:?\d{{2}})?")
_DAY = 86400.0


def is_stamp(text: str) -> bool:
    """Whether a text is a time of day, with or without a date."""
    return _STAMP.fullmatch(text.strip()) is not None


def seconds(texts: Iterable[str]) -> np.ndarray | None:
    """Seconds (n,) since the first stamp, NaN where a text is empty; None when a text is anything else.

    The order of day and month is that of the country: 31.12.2024 and 2024-12-31; with slashes the day comes first
    unless that makes no date or the clock has AM and PM. Times without a date go on past midnight.
    """
    pairs = array("d")
    for text in texts:
        match = _STAMP.fullmatch(text.strip())
        value = _day_and_seconds(match) if match else None
        if value is None and text.strip():
            return None
        pairs.extend((math.nan, math.nan) if value is None else value)
    found = np.array(pairs).reshape(-1, 2)
    known = np.flatnonzero(np.isfinite(found[:, 1]))
    if not known.size:
        return None
    # the first day is taken off before days become seconds, so that fractions of a second keep their digits
    passed = _DAY * (found[:, 0] - found[known[0], 0]) + found[:, 1]
    passed[known] += _DAY * np.cumsum(np.diff(passed[known], prepend=passed[known[0]]) < -0.5 * _DAY)
    return np.round(passed - passed[known[0]], 9)


def _day_and_seconds(match: re.Match[str]) -> tuple[int, float] | None:
    hour, minute = int(match["hour"]), int(match["minute"])
    if match["half"]:
        hour = hour % 12 + 12 * (match["half"].lower() == "pm")
    second = float(re.sub("[,:]", ".", match["second"]))
    days = _days(match) if match["first"] else 0
    if days is None or hour > 24 or minute > 59:
        return None
    return days, 3600.0 * hour + 60.0 * minute + second


def _days(match: re.Match[str]) -> int | None:
    first, middle, last = int(match["first"]), int(match["middle"]), int(match["last"])
    if len(match["first"]) == 4:
        year, month, day = first, middle, last
    elif match["sign"] == "/" and (match["half"] or middle > 12):
        month, day, year = first, middle, last
    else:
        day, month, year = first, middle, last
    try:
        return date(year if year > 99 else 2000 + year, month, day).toordinal()
    except ValueError:
        return None
