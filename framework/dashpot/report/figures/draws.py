"""Draws from a posterior: their course, their ranks, and how parameters depend on one another."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from dashpot.report.evidence import Draws
from dashpot.report.figures.misfit import share
from dashpot.report.figures.tidy import TidyTable
from dashpot.report.parts import Figure
from dashpot.report.theme import axis, axis_number, layout, ordered_color, plain, shortened
from dashpot.text.digits import rig_unit

SHOWN = 6  # numbers in a figure
WALKERS, QUARTERS, BINS = 4, 4, 20
CLOUD = 600  # points of a panel
ACROSS, ROW, HEAD, GAP = 2, 130, 62, 0.09  # panels in a row; pixels of a panel and around it; share between two
CELL, LENGTH = 150, 24  # pixels of a panel of the corner plot; letters of a name beside it
STEP, RANK, COUNT = "step", "rank (% of the draws)", "draws over their expected number"


def draw_traces(draws: Draws) -> Figure:
    """A panel for each number: what some walkers drew over the steps."""
    names, table = _shown(draws), TidyTable(STEP, "walker", *_headings(draws))
    steps, walkers = draws["step"], draws["walker"]
    followed = np.unique(walkers)[:WALKERS]
    blocks = [table.add(_block(draws, walkers == walker)) for walker in followed]
    traces = [
        _line(index, blocks[k][STEP], blocks[k][_heading(draws, name)], ordered_color(k, WALKERS))
        for index, name in enumerate(names)
        for k in range(len(followed))
    ]
    axes = _panels(names, [f"({_unit(draws, name)[1] or '-'})" for name in names], STEP, steps[[0, -1]].tolist())
    caption = f"{_chosen(draws)}Lines: {len(followed)} of the {np.unique(walkers).size} walkers. "
    plot = {"data": traces, "layout": layout(**axes, showlegend=False)}
    return Figure(
        "Traces of the draws", caption + "Converged chains overlap, without a trend.", plot, table.columns, True
    )


def draw_ranks(draws: Draws) -> Figure:
    """A panel for each number: how the ranks of its draws are spread, for each quarter of the steps."""
    names, table = _shown(draws), TidyTable("parameter", "quarter", RANK, COUNT)
    traces = []
    for index, name in enumerate(names):
        for quarter, counts in enumerate(_rank_counts(draws["step"], draws["numbers"][name])):
            at = 100.0 * np.arange(BINS + 1) / BINS
            told = {"parameter": name, "quarter": quarter + 1, RANK: at, COUNT: [*counts, counts[-1]]}
            block = table.add(told)
            line = _line(index, block[RANK], block[COUNT], ordered_color(quarter, QUARTERS))
            traces.append({**line, "line": {**line["line"], "shape": "hv"}})
    axes = _panels(names, [""] * len(names), RANK, [0.0, 100.0], rangemode="tozero")
    caption = (
        f"{_chosen(draws)}Lines: the quarters of the steps, dark: the first. At rest they are level at 1, up to chance."
    )
    plot = {"data": traces, "layout": layout(**axes, showlegend=False)}
    return Figure("Ranks of the draws", caption, plot, table.columns, True)


def corner(draws: Draws) -> Figure:
    """How often numbers were drawn, on the diagonal, and pairs of them below; the fit is marked."""
    names, table = _shown(draws), TidyTable(*_headings(draws))
    some = np.linspace(0, draws["step"].size - 1, min(CLOUD, draws["step"].size)).round().astype(int)
    cloud = {key: values for key, values in _block(draws, some).items() if key not in (STEP, "walker")}
    block, size = table.add(cloud), len(names)
    traces, axes = list[dict[str, Any]](), dict[str, Any]()
    for row, name in enumerate(names):
        for column, other in enumerate(names[: row + 1]):
            panel = row * (row + 1) // 2 + column
            place = {"xaxis": axis_number("x", panel), "yaxis": axis_number("y", panel)}
            if row == column:
                traces += [{**trace, **place} for trace in _histogram(draws, name)]
            else:
                x, y = (block[_heading(draws, each)] for each in (other, name))
                traces += [{**trace, **place} for trace in _cloud(draws, (other, name), x, y)]
            axes |= _corner_axes(draws, panel, (row, column), names)
    plot = {"data": traces, "layout": layout(CELL * size + 80, **axes, showlegend=False, bargap=0.0)}
    caption = f"{_chosen(draws)}Diagonal: how often a value was drawn. Below: pairs of values. Orange: the fit."
    return Figure("Parameters in pairs", caption, plot, table.columns)


def _shown(draws: Draws) -> list[str]:
    return list(draws["numbers"])[:SHOWN]


def _chosen(draws: Draws) -> str:
    """Which of many numbers are shown."""
    left = len(draws["numbers"]) - SHOWN
    return f"The {SHOWN} parameters with the fewest effective draws, {left} others left out. " if left > 0 else ""


def _unit(draws: Draws, name: str) -> tuple[float, str]:
    return rig_unit(draws["units"][name], abs(float(np.median(draws["numbers"][name]))))


def _heading(draws: Draws, name: str) -> str:
    unit = _unit(draws, name)[1]
    return f"{name} ({unit})" if unit else name


def _headings(draws: Draws) -> list[str]:
    return [_heading(draws, name) for name in _shown(draws)]


def _in_unit(draws: Draws, name: str) -> np.ndarray:
    return _unit(draws, name)[0] * draws["numbers"][name]


def _block(draws: Draws, which: np.ndarray) -> dict[str, Any]:
    numbers = {_heading(draws, name): _in_unit(draws, name)[which] for name in _shown(draws)}
    return {STEP: draws["step"][which], "walker": draws["walker"][which], **numbers}


def _line(index: int, x: Mapping[str, Any], y: Mapping[str, Any], color: str) -> dict[str, Any]:
    return {
        "type": "scatter",
        "mode": "lines",
        "x": x,
        "y": y,
        "xaxis": axis_number("x", index),
        "yaxis": axis_number("y", index),
        "line": {"color": color, "width": 1.2},
        "hovertemplate": "%{x:.4g}: %{y:.4g}<extra></extra>",
    }


def _panels(
    names: Sequence[str], units: Sequence[str], x: str, reach: Sequence[float], **upright: Any
) -> dict[str, Any]:
    """Height and axes of panels in rows, each with the name of its number above."""
    down, across = math.ceil(len(names) / ACROSS), min(ACROSS, len(names))
    height = down * (ROW + HEAD) + 40
    axes: dict[str, Any] = {"height": height, "annotations": []}
    for index, (name, unit) in enumerate(zip(names, units, strict=True)):
        row, column = divmod(index, ACROSS)
        wide = share(column, across, GAP)
        top, bottom = (1.0 - edge for edge in share(row, down, HEAD / height))
        last = index + ACROSS >= len(names)
        beside = {"domain": list(wide), "anchor": axis_number("y", index), "range": list(reach)}
        axes[axis_number("x", index, "axis")] = axis(x if last else "", **beside)
        axes[axis_number("y", index, "axis")] = axis(
            unit, domain=[bottom, top], anchor=axis_number("x", index), **upright
        )
        place = {"x": sum(wide) / 2.0, "y": top, "xref": "paper", "yref": "paper", "yanchor": "bottom"}
        axes["annotations"].append({"text": plain(name), "xanchor": "center", "showarrow": False, **place})
    return axes


def _rank_counts(steps: np.ndarray, numbers: np.ndarray) -> list[np.ndarray]:
    """For each quarter of the steps: the draws in each bin of ranks over those that are expected there."""
    ranks = np.argsort(np.argsort(numbers, kind="stable"), kind="stable")
    bins, quarter = ranks * BINS // ranks.size, np.searchsorted(np.unique(steps), steps) * QUARTERS
    quarter = quarter // np.unique(steps).size
    counts = [np.bincount(bins[quarter == k], minlength=BINS) for k in range(QUARTERS)]
    return [count * BINS / max(count.sum(), 1) for count in counts]


def _histogram(draws: Draws, name: str) -> list[dict[str, Any]]:
    counts, edges = np.histogram(_in_unit(draws, name), bins=BINS)
    fitted = _unit(draws, name)[0] * draws["fitted"][name]
    bars = {
        "type": "bar",
        "x": (edges[1:] + edges[:-1]) / 2.0,
        "y": counts,
        "marker": {"color": "@after", "opacity": 0.5},
        "hovertemplate": "%{x:.4g}: %{y}<extra></extra>",
    }
    line = {
        "type": "scatter",
        "mode": "lines",
        "x": [fitted, fitted],
        "y": [0, int(counts.max())],
        "line": {"color": "@before", "width": 2},
        "hovertemplate": "fit: %{x:.4g}<extra></extra>",
    }
    return [bars, line]


def _cloud(draws: Draws, pair: tuple[str, str], x: Mapping[str, Any], y: Mapping[str, Any]) -> list[dict[str, Any]]:
    fit = [[_unit(draws, name)[0] * draws["fitted"][name]] for name in pair]
    points = {
        "type": "scatter",
        "mode": "markers",
        "x": x,
        "y": y,
        "marker": {"color": "@after", "size": 3, "opacity": 0.4},
        "hovertemplate": "%{x:.4g}, %{y:.4g}<extra></extra>",
    }
    marker = {"color": "@before", "size": 9, "symbol": "cross"}
    return [points, {**points, "x": fit[0], "y": fit[1], "marker": marker}]


def _corner_axes(draws: Draws, panel: int, place: tuple[int, int], names: Sequence[str]) -> dict[str, Any]:
    row, column = place
    size, gap = len(names), 0.03
    wide, (top, bottom) = share(column, size, gap), (1.0 - edge for edge in share(row, size, gap))
    below, left = row == size - 1, column == 0 and row > 0
    units = [_unit(draws, names[k])[1] or "-" for k in (column, row)]
    titles = [f"{plain(shortened(names[k], LENGTH))}<br>({unit})" for k, unit in zip((column, row), units, strict=True)]
    x = {"domain": list(wide), "anchor": axis_number("y", panel), "showticklabels": below, "nticks": 4}
    y = {"domain": [bottom, top], "anchor": axis_number("x", panel), "showticklabels": left, "nticks": 4}
    return {
        axis_number("x", panel, "axis"): axis(titles[0] if below else "", **x, range=_reach(draws, names[column])),
        axis_number("y", panel, "axis"): axis(
            titles[1] if left else "",
            **y,
            **({} if row == column else {"range": _reach(draws, names[row])}),
        ),
    }


def _reach(draws: Draws, name: str) -> list[float]:
    numbers = _in_unit(draws, name)
    low, high = float(numbers.min()), float(numbers.max())
    margin = 0.04 * (high - low) or 1e-9 * abs(high)
    return [low - margin, high + margin]
