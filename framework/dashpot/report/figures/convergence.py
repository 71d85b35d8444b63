"""How the optimizer got there."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from dashpot.report.evidence import Progress
from dashpot.report.figures.excerpt import thin
from dashpot.report.figures.tidy import TidyTable
from dashpot.report.parts import Figure
from dashpot.report.theme import axis, layout, plain, series_color

EVALUATIONS, BEST = "evaluations", "best RMSE (N)"
POINTS_PER_TRACE = 500
DECADE = 10.0


def convergence_history(history: Mapping[str, Progress]) -> Figure:
    """Best RMSE (N) over model evaluations, a line for each fit.

    `history[label]` holds `evaluations` (n,) and `best` (n,) N.
    """
    table = TidyTable("fit", EVALUATIONS, BEST)
    traces = []
    for label, progress in history.items():
        if not len(progress["best"]):
            continue
        kept = thin(np.arange(len(progress["best"])), POINTS_PER_TRACE)
        values = {EVALUATIONS: np.asarray(progress["evaluations"])[kept], BEST: np.asarray(progress["best"])[kept]}
        traces.append(_trace(label, table.add({"fit": label} | values), list(history)))
    axes = {"xaxis": axis(EVALUATIONS, rangemode="tozero"), "yaxis": _error_axis(history.values())}
    plot = {"data": traces, "layout": layout(340, **axes, showlegend=True)}
    return Figure(
        "Convergence of the fits", "The lowest RMSE so far over the number of simulations.", plot, table.columns, True
    )


def _error_axis(history: Iterable[Progress]) -> dict[str, Any]:
    errors = np.concatenate([[], *(np.asarray(progress["best"], float) for progress in history)])
    errors = errors[np.isfinite(errors) & (errors > 0.0)]
    # a logarithmic axis of less than a decade has hardly a tick
    if not errors.size or errors.max() < DECADE * errors.min():
        return axis(BEST)
    ticks = [step * 10.0**power for power in range(-6, 10) for step in (1, 2, 5)]
    return axis(BEST, type="log", tickvals=ticks, ticktext=[f"{tick:g}" for tick in ticks])


def _trace(label: str, block: Mapping[str, Any], labels: Sequence[str]) -> dict[str, Any]:
    return {
        "type": "scatter",
        "mode": "lines",
        "name": plain(label),
        "text": plain(label),
        "x": block[EVALUATIONS],
        "y": block[BEST],
        "line": {"color": series_color(label, labels), "width": 1.8, "shape": "hv"},
        "hovertemplate": "%{text}<br>%{y:.3r} N after %{x} simulations<extra></extra>",
    }
