"""Force over displacement, run by run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from dashpot.report.figures import excerpt, toggles
from dashpot.report.figures.tidy import TidyTable
from dashpot.report.parts import Figure
from dashpot.report.theme import axis, layout, plain, series_color

POINTS_PER_TRACE = 2000
NUMBERS_PER_FIGURE = 100000
WIDTHS = {"measured": 2.4, "before": 1.8}

X, TIME, MEASURED = "displacement (mm)", "time (s)", "measured (N)"


def loops(
    measured: Mapping[str, Mapping[str, np.ndarray]],
    simulated: Mapping[str, Mapping[str, np.ndarray]],
    shown: Sequence[str] = (),
    series: Sequence[str] = (),
) -> Figure:
    """Measured and simulated force over displacement.

    `measured[run]` holds `time` (n,) s, `displacement` (n,) m and `force` (n,) N; `simulated[label][run]` is a force
    (n,) N, the labels being "before", "after" or names of models. The runs in `shown` are drawn at first; without
    them it is the run with the largest error of the first label drawn. So are the labels in `series`, without them all.
    Long runs are drawn as cycles spread over the run.
    """
    table = TidyTable("run", TIME, X, MEASURED, *map(_heading, simulated))
    points = excerpt.affordable(len(measured), 3 + len(simulated), POINTS_PER_TRACE, NUMBERS_PER_FIGURE)
    traces = []
    for run, signals in measured.items():
        block = table.add(_block(run, signals, simulated, points))
        traces += _traces(run, block, simulated)
    drawn = {label: runs for label, runs in simulated.items() if toggles.is_shown(label, series)}
    groups = _groups(measured, simulated, set(shown) or {worst_run(measured, drawn)}, series)
    return Figure(
        "Force over displacement",
        "Cycles spread over each run. Press a run to add it or take it away; press it twice to see it alone.",
        {"data": toggles.apply(traces, groups), "layout": _layout(groups)},
        table.columns,
    )


def worst_run(
    measured: Mapping[str, Mapping[str, np.ndarray]], simulated: Mapping[str, Mapping[str, np.ndarray]]
) -> str:
    """The run on which the first simulation is furthest from the measurement; without a simulation the first run."""
    first = next(iter(simulated.values()), {})
    errors = {
        run: float(np.sqrt(np.nanmean((first[run] - signals["force"]) ** 2)))
        for run, signals in measured.items()
        if run in first
    }
    return max(errors, key=errors.__getitem__) if errors else next(iter(measured), "")


def _block(
    run: str, signals: Mapping[str, np.ndarray], simulated: Mapping[str, Mapping[str, np.ndarray]], points: int
) -> dict[str, Any]:
    pieces = excerpt.cycle_excerpts(np.asarray(signals["time"]), np.asarray(signals["displacement"]), points)
    block = {
        "run": run,
        TIME: _drawn(signals["time"], pieces),
        X: 1e3 * _drawn(signals["displacement"], pieces),
        MEASURED: _drawn(signals["force"], pieces),
    }
    return block | {_heading(label): _drawn(runs[run], pieces) for label, runs in simulated.items() if run in runs}


def _drawn(values: np.ndarray, pieces: Sequence[np.ndarray]) -> np.ndarray:
    # an empty row between two excerpts lifts the pen
    values = np.asarray(values, dtype=float)
    parts = [part for piece in pieces for part in (values[piece], [np.nan])]
    return np.concatenate(parts[:-1])


def _traces(run: str, block: Mapping[str, Any], simulated: Mapping[str, Any]) -> list[dict[str, Any]]:
    labels = list(simulated)
    drawn = [("measured", MEASURED)] + [(label, _heading(label)) for label in labels if _heading(label) in block]
    return [_trace(run, label, block, heading, labels) for label, heading in drawn]


def _trace(run: str, label: str, block: Mapping[str, Any], heading: str, labels: Sequence[str]) -> dict[str, Any]:
    name = plain(toggles.series_name(label))
    return {
        "type": "scatter",
        "mode": "lines",
        "name": f"{plain(run)}, {name}",
        "text": f"{plain(run)}, {name}",
        "meta": {"run": run, "series": label},
        "x": block[X],
        "y": block[heading],
        "customdata": block[TIME],
        "line": _line(label, labels),
        "hovertemplate": "%{text}<br>%{x:.3f} mm, %{y:.1f} N<br>at %{customdata:.3f} s<extra></extra>",
    }


def _line(label: str, labels: Sequence[str]) -> dict[str, Any]:
    return {"color": series_color(label, labels), "width": WIDTHS.get(label, 1.4), "dash": toggles.dash(label)}


def _groups(
    measured: Mapping[str, Any], simulated: Mapping[str, Any], shown: set[str], series: Sequence[str]
) -> list[dict[str, Any]]:
    runs = [toggles.choice(run, shown=run in shown) for run in measured]
    return [toggles.series_group(simulated, series=series), toggles.group("run", "Runs", runs)]


def _layout(groups: list[dict[str, Any]]) -> dict[str, Any]:
    return layout(520, xaxis=axis("displacement (mm)"), yaxis=axis("force (N)"), meta={"toggles": groups})


def _heading(label: str) -> str:
    return f"{toggles.series_name(label)} (N)"
