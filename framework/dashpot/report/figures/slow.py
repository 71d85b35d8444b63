"""Slow curves of an axle: in phase at both wheels, and in anti-phase."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from dashpot.report.figures import toggles
from dashpot.report.figures.tidy import TidyTable
from dashpot.report.parts import Figure
from dashpot.report.theme import axis, axis_number, layout, plain, series_color

TRAVEL, FORCE, WIDTH = "wheel travel from its middle (mm)", "force (N)", "friction force (N)"
PANELS = {"left": "left wheel, in phase", "right": "right wheel, in phase", "roll": "anti-phase, half the difference"}
GAP = 0.05


def slow_curves(curves: Mapping[str, Mapping[str, Mapping[str, np.ndarray]]]) -> Figure:
    """Elastic force (N) and half the width of the loop (N) over wheel travel (mm).

    `curves[label][part]`, the labels "measured" and the names of models, the parts "left", "right" and "roll", hold
    `deflection` (n,) m, `force` (n,) N and `half_width` (n,) N.
    """
    labels = list(curves)
    parts = [part for part in PANELS if any(part in each for each in curves.values())]
    table = TidyTable("curve", "of", TRAVEL, FORCE, WIDTH)
    traces = []
    for label, each in curves.items():
        for panel, part in enumerate(part for part in parts if part in each):
            block = table.add(
                {
                    "curve": PANELS[part],
                    "of": label,
                    TRAVEL: 1e3 * _from_middle(each[part]["deflection"]),
                    FORCE: each[part]["force"],
                    WIDTH: each[part]["half_width"],
                }
            )
            traces += [
                _trace(label, block, what, panel + level * len(parts), labels)
                for level, what in enumerate((FORCE, WIDTH))
            ]
    groups = [toggles.series_group([label for label in labels if label != "measured"], mark="solid")]
    plot = {"data": toggles.apply(traces, groups), "layout": _layout(parts, groups)}
    caption = (
        "Above: the elastic force, friction and its bias near the ends taken out. Below: the friction force, half the "
        "width of the loop, with the damping at this speed. Simulated curves went through the same evaluation."
    )
    return Figure("Slow curves of the axle", caption, plot, table.columns)


def _trace(label: str, block: Mapping[str, Any], what: str, cell: int, labels: Sequence[str]) -> dict[str, Any]:
    models = [other for other in labels if other != "measured"]
    return {
        "type": "scatter",
        "mode": "lines",
        "name": plain(label),
        "text": plain(label),
        "meta": {"series": label},
        "x": block[TRAVEL],
        "y": block[what],
        "xaxis": axis_number("x", cell),
        "yaxis": axis_number("y", cell),
        "line": {"color": series_color(label, models), "width": 2.4 if label == "measured" else 1.6},
        "hovertemplate": "%{text}<br>%{x:.1f} mm, %{y:.4r} N<extra></extra>",
    }


def _from_middle(travel: np.ndarray) -> np.ndarray:
    return travel - 0.5 * (travel[0] + travel[-1])


def _layout(parts: Sequence[str], groups: list[dict[str, Any]]) -> dict[str, Any]:
    width = (1.0 - GAP * (len(parts) - 1)) / len(parts)
    axes: dict[str, Any] = {}
    titles = []
    for panel, part in enumerate(parts):
        left = panel * (width + GAP)
        for level, (title, domain) in enumerate((("force (N)", [0.45, 0.98]), ("friction force (N)", [0.0, 0.35]))):
            cell = panel + level * len(parts)
            axes[axis_number("x", cell, "axis")] = axis(
                TRAVEL if level else "",
                domain=[left, left + width],
                anchor=axis_number("y", cell),
                showticklabels=bool(level),
                zeroline=False,
            )
            axes[axis_number("y", cell, "axis")] = axis(
                title if panel == 0 else "",
                domain=domain,
                anchor=axis_number("x", cell),
                **({"rangemode": "tozero"} if level else {}),
            )
        place = {"x": left + width / 2.0, "y": 1.0, "xref": "paper", "yref": "paper"}
        titles.append({"text": PANELS[part], "showarrow": False, "xanchor": "center", "yanchor": "bottom", **place})
    return layout(560, **axes, annotations=titles, meta={"toggles": groups})
