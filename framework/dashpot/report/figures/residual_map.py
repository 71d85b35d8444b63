"""The mean residual over the two variables that explain it best."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from dashpot.report.figures import toggles
from dashpot.report.parts import Figure
from dashpot.report.readable import percent
from dashpot.report.theme import axis, layout
from dashpot.text.digits import beside, number

SIGNED = [[0.0, "@after"], [0.5, "@paper"], [1.0, "@before"]]
# of their reach, and of the larger one: an axis is as long as twenty of its labels are high, and numbers with two
# digits differ by no less
NEAR = 0.05
LITTLE = 0.05  # of the mean square of the residual: less is told as such
IN_RIG_UNITS = {"m": (1e3, "mm"), "m/s": (1e3, "mm/s")}


def residual_map(told: Mapping[str, Any]) -> Figure:
    """Mean residual (N) over two variables: `label`, `x` and `y` (`name`, `unit`, `edges`), `mean` (ny, nx) N.

    `explained` is the share of the mean square of the residual that the map predicts on other stretches of the runs,
    `singles` that of each variable alone.
    """
    (x_name, x), (y_name, y) = (_axis_of(told[which]) for which in ("x", "y"))
    mean = np.asarray(told["mean"], dtype=float)
    top = float(np.nanmax(np.abs(mean)))
    trace = {
        "type": "heatmap",
        "x": np.arange(x.size),
        "y": np.arange(y.size),
        "z": mean,
        "zmin": -top,
        "zmax": top,
        "colorscale": SIGNED,
        "colorbar": {"title": {"text": "N", "side": "top"}, "thickness": 12, "outlinewidth": 0},
        "text": [[f"{x_name} {wide}<br>{y_name} {high}" for wide in _ranges(x)] for high in _ranges(y)],
        "hovertemplate": "%{text}<br>%{z:.3r} N<extra></extra>",
        "hoverongaps": False,
    }
    best = sorted(told["singles"].items(), key=lambda item: -item[1])[:3]
    alone = ", ".join(f"{name.replace('_', ' ')} {percent(max(share, 0.0))}" for name, share in best)
    share = max(told["explained"], 0.0)
    best_two = "These two variables predict" if share >= LITTLE else "No two variables predict more than"
    caption = (
        "Measured minus simulated force, mean of each cell; positive: the force of the model is too small. "
        f"{best_two} {percent(share)} of the mean square of the residual on other pieces of the runs; alone: {alone}. "
        "Held-out runs take no part. "
        "Every row and every column holds the same number of samples."
    )
    axes = {
        which: axis(
            name,
            zeroline=False,
            showgrid=False,
            tickvals=places,
            ticktext=_ticks(edges[places]),
        )
        for which, name, edges in (("xaxis", x_name, x), ("yaxis", y_name, y))
        for places in [told_apart(edges)]
    }
    wide, high = (0.5 * (edges[1:] + edges[:-1]) for edges in (x, y))
    columns = {x_name: np.tile(wide, high.size), y_name: np.repeat(high, wide.size), "mean residual (N)": mean.ravel()}
    plot = {"data": [trace], "layout": layout(440, **axes)}
    return Figure(f"Residual of {toggles.series_name(told['label'])}", caption, plot, columns)


def told_apart(edges: np.ndarray, places: Sequence[int] | None = None) -> list[int]:
    """Those of the places of edges that are told at ticks: none whose edge reads like that of the tick before.

    Where many samples lie close together, as at the reversals of a motion, many edges do.
    """
    places = range(edges.size) if places is None else places
    told = [places[0]]
    for place in places[1:]:
        before, here = float(edges[told[-1]]), float(edges[place])
        if here - before > NEAR * min(float(np.ptp(edges)), max(abs(before), abs(here))):
            told.append(place)
    return told


def _ranges(edges: np.ndarray) -> list[str]:
    return [f"{number(low)} to {number(high)}" for low, high in zip(edges, edges[1:], strict=False)]


def _ticks(edges: np.ndarray) -> list[str]:
    """The edges with two digits, or as many more as are needed to distinguish them."""
    shown = [[number(edge, digits) for edge in edges] for digits in (2, 3, 4)]
    return next((texts for texts in shown if len(set(texts)) == len(texts)), shown[-1])


def _axis_of(variable: Mapping[str, Any]) -> tuple[str, np.ndarray]:
    factor, unit = IN_RIG_UNITS.get(variable["unit"], (1.0, variable["unit"]))
    name = variable["name"].replace("_", " ")
    edges = factor * np.asarray(variable["edges"], dtype=float)
    largest = float(np.max(np.abs(edges)))
    return (f"{name} ({unit})" if unit else name), np.array([beside(edge, largest) for edge in edges])
