"""The gain of each cause on held-out runs, with its interval."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from dashpot.report.grids import cause_title
from dashpot.report.parts import Figure
from dashpot.report.theme import axis, layout, plain

GAIN, LOW, HIGH = "gain (%)", "gain from (%)", "gain to (%)"


def gain_intervals(causes: Sequence[Mapping[str, Any]]) -> Figure:
    """The gain of each cause on held-out runs with its interval, in percent of the RMSE.

    Each cause: `cause`, optionally `title` and `place`, and as shares of one, each None where unknown: `gain`,
    `gain_interval` (low, high); `accepted`.
    """
    columns: dict[str, list[Any]] = {
        "cause": [cause_title(cause) for cause in causes],
        GAIN: [_percent(cause.get("gain")) for cause in causes],
        LOW: [_percent((cause.get("gain_interval") or (None, None))[0]) for cause in causes],
        HIGH: [_percent((cause.get("gain_interval") or (None, None))[1]) for cause in causes],
        "accepted": ["yes" if cause.get("accepted") else "no" for cause in causes],
    }
    names = [plain(name) for name in columns["cause"]]
    traces = [_gains(names, columns)]
    caption = (
        "Share of the RMSE on held-out runs that a cause carries: 1 - RMSE with it / RMSE without it, all else "
        "refitted. Bars: 95 % intervals. The shares need not add up to that of all causes."
    )
    return Figure("Gain of each cause on held-out runs", caption, {"data": traces, "layout": _layout(names)}, columns)


def _gains(names: Sequence[str], columns: Mapping[str, Sequence[Any]]) -> dict[str, Any]:
    gains = columns[GAIN]
    return {
        "type": "scatter",
        "mode": "markers",
        "name": "gain",
        "showlegend": False,
        "x": {"column": GAIN, "rows": [0, len(names)]},
        "y": list(names),
        "marker": {"size": 10, "color": "@after"},
        "error_x": {
            "type": "data",
            "symmetric": False,
            "array": [_reach(gain, high) for gain, high in zip(gains, columns[HIGH], strict=True)],
            "arrayminus": [_reach(low, gain) for low, gain in zip(columns[LOW], gains, strict=True)],
            "color": "@after",
            "thickness": 2,
        },
        "hovertemplate": "%{y}<br>gain %{x:.1f} %<extra></extra>",
    }


def _layout(names: Sequence[str]) -> dict[str, Any]:
    return layout(
        130 + 36 * len(names),
        xaxis=axis("gain (% of the RMSE)", zeroline=True, rangemode="tozero"),
        yaxis=axis(type="category", categoryorder="array", categoryarray=list(reversed(names))),
    )


def _percent(share: float | None) -> float | None:
    return None if share is None else 100.0 * share


def _reach(low: float | None, high: float | None) -> float:
    return 0.0 if low is None or high is None else high - low
