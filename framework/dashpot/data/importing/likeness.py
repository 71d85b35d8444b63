"""Runs that are the same measurement made again: the same motion, and nearly the same force."""

from __future__ import annotations

import re
from collections.abc import Mapping

import numpy as np

from dashpot.data.importing.finding import Finding, Level
from dashpot.data.importing.names import differ
from dashpot.data.repeats import NotRepeatsError, compare_repeats

# how much of the force two runs may not share: without a hint, and where their names say that one repeats the other
_ALIKE, _ALIKE_BY_NAME = 0.05, 0.3
# of a level: 6 K of a temperature, a twentieth of a bar beside two
_SAME_LEVEL = 0.02
_AGAIN = re.compile(
    r"(.+?)[ _.-]*(?:[b-e]|[2-9]|r\d|rep\w*\d*|rerun\d*|wdh\d*|wiederholung\d*|copy|kopie|\(\d\))", re.I
)


def find_repeats(findings: Mapping[str, Finding]) -> tuple[dict[str, str], dict[str, str]]:
    """Run -> the earlier run that it repeats, and run -> the earlier one that it is a copy of, to the last digit."""
    repeats: dict[str, str] = {}
    copies: dict[str, str] = {}
    names = list(findings)
    for index, name in enumerate(names):
        for earlier in names[:index]:
            if earlier in repeats or earlier in copies or not _comparable(findings[earlier], findings[name]):
                continue
            difference = _difference(findings[earlier], findings[name])
            if difference < (_ALIKE_BY_NAME if _is_again(name, earlier) else _ALIKE):
                (repeats if difference else copies)[name] = earlier
                break
    return repeats, copies


def _is_again(name: str, earlier: str) -> bool:
    match = _AGAIN.fullmatch(name)
    return match is not None and match[1] in (earlier, earlier.rstrip("aA1").rstrip("_- "))


def _comparable(first: Finding, second: Finding) -> bool:
    if differ(first.conditions, second.conditions) or _at_other_levels(first.levels, second.levels):
        return False
    if first.kind != second.kind or not (first.signals and second.signals) or not first.timing.step:
        return False
    lengths = [finding.signals["force"].size for finding in (first, second)]
    spans = [np.ptp(finding.signals["displacement"]) for finding in (first, second)]
    same_step = second.timing.step and abs(first.timing.step / second.timing.step - 1) < 0.01
    return bool(same_step and min(lengths) > 0.8 * max(lengths) and min(spans) > 0.9 * max(spans))


def _at_other_levels(first: Mapping[str, Level], second: Mapping[str, Level]) -> bool:
    """Whether a channel that was measured beside both runs says that they were made under other conditions.

    It may scatter within a run, and what drifts by less is the same.
    """
    return any(
        abs(first[key].mean - second[key].mean)
        > max(_SAME_LEVEL * max(abs(first[key].mean), abs(second[key].mean)), first[key].spread, second[key].spread)
        for key in first.keys() & second.keys()
    )


def _difference(first: Finding, second: Finding) -> float:
    """The force that two runs do not share, as a part of all of it; infinite when their motions differ."""
    if np.array_equal(first.signals["force"], second.signals["force"]):
        return 0.0
    runs = [(finding.signals["displacement"], finding.signals["force"]) for finding in (first, second)]
    try:
        departure = compare_repeats(runs, first.timing.step or 1.0).departure
    except (NotRepeatsError, ValueError):
        return float("inf")
    return float(np.sqrt(np.mean(departure**2)) / max(np.std(first.signals["force"]), 1e-300))
