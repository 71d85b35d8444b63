"""One look for page and plots: two sets of colours under the same names, chosen to be told apart by all readers.

Lines and bars take their hues from Okabe & Ito (2008), ordered quantities from viridis, errors from a scale that is
monotone in lightness. A plot names a colour as "@before"; the page resolves it for the reader's light or dark.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from dashpot.text.digits import typeset

LIGHT = {
    "paper": "#ffffff",
    "panel": "#f5f6f8",
    "ink": "#1b1f24",
    "soft": "#57606a",
    "line": "#c9cfd6",
    "grid": "#e8ebee",
    "link": "#0b5cad",
    "good": "#0a7a55",
    "warning": "#8a5a00",
    "bad": "#b3261e",
    "added": "#dcf3e4",
    "removed": "#fbe2df",
    "measured": "#1b1f24",
    "before": "#d55e00",
    "after": "#0072b2",
    "train": "#8cc4e8",
    "held-out": "#0072b2",
    "model-1": "#0072b2",
    "model-2": "#d55e00",
    "model-3": "#009e73",
    "model-4": "#cc79a7",
    "model-5": "#b38600",
    "model-6": "#3aa0d8",
    "model-7": "#7d56c2",
    "model-8": "#8c564b",
    "model-9": "#6e7781",
    "ordered-1": "#440154",
    "ordered-2": "#46327e",
    "ordered-3": "#365c8d",
    "ordered-4": "#277f8e",
    "ordered-5": "#1fa187",
    "ordered-6": "#4ac16d",
    "heat-1": "#fff7ec",
    "heat-2": "#fdd49e",
    "heat-3": "#fc8d59",
    "heat-4": "#d7301f",
    "heat-5": "#7f0000",
}

DARK = {
    "paper": "#14181d",
    "panel": "#1d232a",
    "ink": "#e6e9ec",
    "soft": "#a0a9b3",
    "line": "#46505b",
    "grid": "#29313a",
    "link": "#7cc0f5",
    "good": "#4fd1a1",
    "warning": "#e9b64d",
    "bad": "#ff8b80",
    "added": "#143d2a",
    "removed": "#4a1f1c",
    "measured": "#e6e9ec",
    "before": "#f58b3c",
    "after": "#56b4e9",
    "train": "#2f6f9b",
    "held-out": "#56b4e9",
    "model-1": "#56b4e9",
    "model-2": "#f58b3c",
    "model-3": "#2fc99b",
    "model-4": "#e49ac3",
    "model-5": "#e6c440",
    "model-6": "#8fa8ff",
    "model-7": "#c3a6f7",
    "model-8": "#cf9b8a",
    "model-9": "#a8b1bb",
    "ordered-1": "#8d8cf0",
    "ordered-2": "#5aa0e6",
    "ordered-3": "#36b7c4",
    "ordered-4": "#4fcb86",
    "ordered-5": "#a5d84a",
    "ordered-6": "#fde725",
    "heat-1": "#1f262d",
    "heat-2": "#5c2f17",
    "heat-3": "#ad4e17",
    "heat-4": "#f58b3c",
    "heat-5": "#ffe3c2",
}

FONT = "system-ui, -apple-system, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, sans-serif"
HEAT = [[index / 4.0, f"@heat-{index + 1}"] for index in range(5)]
HUES = 9
SHADES = 6
DASHES = ("solid", "dash", "dot", "dashdot")


def layout(height: int, **more: Any) -> dict[str, Any]:
    """The frame all plots share: margins, face, legend above the plot on the left.

    Above the titles of panels there is room for the buttons of the plot.
    """
    return {
        "height": height,
        "margin": {"l": 60, "r": 16, "t": 48 if any(more.get("annotations", ())) else 24, "b": 48},
        "paper_bgcolor": "@paper",
        "plot_bgcolor": "@paper",
        "font": {"family": FONT, "size": 13, "color": "@ink"},
        "hoverlabel": {"bgcolor": "@panel", "bordercolor": "@line", "font": {"color": "@ink"}, "align": "left"},
        "hovermode": "closest",
        "legend": {"orientation": "h", "x": 0.0, "xanchor": "left", "y": 1.02, "yanchor": "bottom"},
        **more,
    }


def axis(title: str = "", **more: Any) -> dict[str, Any]:
    """An axis; `title` carries the unit: "force (N)"."""
    head, bracket, unit = title.rpartition("(")
    return {
        "title": {"text": head + bracket + typeset(unit) if bracket else title, "standoff": 10, "font": {"size": 13}},
        "gridcolor": "@grid",
        "zerolinecolor": "@line",
        "linecolor": "@line",
        "tickcolor": "@line",
        "ticks": "outside",
        "automargin": True,
        **more,
    }


def axis_number(letter: str, panel: int, kind: str = "") -> str:
    """Name of an axis of the `panel`-th panel (from 0): "x", "x2", ... or, with the kind "axis", "xaxis", "xaxis2"."""
    return f"{letter}{kind}{panel + 1 if panel else ''}"


def plain(text: object) -> str:
    """`text` for a plotly label, in which plotly would otherwise read tags and entities."""
    return str(text).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def shortened(text: str, length: int) -> str:
    """`text` without its middle where it is longer than the place for it."""
    half = (length - 1) // 2
    return text if len(text) <= length else f"{text[:half]}…{text[-half:]}"


def series_color(label: str, labels: Sequence[str]) -> str:
    """The colour of a simulation: fixed for "before" and "after", by position for the models of a comparison."""
    if label in ("before", "after", "measured"):
        return f"@{label}"
    return f"@model-{list(labels).index(label) % HUES + 1}"


def series_dash(label: str, labels: Sequence[str]) -> str:
    """The dash of a simulation where its colour means something else."""
    if label in ("before", "after"):
        return "dot" if label == "before" else "solid"
    return DASHES[list(labels).index(label) % len(DASHES)]


def ordered_color(index: int, count: int) -> str:
    """The colour of the `index`-th of `count` ordered values (amplitudes, preloads)."""
    return f"@ordered-{1 + round(index * (SHADES - 1) / max(1, count - 1)) % SHADES}"


def style_variables(colors: Mapping[str, str]) -> str:
    """The colours as CSS custom properties."""
    return " ".join(f"--{name}: {color};" for name, color in colors.items())
