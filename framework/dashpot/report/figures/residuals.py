"""The residual over time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from dashpot.report.figures import toggles
from dashpot.report.figures.excerpt import affordable, envelope
from dashpot.report.figures.tidy import TidyTable
from dashpot.report.parts import Figure
from dashpot.report.theme import axis, layout, plain, series_color

TIME = "time (s)"
POINTS_PER_TRACE = 2000
NUMBERS_PER_FIGURE = 40000


def residual_traces(
    time: Mapping[str, np.ndarray],
    residuals: Mapping[str, Mapping[str, np.ndarray]],
    shown: Sequence[str] = (),
    series: Sequence[str] = (),
) -> Figure:
    """Measured minus simulated force over time; in a long run the extremes of every short stretch are drawn.

    `time[run]` (n,) s, `residuals[label][run]` (n,) N. The runs in `shown` are drawn at first; without them it is
    the run with the largest residual of the first label drawn. So are the labels in `series`, without them all.
    """
    labels = list(residuals)
    points = affordable(len(time), 1 + len(labels), POINTS_PER_TRACE, NUMBERS_PER_FIGURE)
    table = TidyTable("run", TIME, *map(_heading, labels))
    traces = []
    for run, moments in time.items():
        drawn = {label: np.asarray(residuals[label][run]) for label in labels if run in residuals[label]}
        if not drawn:
            continue
        kept = envelope(list(drawn.values()), points)
        values = {_heading(label): signal[kept] for label, signal in drawn.items()}
        block = table.add({"run": run, TIME: np.asarray(moments)[kept]} | values)
        traces += [_trace(run, label, block, labels) for label in drawn]
    visible = {label: runs for label, runs in residuals.items() if toggles.is_shown(label, series)}
    groups = _groups(list(time), labels, set(shown) or {_worst(visible)}, series)
    return Figure(
        "Residual over time",
        "Measured minus simulated force.",
        {"data": toggles.apply(traces, groups), "layout": _layout(groups)},
        table.columns,
    )


def _trace(run: str, label: str, block: Mapping[str, Any], labels: Sequence[str]) -> dict[str, Any]:
    name = f"{plain(run)}, {plain(toggles.series_name(label))}"
    return {
        "type": "scatter",
        "mode": "lines",
        "name": name,
        "text": name,
        "meta": {"run": run, "series": label},
        "x": block[TIME],
        "y": block[_heading(label)],
        "line": {"color": series_color(label, labels), "width": 1.0},
        "hovertemplate": "%{text}<br>%{x:.3f} s, %{y:.3r} N<extra></extra>",
    }


def _groups(runs: Sequence[str], labels: Sequence[str], shown: set[str], series: Sequence[str]) -> list[dict[str, Any]]:
    buttons = [toggles.choice(run, shown=run in shown) for run in runs]
    simulations = toggles.series_group(labels, measured="", mark="solid", series=series)
    return [simulations, toggles.group("run", "Runs", buttons)]


def _worst(residuals: Mapping[str, Mapping[str, np.ndarray]]) -> str:
    first = next(iter(residuals.values()), {})
    return max(first, key=lambda run: float(np.nanmean(np.square(first[run]))), default="")


def _layout(groups: list[dict[str, Any]]) -> dict[str, Any]:
    return layout(340, xaxis=axis(TIME), yaxis=axis("residual (N)"), meta={"toggles": groups})


def _heading(label: str) -> str:
    return f"residual {toggles.series_name(label)} (N)"
