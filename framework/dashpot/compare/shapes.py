"""The shape of a force without a model: over velocity at mid stroke, at low speed, after reversals, by condition.

The same curves are taken out of the measured force and out of simulated ones, along the same motion.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.compare.levels import ORDER, levelled
from dashpot.compare.residual_map import residual_maps
from dashpot.compare.strokes import Seen, see
from dashpot.data.loop import mean_loop
from dashpot.data.run import Run

Array = NDArray[np.float64]
Simulated = Mapping[str, Mapping[str, Array]]

MIDDLE = 0.1  # of a stroke, to both sides of its middle
SLOW = 0.1  # of the largest speed of all runs
AS_SLOW = 1.2  # times the largest speed of the slowest run
PLACES, TRAVELS = 80, 40
MOST_SHADES = 6
SHORTEST_TRAVEL = 1.0 / 50.0  # of the range of a run
MOST_REVERSALS = 100
# settings that say nothing of the condition of the specimen
NO_CONDITIONS = ("warm_up", "start", "stop", "duration")


def shapes_of(
    runs: Sequence[Run], simulated: Simulated | None = None, held_out: Collection[str] = ()
) -> dict[str, Any]:
    """Curves of the measured force and of ``simulated[label][run]`` (n,) N, for ``report.figures.shape_figures``.

    ``labels``; ``runs``: each ``run`` and its ``shade``, the value of the condition ``shaded_by``; ``mid_stroke``,
    ``low_speed``, ``less_spring`` and ``after_reversals``: lists of curves ``{run, label, x, y}`` in SI;
    ``conditions``: values by run and label, see ``conditions_of``, at the levels of all runs; ``cycles``: the same
    over time; ``residual_maps``: see ``residual_map``, of the runs that are not ``held_out``: a network errs more on
    these, and a map of both would show which runs they are.
    """
    seen = [see(run, simulated) for run in runs]
    slow = [curve for each in slow_runs(seen) for curve in low_speed(each)]
    return {
        "labels": list(simulated or {}),
        **_shades(seen),
        "mid_stroke": [curve for each in seen for curve in mid_stroke(each)],
        "low_speed": slow,
        "less_spring": less_spring(slow),
        "after_reversals": [curve for each in seen for curve in after_reversals(each)],
        "conditions": _at_levels([row for each in seen for row in conditions_of(each)], seen),
        "cycles": [row for each in seen for row in over_time(each)],
        "residual_maps": residual_maps([each for each in seen if each.name not in held_out]),
    }


def mid_stroke(seen: Seen) -> list[dict[str, Any]]:
    """A point for each stroke: velocity in m/s and force in N around its middle, less the mean of all points.

    Where the middles of the strokes differ, a straight spring, the slope of the measured force, is taken off.
    """
    middles = []
    for a, b in seen.strokes():
        x = seen.displacement[a : b + 1]
        near = np.abs(x - 0.5 * (x[0] + x[-1])) <= MIDDLE * abs(x[-1] - x[0])
        middles.append(a + np.flatnonzero(near))
    middles = [each for each in middles if each.size]
    if len(middles) < 2:
        return []
    velocity, place = (
        np.array([values[each].mean() for each in middles]) for values in (seen.velocity, seen.displacement)
    )
    spring = _slope(seen.displacement[seen.first :], seen.forces["measured"][seen.first :]) * (place - place.mean())
    curves = []
    for label, force in seen.forces.items():
        values = np.array([force[each].mean() for each in middles])
        curves.append({"run": seen.name, "label": label, "x": velocity, "y": values - values.mean() - spring})
    return curves


def slow_runs(seen: Sequence[Seen]) -> list[Seen]:
    """The runs below a tenth of the largest speed of all, and those that are about as slow as the slowest run."""
    speeds = [each.peak_speed for each in seen]
    slow = max(SLOW * max(speeds), AS_SLOW * min(speeds))
    return [each for each in seen if each.peak_speed <= slow]


def low_speed(seen: Seen) -> list[dict[str, Any]]:
    """Mean force in N over deflection in m, on the way in and on the way out, of the longest strokes of a run."""
    curves = []
    for label, force in seen.forces.items():
        try:
            loop = mean_loop(seen.displacement, np.asarray(force))
        except ValueError:
            return []
        rows = np.unique(np.linspace(0, loop.deflection.size - 1, PLACES).astype(np.intp))
        ways = [(loop.deflection[rows], way[rows]) for way in (loop.loading, loop.unloading) if way is not None]
        x, y = (np.concatenate([part for way in ways for part in (way[which], [np.nan])]) for which in (0, 1))
        curves.append({"run": seen.name, "label": label, "x": x[:-1], "y": y[:-1]})
    return curves


def less_spring(curves: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """The curves of ``low_speed`` less one straight line, that through all measured ones."""
    measured = [curve for curve in curves if curve["label"] == "measured"]
    if not measured:
        return []
    x, y = (np.concatenate([np.asarray(curve[which]) for curve in measured]) for which in ("x", "y"))
    known = np.isfinite(y)
    slope, level = np.polyfit(x[known], y[known], 1)
    return [{**curve, "y": curve["y"] - slope * curve["x"] - level} for curve in curves]


def after_reversals(seen: Seen) -> list[dict[str, Any]]:
    """The mean change of the force over the travel since the reversal, in N/m, over this travel in m."""
    strokes = [(a, b) for a, b in seen.strokes() if a > 0]
    strokes = strokes[:: max(1, len(strokes) // MOST_REVERSALS)]
    if not strokes:
        return []
    x = seen.displacement
    shortest = min(abs(x[b] - x[a]) for a, b in strokes)
    travel = np.geomspace(SHORTEST_TRAVEL * shortest, shortest, TRAVELS)
    ways = [np.maximum.accumulate(np.abs(x[a : b + 1] - x[a])) for a, b in strokes]
    curves = []
    for label, force in seen.forces.items():
        rises = [
            np.sign(x[b] - x[a]) * (np.interp(travel, way, force[a : b + 1]) - force[a])
            for (a, b), way in zip(strokes, ways, strict=True)
        ]
        curves.append({"run": seen.name, "label": label, "x": travel, "y": np.mean(rises, axis=0) / travel})
    return curves


def conditions_of(seen: Seen) -> list[dict[str, Any]]:
    """A row for each label: the conditions of the run, and the stiffness, loss and energy of its closed cycles.

    ``conditions``: amplitude and preload in m, the order of the tests and the numeric settings in SI; ``stiffness`` and
    ``loss`` N/m and ``energy`` J are medians over the cycles.
    """
    settings = {name: value for name, value in seen.run.settings.items() if name not in NO_CONDITIONS}
    conditions = {"amplitude": seen.amplitude, "preload": seen.preload} | settings
    conditions[ORDER] = float(seen.run.order + 1)
    rows = []
    for label, values in seen.cycle_values.items():
        if values.time.size:
            medians = {name: float(np.median(getattr(values, name))) for name in ("stiffness", "loss", "energy")}
            rows.append({"run": seen.name, "label": label, "conditions": conditions, **medians})
    return rows


def _at_levels(rows: Sequence[dict[str, Any]], seen: Sequence[Seen]) -> list[dict[str, Any]]:
    """The rows with what a rig does not tell apart under one value."""
    conditions: list[dict[str, float]] = [dict(row["conditions"]) for row in rows]
    for name in dict.fromkeys(name for each in conditions for name in each):
        having = [each for each in conditions if name in each]
        values = levelled(name, np.array([each[name] for each in having]), seen)
        for each, value in zip(having, values.tolist(), strict=True):
            each[name] = value
    return [{**row, "conditions": each} for row, each in zip(rows, conditions, strict=True)]


def over_time(seen: Seen) -> list[dict[str, Any]]:
    """A curve for each label: the loss in N/m of every closed cycle over time in s."""
    curves = []
    for label, values in seen.cycle_values.items():
        if values.time.size > 1:
            curves.append({"run": seen.name, "label": label, "x": values.time, "y": values.loss})
    return curves


def _slope(x: Array, force: Array) -> float:
    about = x - x.mean()
    return float(about @ force / (about @ about))


def _shades(seen: Sequence[Seen]) -> dict[str, Any]:
    """The condition by which runs are coloured: a setting of a few values that all runs have, else the amplitude."""
    common = set.intersection(*(set(each.run.settings) for each in seen)) - {*NO_CONDITIONS, "amplitude", "preload"}
    levels = {name: len({each.run.settings[name] for each in seen}) for name in sorted(common)}
    shaded_by = next((name for name, count in levels.items() if 1 < count <= MOST_SHADES), "amplitude")
    runs = [
        {"run": each.name, "shade": each.run.settings.get(shaded_by, float(f"{each.amplitude:.2g}"))} for each in seen
    ]
    return {"shaded_by": shaded_by, "runs": runs}
