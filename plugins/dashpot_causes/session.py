"""The order in which runs were made, where it is more than the order in which they were driven."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import View
from dashpot.data.history import is_history, runs_before
from dashpot.model.network import Branch

ORDER = "order"
REACHED = "reached"  # how far the specimen was deflected in the runs before
MOVED = "moved"  # the integral of the squared velocity over the run before
FEWEST = 4  # runs one after the other: two or three lie on a line by chance
FORETOLD = 0.9  # of the variance of the order: what follows it may as well follow the stroke, the speed or a setting
ROOM = 10.0  # of the times of cooling beyond those that are tried
SENSIBLE = (1e-2, 1e5)  # s, of the times of cooling of elements
CHANGES = 0.01  # of its size: a condition that changes by less is the same in all runs


def order_of(view: View) -> Mapping[str, float]:
    """The places of the runs in their dataset, from 0 for the first one.

    Empty where they are not known, or where strokes, middles, speeds and settings of the runs predict them.
    """
    settings = {run: view.settings(run) for run in view.runs}
    if len(settings) < FEWEST or any(ORDER not in each for each in settings.values()):
        return {}
    places = np.array([each[ORDER] for each in settings.values()])
    if np.unique(places).size < FEWEST or _predicted(_conditions(view, settings), places) > FORETOLD:
        return {}
    return dict(zip(settings, (places - places.min()).tolist(), strict=True))


def left_of_runs_before(settings: Mapping[str, float], word: str, kept: float) -> float:
    """A setting of the run before, and what is left of earlier ones by the share kept from a run to the next."""
    before = np.array(runs_before(settings, word))
    return float(np.sum(before * kept ** np.arange(before.size)))


def kept_of_runs_before(word: str, unit: str, kept: float) -> str:
    """The same as it stands in a file, with the share to be found."""
    return f"{{fixed: 0 {unit}, over: {{setting: {word}, kept: {{start: {kept:g}}}}}}}"


def goes_by_heat(branch: Branch) -> bool:
    """Whether a law goes by the motion of the runs before: what it changes over the session is its own."""
    return any(MOVED in (value.setting, value.over.word if value.over else "") for value in branch.values.values())


def room_of(times: Sequence[float]) -> tuple[float, float]:
    """The bounds of a time of cooling in s: a fit by itself looks no farther than one run is long."""
    return max(min(times) / ROOM, SENSIBLE[0]), min(max(times) * ROOM, SENSIBLE[1])


def is_condition(setting: str) -> bool:
    """Whether a setting says in which state a run was made, and not after which others."""
    return setting != ORDER and not is_history(setting)


def _conditions(view: View, settings: Mapping[str, Mapping[str, float]]) -> NDArray[np.float64]:
    """What was set at each run (runs, conditions): how far and how fast it was moved, and the settings of all runs."""
    common = sorted(filter(is_condition, set.intersection(*(set(each) for each in settings.values()))))
    moved = [
        [np.min(view.displacement(run)), np.max(view.displacement(run)), np.std(view.velocity(run))] for run in settings
    ]
    return np.column_stack([moved, np.array([[each[key] for key in common] for each in settings.values()])])


def _predicted(conditions: NDArray[np.float64], places: NDArray[np.float64]) -> float:
    """The share of the variance of the places (runs,) that a straight line over the conditions explains.

    Adjusted for the degrees of freedom: many conditions follow any order of few runs by chance. 1 where none are left.
    """
    spread, size = np.std(conditions, axis=0), np.sqrt(np.mean(conditions**2, axis=0))
    known = (conditions - conditions.mean(axis=0))[:, spread > CHANGES * size] / spread[spread > CHANGES * size]
    centred = places - places.mean()
    slopes, _, rank, _ = np.linalg.lstsq(known, centred, rcond=1e-6)
    rest, left = centred - known @ slopes, places.size - 1 - int(rank)
    return 1.0 - float(rest @ rest) / left / float(np.var(places, ddof=1)) if left > 0 else 1.0
