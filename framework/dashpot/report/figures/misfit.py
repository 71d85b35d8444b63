"""Where the error is: frequency band by run."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from dashpot.report.figures import toggles
from dashpot.report.parts import Figure
from dashpot.report.theme import HEAT, axis, axis_number, layout, plain

GAP = 0.04
ACROSS = 3
ROW_HEIGHT = 30
HEAD = 110  # pixels of a row of panels for titles and axes

Row = Mapping[str, Any]


def misfit_map(rows: Sequence[Row]) -> Figure:
    """RMS of the residual (N) over frequency band and run, a panel for each simulation, all on one colour scale.

    Each row: `run`, `band` (low, high) in Hz or a text, `rmse` {label: N}; a pair without a row stays empty. Where
    there is only one band the simulations stand side by side in a single panel.
    """
    runs = list(dict.fromkeys(row["run"] for row in rows))
    bands = sorted(dict.fromkeys(row["band"] for row in rows), key=_band_order)
    labels = list(dict.fromkeys(label for row in rows for label in row["rmse"]))
    names = [_band(band) for band in bands]
    columns: dict[str, Any] = {"run": [row["run"] for row in rows], "band": [_band(row["band"]) for row in rows]}
    columns |= {_heading(label): [row["rmse"].get(label) for row in rows] for label in labels}
    if len(bands) > 1:
        plot = _panels(
            {toggles.series_name(label): _by_band(rows, runs, names, label) for label in labels}, runs, names
        )
        where = "in each frequency band of each run"
    else:
        series = [toggles.series_name(label) for label in labels]
        plot = _panels({"": _by_label(rows, runs, labels)}, runs, series)
        where = "of each run"
    return Figure("Where the error is", f"Root mean square of the residual {where}, in N.", plot, columns)


def _by_band(rows: Sequence[Row], runs: Sequence[str], bands: Sequence[str], label: str) -> np.ndarray:
    matrix = np.full((len(runs), len(bands)), np.nan)
    for row in rows:
        matrix[runs.index(row["run"]), bands.index(_band(row["band"]))] = row["rmse"].get(label, np.nan)
    return matrix


def _by_label(rows: Sequence[Row], runs: Sequence[str], labels: Sequence[str]) -> np.ndarray:
    matrix = np.full((len(runs), len(labels)), np.nan)
    for row in rows:
        matrix[runs.index(row["run"])] = [row["rmse"].get(label, np.nan) for label in labels]
    return matrix


def _panels(maps: Mapping[str, np.ndarray], runs: Sequence[str], columns: Sequence[str]) -> dict[str, Any]:
    top = max((float(np.nanmax(each)) for each in maps.values() if np.isfinite(each).any()), default=1.0)
    traces = [_panel(each, runs, columns, index, top) for index, each in enumerate(maps.values())]
    return {"data": traces, "layout": _layout(len(runs), list(maps), "frequency band" if any(maps) else "")}


def _panel(matrix: np.ndarray, runs: Sequence[str], columns: Sequence[str], index: int, top: float) -> dict[str, Any]:
    return {
        "type": "heatmap",
        "x": [plain(column) for column in columns],
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
        "texttemplate": "%{z:.3r}",
        "hovertemplate": "%{y}, %{x}<br>%{z:.3r} N<extra></extra>",
        "hoverongaps": False,
    }


def _layout(runs: int, names: Sequence[str], title: str) -> dict[str, Any]:
    """Panels in rows of three; all share the runs."""
    across = min(ACROSS, max(1, len(names)))
    down = math.ceil(len(names) / across) or 1
    height = HEAD + ROW_HEIGHT * runs
    between = HEAD / (height * down)
    axes: dict[str, Any] = {}
    titles = []
    for index, name in enumerate(names):
        row, column = divmod(index, across)
        left, right = share(column, across, GAP)
        top, bottom = (1.0 - edge for edge in share(row, down, between))
        axes |= _panel_axes(index, title, (left, right), (bottom, top), first=column == 0)
        titles.append(_title(name, (left + right) / 2.0, top))
    return layout(height * down, **axes, annotations=titles)


def _panel_axes(
    index: int, title: str, across: tuple[float, float], down: tuple[float, float], first: bool
) -> dict[str, Any]:
    x, y = axis_number("x", index), axis_number("y", index)
    shared = {"matches": "y"} if index else {}
    horizontal = axis(title, type="category", domain=list(across), anchor=y)
    vertical = axis(type="category", domain=list(down), anchor=x, autorange="reversed", showticklabels=first, **shared)
    return {axis_number("x", index, "axis"): horizontal, axis_number("y", index, "axis"): vertical}


def share(index: int, count: int, gap: float) -> tuple[float, float]:
    """Where the panel number `index` of `count` begins and ends, with a `gap` between two of them, from 0 to 1."""
    width = (1.0 - gap * (count - 1)) / count
    return index * (width + gap), index * (width + gap) + width


def _title(name: str, x: float, y: float) -> dict[str, Any]:
    place = {"x": x, "y": y, "xref": "paper", "yref": "paper", "xanchor": "center", "yanchor": "bottom"}
    return {"text": plain(name), "showarrow": False, **place}


def _band_order(band: tuple[float, float] | str) -> tuple[float, str]:
    return (math.inf, band) if isinstance(band, str) else (band[0], "")


def _band(band: tuple[float, float] | str) -> str:
    if isinstance(band, str):
        return band
    low, high = band
    return f"{low:.4g}–{high:.4g} Hz"


def _heading(label: str) -> str:
    return f"residual {toggles.series_name(label)} (N)"
