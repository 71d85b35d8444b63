"""Force over displacement and velocity, run by run."""

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

X, V, TIME, MEASURED = "displacement (mm)", "velocity (m/s)", "time (s)", "measured (N)"
PANELS = ((X, "x", "y", [0.0, 0.47]), (V, "x2", "y2", [0.53, 1.0]))  # over what, on which axes, where

STRONG = 5.0  # times the median stroke of the force: a branch beside which others cannot be seen

CYCLES = "Cycles spread over each run. Press a run to add it or take it away; press it twice to see it alone."


def loops(
    measured: Mapping[str, Mapping[str, np.ndarray]],
    simulated: Mapping[str, Mapping[str, np.ndarray]],
    shown: Sequence[str] = (),
    series: Sequence[str] = (),
) -> Figure:
    """Measured and simulated force over displacement, and beside it over velocity.

    `measured[run]` holds `time` (n,) s, `displacement` (n,) m, `velocity` (n,) m/s and `force` (n,) N;
    `simulated[label][run]` is a force (n,) N, the labels being "before", "after" or names of models. The runs in
    `shown` are drawn at first; without them it is the run with the largest error of the first label drawn. So are the
    labels in `series`, without them all.
    Long runs are drawn as cycles spread over the run.
    """
    return _figure("Force over displacement and velocity", CYCLES, measured, simulated, shown, series)


def branch_loops(
    measured: Mapping[str, Mapping[str, np.ndarray]], branches: Mapping[str, Mapping[str, np.ndarray]]
) -> Figure:
    """The measured force and that of each branch, `branches[name][run]` (n,) N, over displacement and velocity.

    The fastest run is drawn at first, and of the branches those that are not far stronger than the others.
    """
    fastest = max(measured, key=lambda run: float(np.ptp(measured[run]["velocity"])), default="")
    strokes = {name: float(np.ptp(runs[fastest])) for name, runs in branches.items() if fastest in runs}
    usual = float(np.median(list(strokes.values()))) if strokes else 0.0
    series = [name for name, stroke in strokes.items() if stroke <= STRONG * usual]
    caption = f"The force of each branch of the model; branches with a much larger force are hidden at first. {CYCLES}"
    return _figure("Force of each branch", caption, measured, branches, (fastest,), series, measured_shown=False)


def _figure(
    title: str,
    caption: str,
    measured: Mapping[str, Mapping[str, np.ndarray]],
    simulated: Mapping[str, Mapping[str, np.ndarray]],
    shown: Sequence[str],
    series: Sequence[str],
    measured_shown: bool = True,
) -> Figure:
    table = TidyTable("run", TIME, X, V, MEASURED, *map(_heading, simulated))
    points = excerpt.affordable(len(measured), 4 + len(simulated), POINTS_PER_TRACE, NUMBERS_PER_FIGURE)
    traces = []
    for run, signals in measured.items():
        block = table.add(_block(run, signals, simulated, points))
        traces += _traces(run, block, simulated)
    drawn = {label: runs for label, runs in simulated.items() if toggles.is_shown(label, series)}
    groups = _groups(measured, simulated, set(shown) or {worst_run(measured, drawn)}, series, measured_shown)
    return Figure(title, caption, {"data": toggles.apply(traces, groups), "layout": _layout(groups)}, table.columns)


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
        V: _drawn(signals["velocity"], pieces),
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
    return [_trace(run, label, block, heading, labels, panel) for label, heading in drawn for panel in PANELS]


def _trace(
    run: str,
    label: str,
    block: Mapping[str, Any],
    heading: str,
    labels: Sequence[str],
    panel: tuple[str, str, str, list[float]],
) -> dict[str, Any]:
    name, (over, x, y, _) = plain(toggles.series_name(label)), panel
    unit = over.partition("(")[2].rstrip(")")
    return {
        "type": "scatter",
        "mode": "lines",
        "name": f"{plain(run)}, {name}",
        "text": f"{plain(run)}, {name}",
        "meta": {"run": run, "series": label},
        "x": block[over],
        "y": block[heading],
        "xaxis": x,
        "yaxis": y,
        "customdata": block[TIME],
        "line": _line(label, labels),
        "hovertemplate": f"%{{text}}<br>%{{x:.3f}} {unit}, %{{y:.4r}} N<br>at %{{customdata:.3f}} s<extra></extra>",
    }


def _line(label: str, labels: Sequence[str]) -> dict[str, Any]:
    return {"color": series_color(label, labels), "width": WIDTHS.get(label, 1.4), "dash": toggles.dash(label)}


def _groups(
    measured: Mapping[str, Any],
    simulated: Mapping[str, Any],
    shown: set[str],
    series: Sequence[str],
    measured_shown: bool,
) -> list[dict[str, Any]]:
    runs = [toggles.choice(run, shown=run in shown) for run in measured]
    drawn = toggles.series_group(simulated, series=series)
    drawn["choices"][0]["shown"] = measured_shown
    return [drawn, toggles.group("run", "Runs", runs)]


def _layout(groups: list[dict[str, Any]]) -> dict[str, Any]:
    (left, right) = (panel[3] for panel in PANELS)
    return layout(
        460,
        xaxis=axis(X, domain=left),
        yaxis=axis("force (N)"),
        xaxis2=axis(V, domain=right, anchor="y2"),
        yaxis2=axis(anchor="x2", matches="y"),
        meta={"toggles": groups},
    )


def _heading(label: str) -> str:
    return f"{toggles.series_name(label)} (N)"
