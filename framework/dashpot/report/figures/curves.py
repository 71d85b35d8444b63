"""Identified curves: tables of a network with their knots and the intervals of these."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from dashpot.report.evidence import IdentifiedCurve
from dashpot.report.figures.misfit import share
from dashpot.report.figures.tidy import TidyTable
from dashpot.report.parts import Figure
from dashpot.report.theme import axis, axis_number, layout, plain
from dashpot.text.digits import rig_unit

ACROSS, ROW, HEAD, GAP = 3, 220, 112, 0.09  # panels in a row; pixels of a panel and around it; share between two
LONG = 20  # characters
AT, VALUE, LOW, HIGH = "at", "value", "95 % from", "to"


def identified_curves(curves: Mapping[str, IdentifiedCurve]) -> Figure:
    """A panel for each curve, by its path in the network: a line through its knots, a band of their 95 % intervals."""
    table = TidyTable("curve", AT, "unit of at", VALUE, LOW, HIGH, "unit")
    down = math.ceil(len(curves) / ACROSS)
    height = down * (ROW + HEAD)
    traces, axes, titles = list[dict[str, Any]](), dict[str, Any](), list[dict[str, Any]]()
    for index, (path, curve) in enumerate(curves.items()):
        block, units = _in_rig_units(path, curve)
        traces += _traces(index, block, table.add(block), units)
        row, column = divmod(index, ACROSS)
        across = share(column, min(ACROSS, len(curves)), GAP)
        top, bottom = (1.0 - edge for edge in share(row, down, HEAD / height))
        axes |= _axes(index, (curve["over"], curve["told"]), units, across, (bottom, top))
        titles.append(
            {
                "text": _title(path),
                "x": sum(across) / 2.0,
                "y": top,
                "xref": "paper",
                "yref": "paper",
                "xanchor": "center",
                "yanchor": "bottom",
                "showarrow": False,
            }
        )
    caption = "Markers: knots; bands: their 95 % intervals, the structure of the model taken as right."
    plot = {"data": traces, "layout": layout(height, **axes, annotations=titles, showlegend=False)}
    return Figure("Identified curves", caption, plot, table.columns)


def _title(path: str) -> str:
    """A path that is longer than a panel of a narrow page is wide goes on in a second line."""
    head, point, key = plain(path).rpartition(".")
    return f"{head}<br>{point}{key}" if len(path) > LONG else plain(path)


def _in_rig_units(path: str, curve: IdentifiedCurve) -> tuple[dict[str, Any], tuple[str, str]]:
    at_factor, at_unit = rig_unit(curve["over_unit"], float(np.max(np.abs(curve["at"]))))
    factor, unit = rig_unit(curve["unit"], float(np.max(np.abs(curve["value"]))))
    block = {"curve": path, AT: at_factor * np.asarray(curve["at"]), "unit of at": at_unit, "unit": unit}
    block |= {VALUE: factor * np.asarray(curve["value"]), LOW: factor * np.asarray(curve["low"])}
    return block | {HIGH: factor * np.asarray(curve["high"])}, (at_unit, unit)


def _traces(
    index: int, block: Mapping[str, Any], drawn: Mapping[str, Any], units: Sequence[str]
) -> list[dict[str, Any]]:
    place = {"type": "scatter", "xaxis": axis_number("x", index), "yaxis": axis_number("y", index)}
    known = np.isfinite(block[LOW]) & np.isfinite(block[HIGH])
    x, low, high = (block[key][known] for key in (AT, LOW, HIGH))
    band = {
        **place,
        "mode": "lines",
        "x": [*x, *x[::-1]],
        "y": [*high, *low[::-1]],
        "line": {"width": 0, "color": "@after"},
        "fill": "toself",
        "fillcolor": "@after",
        "opacity": 0.25,
        "hoverinfo": "skip",
    }
    line = {
        **place,
        "mode": "lines+markers",
        "x": drawn[AT],
        "y": drawn[VALUE],
        "line": {"color": "@after", "width": 2},
        "marker": {"size": 6},
        "hovertemplate": f"%{{x:.4r}} {units[0]}, %{{y:.4r}} {units[1]}<extra></extra>",
    }
    return [band, line]


def _axes(
    index: int, told: tuple[str, str], units: Sequence[str], across: tuple[float, float], down: tuple[float, float]
) -> dict[str, Any]:
    x, y = axis_number("x", index), axis_number("y", index)
    titles = (f"{told[0]} ({units[0]})", f"{told[1]} ({units[1]})" if units[1] else "factor")
    return {
        axis_number("x", index, "axis"): axis(titles[0], domain=list(across), anchor=y),
        axis_number("y", index, "axis"): axis(titles[1], domain=list(down), anchor=x),
    }
