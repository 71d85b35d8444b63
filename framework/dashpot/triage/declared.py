"""Runs that move otherwise than their settings say, by so much that a unit is wrong."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from dashpot.data.run import Run
from dashpot.text.quantity import pretty
from dashpot.triage.work import begin_of_motion

# times the setting: from there on a factor of 1000 is nearer than none
OTHERWISE = 1000.0**0.5


Seen = Callable[[Run], float]


def moved_otherwise(runs: Sequence[Run]) -> list[str]:
    """A remark for each quantity in which runs are far from their own settings: amplitude in m, frequency in Hz."""
    asked = (
        ("amplitude", "m", _amplitude, "the unit of its displacement"),
        ("frequency", "Hz", _frequency, "the unit of its time"),
        ("stop", "Hz", _frequency, "the unit of its time"),
    )
    return [remark for key, unit, seen, what in asked for remark in _told(runs, key, unit, seen, what)]


def _told(runs: Sequence[Run], key: str, unit: str, seen: Seen, what: str) -> Iterator[str]:
    declared = {run: run.settings[key] for run in runs if run.settings.get(key, 0.0) > 0.0}
    far = {run: found for run, set_to in declared.items() if (found := seen(run)) and _is_far(found / set_to)}
    if not far:
        return
    run, found = max(far.items(), key=lambda item: abs(np.log(item[1] / declared[item[0]])))
    others = f" (and {len(far) - 1} of {len(declared) - 1} others)" if len(far) > 1 else ""
    yield (
        f"Run '{run.name}'{others} moves otherwise than declared: with {pretty(found, unit, 3)} where its setting "
        f"'{key}' is {pretty(declared[run], unit, 3)}; check {what}"
    )


def _is_far(ratio: float) -> bool:
    return not 1.0 / OTHERWISE < ratio < OTHERWISE


def _amplitude(run: Run) -> float:
    """Half of the way in m, without the one to where the motion begins; of a step it is the motion."""
    begin = 0 if run.kind in ("hold", "transient") else begin_of_motion(run.displacement)
    return 0.5 * float(np.ptp(run.displacement[begin:]))


def _frequency(run: Run) -> float:
    """The mean rate in Hz at which the deflection passes its median upwards; 0 where it does not."""
    moving = run.displacement[begin_of_motion(run.displacement) :]
    above = moving > np.median(moving)
    return float(np.sum(above[1:] & ~above[:-1])) / (moving.size * run.sample_time)
