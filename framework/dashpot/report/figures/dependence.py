"""A metric over what is varied: a line for each value of something else, and the band of specimens that scatter."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from dashpot.report.figures.tidy import TidyTable
from dashpot.report.parts import Figure
from dashpot.report.theme import axis, layout, ordered_color, plain, series_color


def metric_lines(
    title: str,
    over: tuple[str, Sequence[float]],
    heading: str,
    lines: Mapping[str, Sequence[float | None]],
    *,
    limit: float | None = None,
    ordered: bool = True,
    caption: str = "",
) -> Figure:
    """A line for each of the ``lines`` (values over ``over``, a heading and its values), a dashed one at the limit.

    ordered: whether the lines are values in order, whose colours follow it, or different things.
    """
    table = TidyTable("line", over[0], heading)
    labels, traces = list(lines), []
    for number, (label, values) in enumerate(lines.items()):
        color = ordered_color(number, len(labels)) if ordered else series_color(label, labels)
        block = table.add({"line": label, over[0]: _array(over[1]), heading: _array(values)})
        traces.append(_line(label, block[over[0]], block[heading], color))
    shown = layout(380, xaxis=axis(over[0]), yaxis=axis(heading, rangemode="tozero"), shapes=_limit(limit))
    return Figure(title, caption, {"data": traces, "layout": shown}, table.columns)


def metric_band(
    title: str,
    over: tuple[str, Sequence[float]],
    heading: str,
    band: Mapping[str, Sequence[float | None]],
    *,
    limit: float | None = None,
    measured: Sequence[float] = (),
    caption: str = "",
) -> Figure:
    """The ``low``, ``median`` and ``high`` of a band over ``over``; ``measured`` values are dotted lines."""
    table = TidyTable("line", over[0], heading)
    blocks = {key: table.add({"line": key, over[0]: _array(over[1]), heading: _array(band[key])}) for key in BAND}
    edge = {"mode": "lines", "line": {"width": 0, "color": "@after"}, "showlegend": False, "hoverinfo": "skip"}
    low, high = ({"type": "scatter", "x": blocks[k][over[0]], "y": blocks[k][heading], **edge} for k in ("low", "high"))
    filled = {"name": "9 of 10 specimens", "showlegend": True, "fill": "tonexty", "fillcolor": "@train", "opacity": 0.5}
    middle = _line("median", blocks["median"][over[0]], blocks["median"][heading], "@after")
    shapes = [*_limit(limit), *(_across(value, "@measured", "dot") for value in measured)]
    shown = layout(380, xaxis=axis(over[0]), yaxis=axis(heading, rangemode="tozero"), shapes=shapes)
    return Figure(title, caption, {"data": [low, {**high, **filled}, middle], "layout": shown}, table.columns)


BAND = ("low", "median", "high")


def _array(values: Sequence[float | None]) -> Any:
    return np.array([np.nan if value is None else value for value in values], dtype=float)


def _line(label: str, x: Any, y: Any, color: str) -> dict[str, Any]:
    return {
        "type": "scatter",
        "mode": "lines+markers",
        "name": plain(label),
        "x": x,
        "y": y,
        "line": {"color": color, "width": 1.8},
        "marker": {"color": color, "size": 6},
        "hovertemplate": f"{plain(label)}<br>%{{x:.4r}}<br>%{{y:.4r}}<extra></extra>",
    }


def _limit(limit: float | None) -> list[dict[str, Any]]:
    return [] if limit is None else [_across(limit, "@bad", "dash")]


def _across(value: float, color: str, dash: str) -> dict[str, Any]:
    line = {"color": color, "dash": dash, "width": 1.4}
    return {"type": "line", "xref": "paper", "x0": 0.0, "x1": 1.0, "y0": value, "y1": value, "line": line}
