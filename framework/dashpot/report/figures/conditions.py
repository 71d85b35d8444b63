"""Stiffness and loss over the conditions of the tests: amplitude, preload, settings, order."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from dashpot.data.declaration import SETTING_UNITS
from dashpot.report.figures import toggles
from dashpot.report.figures.tidy import TidyTable
from dashpot.report.parts import Figure
from dashpot.report.theme import axis, axis_number, layout, plain, series_color

ROWS = (("stiffness", "stiffness (N/mm)", [0.55, 1.0]), ("loss", "loss stiffness (N/mm)", [0.0, 0.45]))
IN_MM = tuple(name for name, unit in SETTING_UNITS.items() if unit == "m")
PANELS = 5
GAP = 0.05


def over_conditions(rows: Sequence[Mapping[str, Any]], series: Sequence[str] = ()) -> Figure | None:
    """A point for each run and label: `{run, label, conditions, stiffness, loss}`, N/m; None where nothing varies.

    A panel for each of the first five conditions that vary. Those of one level have the same value in all rows.
    """
    names = [name for name in dict.fromkeys(name for row in rows for name in row["conditions"]) if _varies(name, rows)]
    if not names:
        return None
    labels = list(dict.fromkeys(row["label"] for row in rows if row["label"] != "measured"))
    names = names[:PANELS]
    table = TidyTable("run", "series", *map(_heading, names), *(title for _, title, _ in ROWS))
    traces = []
    for label in ["measured", *labels]:
        block = table.add(_block(label, [row for row in rows if row["label"] == label], names))
        traces += [
            _trace(label, labels, block, name, panel, level, len(names))
            for panel, name in enumerate(names)
            for level in range(len(ROWS))
        ]
    groups = [toggles.series_group(labels, measured="point", mark="point", series=series)] if labels else []
    plot = {"data": toggles.apply(traces, groups) if groups else traces, "layout": _layout(names, groups)}
    caption = (
        "A point for each run with closed cycles: above the slope of force over deflection, below energy per cycle "
        "over pi times amplitude squared, which falls with amplitude where there is friction. What changes with the "
        "order of tests alone is wear, warming or bedding in."
    )
    return Figure("By amplitude, preload, setting and order", caption, plot, table.columns)


def _varies(name: str, rows: Sequence[Mapping[str, Any]]) -> bool:
    values = [row["conditions"][name] for row in rows if name in row["conditions"]]
    # a middle that moves by less than a tenth of the amplitude is no preload
    least = 0.1 * max(row["conditions"]["amplitude"] for row in rows) if name == "preload" else 0.0
    return max(values) - min(values) > least


def _block(label: str, rows: Sequence[Mapping[str, Any]], names: Sequence[str]) -> dict[str, Any]:
    conditions = {
        _heading(name): _factor(name) * np.array([row["conditions"].get(name, np.nan) for row in rows])
        for name in names
    }
    values = {title: 1e-3 * np.array([row[key] for row in rows]) for key, title, _ in ROWS}
    return {"run": np.array([row["run"] for row in rows], dtype=object), "series": label} | conditions | values


def _trace(
    label: str, labels: Sequence[str], block: Mapping[str, Any], name: str, panel: int, level: int, panels: int
) -> dict[str, Any]:
    cell = panel + level * panels
    title = ROWS[level][1]
    return {
        "type": "scatter",
        "mode": "markers",
        "name": plain(toggles.series_name(label)),
        "text": block["run"],
        "meta": {"series": label},
        "x": block[_heading(name)],
        "y": block[title],
        "xaxis": axis_number("x", cell),
        "yaxis": axis_number("y", cell),
        "showlegend": False,
        "marker": {
            "color": series_color(label, labels),
            "size": 9 if label == "measured" else 6,
            "opacity": 0.7,
            "symbol": "circle-open" if label == "measured" else "circle",
        },
        "hovertemplate": f"%{{text}}<br>{_heading(name)} %{{x:.4r}}<br>{title} %{{y:.4r}}<extra></extra>",
    }


def _layout(names: Sequence[str], groups: list[dict[str, Any]]) -> dict[str, Any]:
    width = (1.0 - GAP * (len(names) - 1)) / len(names)
    axes: dict[str, Any] = {}
    for panel, name in enumerate(names):
        left = panel * (width + GAP)
        for level, (_, title, domain) in enumerate(ROWS):
            cell = panel + level * len(names)
            axes[axis_number("x", cell, "axis")] = axis(
                _heading(name) if level else "",
                domain=[left, left + width],
                anchor=axis_number("y", cell),
                showticklabels=bool(level),
                zeroline=False,
            )
            shared = {"matches": axis_number("y", level * len(names))} if panel else {}
            axes[axis_number("y", cell, "axis")] = axis(
                "" if panel else title,
                domain=domain,
                anchor=axis_number("x", cell),
                showticklabels=panel == 0,
                rangemode="tozero",
                **shared,
            )
    return layout(520, **axes, meta={"toggles": groups})


def _heading(name: str) -> str:
    unit = "mm" if name in IN_MM else SETTING_UNITS.get(name)
    return f"{name.replace('_', ' ')} ({unit})" if unit else name.replace("_", " ")


def _factor(name: str) -> float:
    return 1e3 if name in IN_MM else 1.0
