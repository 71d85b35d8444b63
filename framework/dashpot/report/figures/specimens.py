"""A number of a model on every specimen, with its interval, against the population."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from dashpot.report.parts import Figure
from dashpot.report.theme import axis, layout, plain
from dashpot.text.digits import rig_unit

SOUND, NAMED = "population", "outlier"
TWO = 2.0  # standard deviations between specimens, about 95 % of them


def number_over(number: Mapping[str, Any], points: Sequence[Mapping[str, Any]], over: str = "") -> Figure:
    """A number over the specimens, or over one of their properties.

    ``number``: `parameter`, `unit`, `mean` (SI), `scatter` between specimens, `relative`. Each of ``points``:
    `specimen`, `value` and `interval` (SI), `named` (bool) and `at`, the value of the property or the name.
    """
    factor, unit = rig_unit(number["unit"], abs(number["mean"]))
    heading = f"{number['parameter']} ({unit})" if unit else number["parameter"]
    columns = {
        "specimen": [point["specimen"] for point in points],
        over or "place": [point["at"] for point in points],
        heading: [factor * point["value"] for point in points],
        "from": [factor * point["interval"][0] for point in points],
        "to": [factor * point["interval"][1] for point in points],
        "is": [NAMED if point["named"] else SOUND for point in points],
    }
    traces = [_points(columns, heading, over or "place", kind) for kind in (SOUND, NAMED)]
    band = {"shapes": _band(number, factor)} if not over else {}
    names = [plain(point["specimen"]) for point in points]
    in_order: dict[str, Any] = {"categoryorder": "array", "categoryarray": names}
    across = axis(over) if over else axis(type="category", tickangle=-60, showgrid=False, **in_order)
    caption = "Bars are the 95 % interval of each specimen."
    if not over:
        caption += " The band holds about 95 % of the specimens: the mean and two standard deviations between them."
    shown = layout(360, xaxis=across, yaxis=axis(heading), **band)
    title = f"{number['parameter']} over {over}" if over else number["parameter"]
    return Figure(title, caption, {"data": [trace for trace in traces if trace["x"]], "layout": shown}, columns)


def _points(columns: Mapping[str, Sequence[Any]], heading: str, over: str, kind: str) -> dict[str, Any]:
    mine = [k for k, word in enumerate(columns["is"]) if word == kind]
    at, low, high = (np.array([columns[key][k] for k in mine], dtype=float) for key in (heading, "from", "to"))
    return {
        "type": "scatter",
        "mode": "markers",
        "name": kind,
        "x": [plain(columns[over][k]) if isinstance(columns[over][k], str) else columns[over][k] for k in mine],
        "y": at.tolist(),
        "text": [plain(columns["specimen"][k]) for k in mine],
        "marker": {
            "size": 8,
            "color": "@after" if kind == SOUND else "@bad",
            "symbol": "circle" if kind == SOUND else "x",
        },
        "error_y": {
            "type": "data",
            "symmetric": False,
            "array": (high - at).tolist(),
            "arrayminus": (at - low).tolist(),
            "thickness": 1.2,
            "width": 0,
        },
        "hovertemplate": "%{text}<br>%{y:.4r}<extra></extra>",
    }


def _band(number: Mapping[str, Any], factor: float) -> list[dict[str, Any]]:
    mean, scatter = number["mean"], TWO * number["scatter"]
    low, high = mean * np.exp([-scatter, scatter]) if number["relative"] else mean + np.array([-scatter, scatter])
    whole = {"xref": "paper", "x0": 0.0, "x1": 1.0, "layer": "below"}
    return [
        {"type": "rect", **whole, "y0": factor * low, "y1": factor * high, "fillcolor": "@grid", "line": {"width": 0}},
        {"type": "line", **whole, "y0": factor * mean, "y1": factor * mean, "line": {"color": "@soft", "dash": "dash"}},
    ]
