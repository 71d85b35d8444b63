"""A figure as JSON: short numbers, no NaN, references to columns resolved where the reader is a plain plotly."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from dashpot.report.library import require_plotly
from dashpot.report.parts import Figure
from dashpot.report.theme import LIGHT

if TYPE_CHECKING:
    from plotly.graph_objects import Figure as PlotlyFigure

DIGITS = 6


def plot_json(figure: Figure) -> dict[str, Any]:
    """What the page embeds: `title`, `data`, `layout` and the columns (see `column_json`)."""
    columns = {heading: column_json(values) for heading, values in figure.columns.items()}
    return {"title": figure.title, "columns": columns, **compact(dict(figure.plot))}


def column_json(values: Any) -> list[Any] | dict[str, Any]:
    """A column of numbers as a list, a column with texts as `{"repeat": [[value, count], ...]}`."""
    cells = compact(values.tolist() if isinstance(values, np.ndarray) else list(values))
    if not any(isinstance(cell, str) for cell in cells):
        return cells
    return {"repeat": [[value, len(list(same))] for value, same in itertools.groupby(cells)]}


def compact(item: Any) -> Any:
    """Numbers with six significant digits, NaN and infinity as null, arrays as lists."""
    if isinstance(item, float):  # by far the most frequent
        return _short(item)
    if isinstance(item, np.ndarray | np.generic):
        return compact(item.tolist())
    if isinstance(item, list | tuple):
        return [compact(value) for value in item]
    if isinstance(item, Mapping):
        return {key: compact(value) for key, value in item.items()}
    return item


def plotly_figure(figure: Figure) -> PlotlyFigure:
    """The same plot for a notebook, in the light colours. InputError where plotly is not installed."""
    require_plotly()
    from plotly.graph_objects import Figure as PlotlyFigure

    return PlotlyFigure(_resolve(dict(figure.plot), figure.columns))


def _short(value: float) -> float | int | None:
    if not math.isfinite(value):
        return None
    short = float(f"{value:.{DIGITS}g}")
    return int(short) if short.is_integer() and abs(short) < 1e15 else short


def _resolve(item: Any, columns: Mapping[str, Any], key: str = "") -> Any:
    if isinstance(item, Mapping) and item.keys() == {"column", "rows"}:
        start, stop = item["rows"]
        return list(columns[item["column"]][start:stop])
    if isinstance(item, Mapping):
        return {name: _resolve(value, columns, name) for name, value in item.items()}
    if isinstance(item, list | tuple):
        return [_resolve(value, columns, key) for value in item]
    is_color = isinstance(item, str) and item.startswith("@") and key.endswith(("color", "colorscale"))
    return LIGHT[item[1:]] if is_color else item
