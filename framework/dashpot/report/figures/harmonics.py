"""What the residual is made of: its harmonics of the excitation."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from dashpot.report.figures import toggles
from dashpot.report.figures.tidy import TidyTable
from dashpot.report.parts import Figure
from dashpot.report.theme import axis, axis_number, layout, plain, series_color, shortened

ACROSS = 4
ORDER = "order"
ROW_HEIGHT = 190
GAP_X = 0.03
TITLE_LENGTH = 28


def harmonic_bars(harmonics: Mapping[str, Mapping[str, Sequence[float]]], series: Sequence[str] = ()) -> Figure:
    """Amplitude (N) of the residual's harmonics 1, 2, ... of the excitation, a small panel for each group.

    `harmonics[label][group]` holds the amplitudes (orders,) in N; groups are runs, amplitudes or whatever tells
    causes apart; labels are "before", "after" or names of models. Those in `series` are drawn at first, or all.
    """
    labels = list(harmonics)
    groups = list(dict.fromkeys(group for each in harmonics.values() for group in each))
    table = TidyTable("group", ORDER, *map(_heading, labels))
    traces = []
    for panel, group in enumerate(groups):
        amplitudes = {label: harmonics[label][group] for label in labels if group in harmonics[label]}
        orders = range(1, 1 + max(map(len, amplitudes.values())))
        block = table.add({"group": group, ORDER: list(orders)} | {_heading(k): v for k, v in amplitudes.items()})
        traces += [_bars(group, label, block, panel, labels) for label in amplitudes]
    buttons = [toggles.series_group(labels, measured="", mark="bar", series=series)]
    return Figure(
        "Harmonics of the residual",
        "Odd harmonics come from laws that are symmetric in both directions, even ones from asymmetric laws.",
        {"data": toggles.apply(traces, buttons), "layout": _layout(groups, buttons)},
        table.columns,
    )


def _bars(group: str, label: str, block: Mapping[str, Any], panel: int, labels: Sequence[str]) -> dict[str, Any]:
    return {
        "type": "bar",
        "name": plain(toggles.series_name(label)),
        "text": plain(f"{group}, {toggles.series_name(label)}"),
        "textposition": "none",
        "meta": {"series": label},
        "x": block[ORDER],
        "y": block[_heading(label)],
        "xaxis": axis_number("x", panel),
        "yaxis": axis_number("y", panel),
        "marker": {"color": series_color(label, labels)},
        "hovertemplate": "%{text}<br>harmonic %{x}: %{y:.3r} N<extra></extra>",
    }


def _layout(groups: Sequence[str], buttons: list[dict[str, Any]]) -> dict[str, Any]:
    across = min(ACROSS, max(1, len(groups)))
    down = math.ceil(len(groups) / across)
    axes: dict[str, Any] = {}
    titles = []
    for panel, group in enumerate(groups):
        row, column = divmod(panel, across)
        left, right = _share(column, across, GAP_X)
        top, bottom = (1.0 - edge for edge in _share(row, down, 0.36 / down))
        axes |= _panel_axes(panel, (left, right), (bottom, top), first=column == 0)
        titles.append(_title(group, (left + right) / 2.0, top))
    return layout(90 + ROW_HEIGHT * down, **axes, annotations=titles, barmode="group", meta={"toggles": buttons})


def _panel_axes(
    panel: int, across: tuple[float, float], down: tuple[float, float], first: bool
) -> dict[str, dict[str, Any]]:
    shared = {"matches": "y"} if panel else {}
    x, y = axis_number("x", panel), axis_number("y", panel)
    horizontal = axis(domain=list(across), anchor=y, dtick=1, showgrid=False)
    vertical = axis("N" if first else "", domain=list(down), anchor=x, showticklabels=first, **shared)
    return {axis_number("x", panel, "axis"): horizontal, axis_number("y", panel, "axis"): vertical}


def _share(index: int, count: int, gap: float) -> tuple[float, float]:
    width = (1.0 - gap * (count - 1)) / count
    return index * (width + gap), index * (width + gap) + width


def _title(group: str, x: float, y: float) -> dict[str, Any]:
    place = {"x": x, "y": y, "xref": "paper", "yref": "paper", "xanchor": "center", "yanchor": "bottom"}
    return {"text": plain(shortened(group, TITLE_LENGTH)), "showarrow": False, "font": {"size": 12}, **place}


def _heading(label: str) -> str:
    return f"residual {toggles.series_name(label)} (N)"
