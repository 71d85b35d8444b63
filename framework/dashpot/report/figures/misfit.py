"""Where the error is: frequency band by run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from dashpot.report.figures import toggles
from dashpot.report.parts import Figure
from dashpot.report.theme import HEAT, axis, axis_number, layout, plain

GAP = 0.04


def misfit_map(rows: Sequence[Mapping[str, Any]]) -> Figure:
    """RMS of the residual (N) over frequency band and run, a panel for each simulation, all on one colour scale.

    Each row: `run`, `band` (low, high) in Hz or a text, `rmse` {label: N}; a pair without a row stays empty.
    """
    runs = list(dict.fromkeys(row["run"] for row in rows))
    bands = list(dict.fromkeys(_band(row["band"]) for row in rows))
    labels = list(dict.fromkeys(label for row in rows for label in row["rmse"]))
    maps = [_matrix(rows, runs, bands, label) for label in labels]
    top = max((float(np.nanmax(each)) for each in maps if np.isfinite(each).any()), default=1.0)
    traces = [_panel(each, runs, bands, index, top) for index, each in enumerate(maps)]
    columns: dict[str, Any] = {"run": [row["run"] for row in rows], "band": [_band(row["band"]) for row in rows]}
    columns |= {_heading(label): [row["rmse"].get(label) for row in rows] for label in labels}
    return Figure(
        "Where the error is",
        "Root mean square of the residual in each frequency band of each run, in N.",
        {"data": traces, "layout": _layout(runs, labels)},
        columns,
    )


def _matrix(rows: Sequence[Mapping[str, Any]], runs: list[str], bands: list[str], label: str) -> np.ndarray:
    matrix = np.full((len(runs), len(bands)), np.nan)
    for row in rows:
        matrix[runs.index(row["run"]), bands.index(_band(row["band"]))] = row["rmse"].get(label, np.nan)
    return matrix


def _panel(matrix: np.ndarray, runs: list[str], bands: list[str], index: int, top: float) -> dict[str, Any]:
    return {
        "type": "heatmap",
        "x": [plain(band) for band in bands],
        "y": [plain(run) for run in runs],
        "z": matrix,
        "xaxis": axis_number("x", index),
        "yaxis": axis_number("y", index),
        "zmin": 0.0,
        "zmax": top,
        "colorscale": HEAT,
        "showscale": index == 0,
        "colorbar": {"title": {"text": "N", "side": "top"}, "thickness": 12, "outlinewidth": 0},
        "xgap": 2,
        "ygap": 2,
        "texttemplate": "%{z:.3g}",
        "hovertemplate": "%{y}, %{x}<br>%{z:.2f} N<extra></extra>",
        "hoverongaps": False,
    }


def _layout(runs: Sequence[str], labels: Sequence[str]) -> dict[str, Any]:
    width = (1.0 - GAP * (len(labels) - 1)) / max(1, len(labels))
    axes: dict[str, Any] = {}
    for index in range(len(labels)):
        domain = [index * (width + GAP), index * (width + GAP) + width]
        x, y = axis_number("x", index), axis_number("y", index)
        axes[axis_number("x", index, "axis")] = axis("frequency band", type="category", domain=domain, anchor=y)
        axes[axis_number("y", index, "axis")] = axis(type="category", anchor=x, autorange="reversed", **_shared(index))
    titles = [_title(label, index * (width + GAP) + width / 2.0) for index, label in enumerate(labels)]
    return layout(110 + 30 * len(runs), **axes, annotations=titles)


def _shared(index: int) -> dict[str, Any]:
    return {"matches": "y", "showticklabels": False} if index else {}


def _title(label: str, x: float) -> dict[str, Any]:
    place = {"x": x, "y": 1.0, "xref": "paper", "yref": "paper", "xanchor": "center", "yanchor": "bottom"}
    return {"text": plain(toggles.series_name(label)), "showarrow": False, **place}


def _band(band: tuple[float, float] | str) -> str:
    if isinstance(band, str):
        return band
    low, high = band
    return f"{low:.4g}–{high:.4g} Hz"


def _heading(label: str) -> str:
    return f"residual {toggles.series_name(label)} (N)"
