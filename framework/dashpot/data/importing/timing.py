"""The clock of a file: a column of times, or a sampling rate."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from dashpot.data.checks import FEWEST_SAMPLES
from dashpot.data.clock import LONGEST_GAP, read_clock
from dashpot.data.importing.roles import Role, is_counter, name_score
from dashpot.data.importing.units import find_unit
from dashpot.data.trouble import Unusable
from dashpot.text.quantity import factor

_DISAGREEMENT = 0.02
# one line without a time is a hole in a run, more are the heading of the next one
_LONGEST_HOLE = 1


@dataclass(frozen=True)
class Timing:
    """A time column with its unit, or a sampling rate in Hz, or neither; `step` in s; what has to be confirmed."""

    column: str | None = None
    unit: str | None = None
    sampling: float | None = None
    step: float | None = None
    confirm: tuple[str, ...] = ()


def find_timing(
    columns: Mapping[str, np.ndarray], units: Mapping[str, str], stated: float | None, role: Role | None
) -> Timing:
    """The clock that the columns tell. A time that repeats its stamps gives a rate only."""
    name = role.column if role else _unnamed_clock(columns, units)
    if name is None or not _runs(columns[name]):
        if stated:
            return Timing(sampling=stated, step=1.0 / stated)
        return Timing(confirm=("there is no time and no sampling rate: add 'sampling: ... Hz' under channels",))
    found = find_unit("time", name, units.get(name, ""), columns[name])
    confirm = () if found.by != "guessed" else (f"the time is taken to be in {found.unit}: no unit is stated",)
    if role is None:
        confirm = (f"column '{name}' is taken for the time, as it grows evenly", *confirm)
    scale = factor(found.unit, "s")[0]
    try:
        step = read_clock(columns[name] * scale, str).step
    except Unusable:
        return _uneven(Timing(name, found.unit, confirm=confirm), columns[name] * scale, stated)
    if stated and abs(step * stated - 1) > _DISAGREEMENT:
        confirm = (*confirm, f"the file states {stated:g} Hz, its time column runs at {1 / step:.6g} Hz")
    return Timing(name, found.unit, None, step, confirm)


def _runs(values: np.ndarray) -> bool:
    return bool(values.size > 1 and np.all(np.diff(values) >= 0) and values[-1] > values[0])


def _uneven(timing: Timing, time: np.ndarray, stated: float | None) -> Timing:
    """A clock that repeats its stamps gives a rate only; gaps are left to the reading of the dataset."""
    if not np.any(np.diff(time) == 0):
        return replace(timing, step=float(np.median(np.diff(time))))
    rate = stated or float(f"{(time.size - 1) / (time[-1] - time[0]):.4g}")
    remark = f"the time '{timing.column}' repeats its stamps: the sampling rate of {rate:g} Hz is used in its place"
    return Timing(sampling=rate, step=1.0 / rate, confirm=(*timing.confirm, remark))


def pieces(time: np.ndarray) -> list[tuple[int, int]]:
    """First sample and one past the last of the pieces of a clock (n,).

    They lie between gaps, restarts, and lines without a time; those of less than a hundredth of all samples, and those
    too short for anything, are left out.
    """
    known = np.flatnonzero(np.isfinite(time))
    steps = np.diff(time[known])
    if not steps.size:
        return [(0, time.size)]
    breaks = (steps < 0) | (steps > LONGEST_GAP * np.median(steps)) | (np.diff(known) > 1 + _LONGEST_HOLE)
    starts, ends = known[np.append(True, breaks)], known[np.append(breaks, True)] + 1
    return [
        (int(a), int(b)) for a, b in zip(starts, ends, strict=True) if b - a >= max(FEWEST_SAMPLES, 0.01 * time.size)
    ]


def _unnamed_clock(columns: Mapping[str, np.ndarray], units: Mapping[str, str]) -> str | None:
    """A column without a name that grows by the same step from sample to sample; counters do not count."""
    for name, values in columns.items():
        steps = np.diff(values)
        typical = float(np.median(steps)) if steps.size else 0.0
        if typical <= 0 or np.any(steps < 0) or is_counter(name) or units.get(name):
            continue
        if any(name_score(name, channel) for channel in ("displacement", "force", "velocity")):
            continue
        counted = typical == 1.0 and values[0] in (0.0, 1.0) and np.all(steps == 1.0)
        if not counted and np.mean(np.abs(steps / typical - 1)) < 0.25:
            return name
    return None
