"""Damper curves, force over velocity, as far as the runs have excited them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.report.figures import toggles
from dashpot.report.figures.tidy import TidyTable
from dashpot.report.parts import Figure
from dashpot.report.theme import axis, layout, plain, series_color

Array = NDArray[np.float64]

VELOCITY, FORCE, LOW, HIGH = "velocity (m/s)", "force (N)", "force from (N)", "force to (N)"


def velocity_curves(
    curves: Mapping[str, Mapping[str, Any]], measured: Mapping[str, Mapping[str, Any]] | None = None
) -> Figure:
    """Force (N) over velocity (m/s), a line and a band of 95 % intervals for each model.

    `curves[label]`: `curve`, its path; `velocity` (k,) m/s, the knots; `force`, `low` and `high` (k,) N; `reached`:
    (low, high) m/s. Nothing is drawn beyond what was reached. `measured[label]`: points of curves that were measured by
    other means, `velocity` (k,) m/s and `force` (k,) N.
    """
    table = TidyTable("model", VELOCITY, FORCE, LOW, HIGH)
    labels, traces = list(curves), []
    for label, curve in curves.items():
        block = _within(curve)
        drawn = table.add({"model": label} | block)
        traces += [_band(label, block, labels), _line(label, drawn, labels)]
    for label, curve in (measured or {}).items():
        traces.append(_points(label, table.add({"model": label, VELOCITY: curve["velocity"], FORCE: curve["force"]})))
    groups = [toggles.series_group(labels, measured="point" if measured else "")]
    caption = (
        ("Points: measured by other means. " if measured else "")
        + "Compression is positive. Lines: identified or, without a band, known, with markers at the knots and at the "
        "ends of what was reached; bands: 95 % intervals of each knot, the structure of the model taken as right. "
        "Velocities that the runs did not reach are not drawn."
    )
    axes = {"xaxis": axis(VELOCITY, zeroline=True), "yaxis": axis(FORCE, zeroline=True)}
    plot = {"data": toggles.apply(traces, groups), "layout": layout(420, **axes, meta={"toggles": groups})}
    return Figure("Damper curves over the velocities that were excited", caption, plot, table.columns)


def _within(curve: Mapping[str, Any]) -> dict[str, Array]:
    """The curve at the ends of what was reached and at the knots between."""
    knots = np.asarray(curve["velocity"], dtype=float)
    low, high = np.clip(curve["reached"], knots[0], knots[-1])
    places = np.unique(np.concatenate([[low], knots[(knots > low) & (knots < high)], [high]]))
    keys = {FORCE: "force", LOW: "low", HIGH: "high"}
    return {VELOCITY: places} | {heading: np.interp(places, knots, curve[key]) for heading, key in keys.items()}


def _points(label: str, drawn: Mapping[str, Any]) -> dict[str, Any]:
    return {
        "type": "scatter",
        "mode": "markers",
        "name": plain(label),
        "text": plain(label),
        "meta": {"series": "measured"},
        "x": drawn[VELOCITY],
        "y": drawn[FORCE],
        "marker": {"size": 9, "color": "@measured", "symbol": "circle-open", "line": {"width": 1.8}},
        "hovertemplate": "%{text}<br>%{x:.3f} m/s, %{y:.3r} N<extra></extra>",
    }


def _band(label: str, block: Mapping[str, Array], labels: Sequence[str]) -> dict[str, Any]:
    color = series_color(label, labels)
    return {
        "type": "scatter",
        "mode": "lines",
        "name": f"{plain(label)}, interval",
        "meta": {"series": label},
        "x": [*block[VELOCITY], *block[VELOCITY][::-1]],
        "y": [*block[HIGH], *block[LOW][::-1]],
        "line": {"width": 0, "color": color},
        "fill": "toself",
        "fillcolor": color,
        "opacity": 0.25,
        "hoverinfo": "skip",
    }


def _line(label: str, drawn: Mapping[str, Any], labels: Sequence[str]) -> dict[str, Any]:
    return {
        "type": "scatter",
        "mode": "lines+markers",
        "name": plain(label),
        "text": plain(label),
        "meta": {"series": label},
        "x": drawn[VELOCITY],
        "y": drawn[FORCE],
        "line": {"color": series_color(label, labels), "width": 2},
        "marker": {"size": 6},
        "hovertemplate": "%{text}<br>%{x:.3f} m/s, %{y:.3r} N<extra></extra>",
    }
