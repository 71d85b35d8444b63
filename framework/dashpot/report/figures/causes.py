"""Which causes were found in which specimens."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from dashpot.report.grids import cause_title
from dashpot.report.parts import Figure
from dashpot.report.theme import HEAT, axis, layout, plain


def cause_map(model: str, causes: Sequence[Mapping[str, Any]]) -> Figure:
    """The probability of each cause (`title`, `place`, `probability` by specimen) in each specimen, as a heat map."""
    names = list(causes[0]["probability"])
    titles = [cause_title(cause) for cause in causes]
    matrix = np.array([[cause["probability"][name] for name in names] for cause in causes])
    trace = {
        "type": "heatmap",
        "x": [plain(name) for name in names],
        "y": [plain(title) for title in titles],
        "z": matrix,
        "zmin": 0.0,
        "zmax": 1.0,
        "colorscale": HEAT,
        "xgap": 1,
        "ygap": 1,
        "colorbar": {"title": {"text": "probability", "side": "top"}, "thickness": 12, "outlinewidth": 0},
        "hovertemplate": "%{x}: %{y}<br>%{z:.2f}<extra></extra>",
    }
    columns = {
        "cause": np.repeat(titles, len(names)),
        "specimen": np.tile(names, len(titles)),
        "probability": matrix.ravel(),
    }
    axes = {"xaxis": axis(type="category", tickangle=-60), "yaxis": axis(type="category", autorange="reversed")}
    plot = {"data": [trace], "layout": layout(150 + 28 * len(titles), **axes)}
    return Figure(f"Causes found from {model}", "The probability of each cause in each specimen.", plot, columns)
