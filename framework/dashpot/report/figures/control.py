"""The control chart of a number: means of batches between their limits."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from dashpot.report.parts import Figure
from dashpot.report.theme import axis, layout, plain
from dashpot.text.digits import rig_unit

LIMITS = {"low": "lower limit", "high": "upper limit"}


def control_chart(chart: Mapping[str, Any]) -> Figure:
    """Means of batches in their order with limits of three standard errors; see ``campaign.charts``."""
    factor, unit = rig_unit(chart["unit"], abs(chart["center"]))
    heading = f"{chart['parameter']} ({unit})" if unit else chart["parameter"]
    batches = chart["batches"]
    columns: dict[str, list[Any]] = {"batch": [plain(each["batch"]) for each in batches]}
    columns |= {heading: [factor * each["mean"] for each in batches]}
    columns |= {name: [factor * each[key] for each in batches] for key, name in LIMITS.items()}
    columns |= {"specimens": [each["count"] for each in batches]}
    names = columns["batch"]
    lines = [
        {
            "type": "scatter",
            "mode": "lines",
            "name": name,
            "x": names,
            "y": columns[name],
            "line": {"color": "@warning", "dash": "dash", "shape": "hvh", "width": 1.4},
            "hovertemplate": f"{name} %{{y:.4r}}<extra></extra>",
        }
        for name in LIMITS.values()
    ]
    marks = ["@bad" if each["outside"] else "@after" for each in batches]
    means = {
        "type": "scatter",
        "mode": "lines+markers",
        "name": "mean of the batch",
        "x": names,
        "y": columns[heading],
        "line": {"color": "@soft", "width": 1.0},
        "marker": {"size": 9, "color": marks},
        "hovertemplate": "%{x}<br>%{y:.4r}<extra></extra>",
    }
    outside = [each["batch"] for each in batches if each["outside"]]
    caption = "Limits are three standard errors of a mean, by the scatter within batches. " + (
        f"Outside: {', '.join(outside)}." if outside else "No batch is outside."
    )
    shown = layout(300, xaxis=axis("batch", type="category"), yaxis=axis(heading))
    plot = {"data": [*lines, means], "layout": shown}
    return Figure(f"Control chart of {chart['parameter']}", caption, plot, columns)
