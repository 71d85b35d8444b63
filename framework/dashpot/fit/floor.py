"""The noise floor of a dataset: what no model can explain."""

from __future__ import annotations

from itertools import groupby

from dashpot.data.alignment import NotRepeatsError
from dashpot.data.dataset import Dataset
from dashpot.data.noise import (
    UNKNOWN,
    NoiseFloor,
    noise_above_motion,
    noise_from_orders,
    noise_from_repeats,
    pool_noise,
)
from dashpot.data.repeats import is_same_to_the_last_digit
from dashpot.data.run import Run
from dashpot.data.steady import STEADY
from dashpot.data.tracking import track


def noise_floor(dataset: Dataset) -> NoiseFloor:
    """From repeated runs where there are any, else from what lies between and above the orders of the motion.

    Of tables alone it is what they state.
    Declared repeats that moved otherwise, or are too short, do not count; see `false_repeats`. Nor do repeats of a
    force that a test prescribes to the last digit: they tell no noise of it.
    """
    stated = [_stated(run) for run in dataset.runs if run.kind == STEADY]
    groups = [told for group in _groups(dataset) if len(told := _not_prescribed(group)) > 1]
    floors = [floor for group in groups if isinstance(floor := _repeated(group), NoiseFloor)]
    return pool_noise([*(floors or [_single(run) for run in dataset.runs if run.kind != STEADY]), *stated])


def false_repeats(dataset: Dataset) -> list[str]:
    """Runs that are declared as repeats but moved otherwise, or are too short; the noise floor leaves them out."""
    return [
        f"{', '.join(run.name for run in group)} cannot be compared as repeats: {failed}"
        for group in _groups(dataset)
        if isinstance(failed := _repeated(group), NotRepeatsError)
    ]


def _groups(dataset: Dataset) -> list[list[Run]]:
    """The runs that repeat each other."""
    ordered = sorted(dataset.runs, key=lambda run: run.group)
    groups = [list(runs) for _, runs in groupby(ordered, lambda run: run.group)]
    return [group for group in groups if len(group) > 1]


def _not_prescribed(group: list[Run]) -> list[Run]:
    """The runs of a group but those that have the force of an earlier one over a motion of their own."""
    told: list[Run] = []
    for run in group:
        same = [other for other in told if is_same_to_the_last_digit(other.force, run.force)]
        if all(is_same_to_the_last_digit(other.displacement, run.displacement) for other in same):
            told.append(run)
    return told


def _repeated(group: list[Run]) -> NoiseFloor | NotRepeatsError:
    try:
        return noise_from_repeats([(run.displacement, run.force) for run in group], group[0].sample_time)
    except NotRepeatsError as error:
        return error


def _stated(run: Run) -> NoiseFloor:
    """What a table says of the scatter of one of its rows."""
    noise = run.sensors.get("force", {}).get("noise")
    return UNKNOWN if noise is None else NoiseFloor(noise, "stated", weight=1.0)


def _single(run: Run) -> NoiseFloor:
    oscillation = track(run) if run.kind in ("sweep", "harmonic") else None
    if oscillation:
        return noise_from_orders(run.force, oscillation)
    return noise_above_motion(run.displacement, run.force, run.sample_time)
