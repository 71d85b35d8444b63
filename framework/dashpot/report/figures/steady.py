"""Dynamic stiffness and loss angle of runs at one frequency each: over amplitude, or over frequency."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from dashpot.report.figures import toggles
from dashpot.report.figures.stiffness import ROWS, Curve, dynamic_stiffness
from dashpot.report.figures.tidy import TidyTable
from dashpot.report.parts import Figure
from dashpot.report.theme import axis, axis_number, layout, plain, series_color

AMPLITUDE, FREQUENCY = "amplitude (mm)", "frequency (Hz)"
WIDE = 20.0  # a range of more than this factor is drawn on a logarithmic axis
SYMBOLS = ("diamond-open", "square-open", "triangle-up-open", "x-open", "cross-open", "star-open")


def stiffness_figures(curves: Sequence[Curve], series: Sequence[str] = ()) -> list[Figure]:
    """Swept runs as curves over frequency, steady ones as points; see `dynamic_stiffness` for what a curve holds."""
    swept = [curve for curve in curves if np.size(curve["frequency"]) > 1]
    steady = [curve for curve in curves if np.size(curve["frequency"]) == 1]
    figures = [dynamic_stiffness(swept, series)] if swept else []
    return figures + ([steady_stiffness(steady, series)] if steady else [])


def steady_stiffness(curves: Sequence[Curve], series: Sequence[str] = ()) -> Figure:
    """|K*| (N/mm) and loss angle (deg) of runs with one point each, over what they differ in: amplitude or frequency.

    The measurement is drawn as dots, each simulation with a colour and an open symbol of its own; those in `series`
    are drawn at first, without them all.
    """
    labels = list(dict.fromkeys(label for curve in curves for label in curve["simulated"]))
    table = TidyTable(
        "run", AMPLITUDE, FREQUENCY, *(_heading(label, row) for label in ["measured", *labels] for row in ROWS)
    )
    block = table.add(_block(curves, labels))
    over = _over(curves)
    groups = [toggles.series_group(labels, measured="point", mark="point", series=series)]
    traces = [
        _trace(label, level, block, over, labels, curves)
        for label in ["measured", *labels]
        for level in range(len(ROWS))
    ]
    plot = {"data": toggles.apply(traces, groups), "layout": _layout(over, table.columns[over], groups)}
    title = f"Dynamic stiffness and loss angle over {over.partition(' ')[0]}"
    return Figure(title, "A point for each run; dots: measured, open symbols: simulated.", plot, table.columns)


def _block(curves: Sequence[Curve], labels: Sequence[str]) -> dict[str, Any]:
    block: dict[str, Any] = {
        "run": np.array([curve["run"] for curve in curves], dtype=object),
        AMPLITUDE: np.array([_number(curve.get("amplitude")) * 1e3 for curve in curves]),
        FREQUENCY: np.array([float(np.ravel(curve["frequency"])[0]) for curve in curves]),
    }
    for label in ["measured", *labels]:
        for row in ROWS:
            block[_heading(label, row)] = np.array([_value(curve, label, row[0]) * row[3] for curve in curves])
    return block


def _value(curve: Curve, label: str, key: str) -> float:
    response = curve["measured"] if label == "measured" else curve["simulated"].get(label)
    return math.nan if response is None else float(np.ravel(response[key])[0])


def _over(curves: Sequence[Curve]) -> str:
    """What distinguishes the runs."""
    amplitudes = {f"{_number(curve.get('amplitude')):.2g}" for curve in curves}
    frequencies = {f"{float(np.ravel(curve['frequency'])[0]):.2g}" for curve in curves}
    return AMPLITUDE if len(amplitudes) > len(frequencies) else FREQUENCY


def _trace(
    label: str, level: int, block: Mapping[str, Any], over: str, labels: Sequence[str], curves: Sequence[Curve]
) -> dict[str, Any]:
    name = plain(toggles.series_name(label))
    return {
        "type": "scatter",
        "mode": "markers",
        "name": name,
        "text": [f"{plain(curve['run'])}, {name}" for curve in curves],
        "meta": {"series": label},
        "x": block[over],
        "y": block[_heading(label, ROWS[level])],
        "xaxis": axis_number("x", level),
        "yaxis": axis_number("y", level),
        "marker": _marker(label, labels),
        "hovertemplate": f"%{{text}}<br>%{{x:.4r}} {over[-3:-1]}, %{{y:.4r}} {ROWS[level][2]}<extra></extra>",
    }


def _marker(label: str, labels: Sequence[str]) -> dict[str, Any]:
    if label == "measured":
        return {"color": "@measured", "size": 8}
    symbol = SYMBOLS[labels.index(label) % len(SYMBOLS)]
    return {"color": series_color(label, labels), "size": 10, "symbol": symbol, "line": {"width": 1.6}}


def _layout(over: str, places: np.ndarray, groups: list[dict[str, Any]]) -> dict[str, Any]:
    kind = "log" if np.nanmin(places) > 0.0 and np.nanmax(places) > WIDE * np.nanmin(places) else "linear"
    axes: dict[str, Any] = {}
    for level, (_, what, unit, _) in enumerate(ROWS):
        bottom = level == len(ROWS) - 1
        axes[axis_number("x", level, "axis")] = axis(
            over if bottom else "",
            type=kind,
            anchor=axis_number("y", level),
            showticklabels=bottom,
            **({"matches": "x"} if level else {}),
        )
        axes[axis_number("y", level, "axis")] = axis(
            f"{what} ({unit})",
            domain=[0.52, 0.98] if level == 0 else [0.0, 0.46],
            anchor=axis_number("x", level),
            rangemode="tozero",
        )
    return layout(560, **axes, meta={"toggles": groups})


def _number(value: float | None) -> float:
    return math.nan if value is None else value


def _heading(label: str, row: tuple[str, str, str, float]) -> str:
    return f"{row[1]} {toggles.series_name(label)} ({row[2]})"
