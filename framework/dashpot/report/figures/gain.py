"""What each suspected cause promised, and what it brought on runs it had not seen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from dashpot.report.grids import cause_title
from dashpot.report.parts import Figure
from dashpot.report.theme import axis, layout, plain

EXPECTED, REALISED, LOW, HIGH = "expected gain (%)", "gain (%)", "gain from (%)", "gain to (%)"


def gain_intervals(causes: Sequence[Mapping[str, Any]]) -> Figure:
    """Expected gain (open) and gain on held-out runs (filled, with its interval) of each cause, in percent.

    Each cause: `cause`, optionally `title` and `place`, and as shares of one, each None where unknown:
    `expected_gain`, `gain`, `gain_interval` (low, high); `accepted`.
    """
    columns: dict[str, list[Any]] = {
        "cause": [cause_title(cause) for cause in causes],
        EXPECTED: [_percent(cause.get("expected_gain")) for cause in causes],
        REALISED: [_percent(cause.get("gain")) for cause in causes],
        LOW: [_percent((cause.get("gain_interval") or (None, None))[0]) for cause in causes],
        HIGH: [_percent((cause.get("gain_interval") or (None, None))[1]) for cause in causes],
        "accepted": ["yes" if cause.get("accepted") else "no" for cause in causes],
    }
    names = [plain(name) for name in columns["cause"]]
    traces = [_expected(names), _realised(names, columns)]
    caption = "Part of the error that goes when the cause is added; realised on runs that took no part in the refit."
    return Figure("Expected and realised gain", caption, {"data": traces, "layout": _layout(names)}, columns)


def _expected(names: Sequence[str]) -> dict[str, Any]:
    return {
        "type": "scatter",
        "mode": "markers",
        "name": "expected before the refit",
        "x": {"column": EXPECTED, "rows": [0, len(names)]},
        "y": list(names),
        "marker": {"symbol": "diamond-open", "size": 12, "color": "@before", "line": {"width": 2}},
        "hovertemplate": "%{y}<br>expected %{x:.1f} %<extra></extra>",
    }


def _realised(names: Sequence[str], columns: Mapping[str, Sequence[Any]]) -> dict[str, Any]:
    gains = columns[REALISED]
    return {
        "type": "scatter",
        "mode": "markers",
        "name": "on held-out runs",
        "x": {"column": REALISED, "rows": [0, len(names)]},
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
        "hovertemplate": "%{y}<br>realised %{x:.1f} %<extra></extra>",
    }


def _layout(names: Sequence[str]) -> dict[str, Any]:
    return layout(
        130 + 36 * len(names),
        xaxis=axis("gain (% of the error)", zeroline=True),
        yaxis=axis(type="category", categoryorder="array", categoryarray=list(reversed(names))),
    )


def _percent(share: float | None) -> float | None:
    return None if share is None else 100.0 * share


def _reach(low: float | None, high: float | None) -> float:
    return 0.0 if low is None or high is None else high - low
