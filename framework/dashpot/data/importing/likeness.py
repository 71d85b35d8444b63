"""Runs that are the same measurement made again: the same motion, and nearly the same force."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from dashpot.data.alignment import NotRepeatsError
from dashpot.data.importing.counters import without_counters
from dashpot.data.importing.finding import NEEDED, Finding, Level
from dashpot.data.importing.names import differ
from dashpot.data.repeats import compare_repeats

# how much of the force two runs may not share: without a hint, and where their names say that one repeats the other
_ALIKE, _ALIKE_BY_NAME = 0.05, 0.3
# of a level: 6 K of a temperature, a twentieth of a bar beside two; more without a unit, as 2 of 20 may be degC
_SAME_LEVEL, _SAME_NUMBER = 0.02, 0.1
_BY_NAME = "condition in its name"
_AGAIN = re.compile(
    r"(.+?)[ _.-]*(?:[b-e]|[2-9]|r\d|rep\w*\d*|rerun\d*|wdh\d*|wiederholung\d*|copy|kopie|\(\d\))", re.I
)


@dataclass(frozen=True)
class Likeness:
    """Run -> the earlier run that it repeats; run -> the earlier one that it is a copy of, to the last digit.

    ``apart``: run -> what its name tells or was measured beside it, other than in an earlier run of the same motion and
    force.
    """

    repeats: Mapping[str, str]
    copies: Mapping[str, str]
    apart: Mapping[str, tuple[str, ...]]


def find_repeats(findings: Mapping[str, Finding]) -> Likeness:
    """Which runs are the measurement of an earlier one made again."""
    repeats: dict[str, str] = {}
    copies: dict[str, str] = {}
    apart: dict[str, tuple[str, ...]] = {}
    names = list(findings)
    told = without_counters(names)
    for index, name in enumerate(names):
        for earlier in names[:index]:
            if earlier in repeats or earlier in copies or not _comparable(findings[earlier], findings[name]):
                continue
            difference = _difference(findings[earlier], findings[name])
            otherwise = told[name] != told[earlier]
            if difference >= (_ALIKE_BY_NAME if not otherwise and _is_again(name, earlier) else _ALIKE):
                continue
            other = _at_other_levels(findings[earlier].levels, findings[name].levels)
            if other or (otherwise and difference):
                apart[name] = (*other, *([_BY_NAME] if otherwise else []))
                continue
            (repeats if difference else copies)[name] = earlier
            apart.pop(name, None)
            break
    return Likeness(repeats, copies, apart)


def _is_again(name: str, earlier: str) -> bool:
    match = _AGAIN.fullmatch(name)
    return match is not None and match[1] in (earlier, earlier.rstrip("aA1").rstrip("_- "))


def _comparable(first: Finding, second: Finding) -> bool:
    if differ(first.conditions, second.conditions):
        return False
    if first.kind != second.kind or not (first.signals and second.signals) or not first.timing.step:
        return False
    lengths = [finding.signals["force"].size for finding in (first, second)]
    spans = [np.ptp(finding.signals["displacement"]) for finding in (first, second)]
    same_step = second.timing.step and abs(first.timing.step / second.timing.step - 1) < 0.01
    return bool(same_step and min(lengths) > 0.8 * max(lengths) and min(spans) > 0.9 * max(spans))


def _at_other_levels(first: Mapping[str, Level], second: Mapping[str, Level]) -> tuple[str, ...]:
    """What was measured beside both runs and says that they were made under other conditions."""
    return tuple(key for key in first if key in second and _apart(first[key], second[key]))


def _apart(first: Level, second: Level) -> bool:
    """Whether two levels differ: each may scatter within its run, and what drifts by less is the same."""
    share = _SAME_LEVEL if first.known and second.known else _SAME_NUMBER
    least = max(share * max(abs(first.mean), abs(second.mean)), first.spread, second.spread)
    return abs(first.mean - second.mean) > least


def _difference(first: Finding, second: Finding) -> float:
    """The force that two runs do not share, as a part of all of it; infinite when their motions differ."""
    if all(np.array_equal(first.signals[name], second.signals[name]) for name in NEEDED):
        return 0.0
    runs = [(finding.signals["displacement"], finding.signals["force"]) for finding in (first, second)]
    try:
        departure = compare_repeats(runs, first.timing.step or 1.0).departure
    except NotRepeatsError:
        return float("inf")
    # a force that a test prescribes may come again to the last digit over a motion of its own: it is no copy
    smallest = np.finfo(float).tiny
    return max(float(np.sqrt(np.mean(departure**2)) / max(np.std(first.signals["force"]), smallest)), smallest)
