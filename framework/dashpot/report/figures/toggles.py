"""Buttons above a plot that show and hide what belongs to one run, amplitude or model.

A trace says in its `meta` what it belongs to: `{"run": "a1_p15", "series": "before"}`. It is visible where the
button of every one of its groups is pressed. The buttons are the legend of such a figure.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from dashpot.report.theme import series_color

SERIES_NAMES = {"measured": "measured", "before": "simulated before", "after": "simulated after"}


def choice(value: str, label: str = "", color: str = "", mark: str = "", shown: bool = True) -> dict[str, Any]:
    """One button; `mark` draws its sample: a dash of plotly ("solid", "dot"), "point" or "bar"."""
    return {"value": value, "label": label or value, "color": color, "mark": mark, "shown": shown}


def group(key: str, title: str, choices: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """One row of buttons over the `meta` entry `key` of the traces."""
    return {"key": key, "title": title, "choices": list(choices)}


def series_group(
    labels: Iterable[str], measured: str = "solid", mark: str = "", series: Sequence[str] = ()
) -> dict[str, Any]:
    """The buttons for the measurement (drawn as `measured`, empty: not in the figure) and each simulation.

    Pressed at first are those in `series`, or all of them; the measurement always.
    """
    labels = list(labels)
    first = [choice("measured", "measured", "@measured", measured)] if measured else []
    return group("series", "Show", first + [_simulation(label, labels, mark, series) for label in labels])


def is_shown(label: str, series: Sequence[str]) -> bool:
    """Whether a simulation is drawn at first."""
    return not series or label in series


def series_name(label: str) -> str:
    """What the reader calls the simulation `label`."""
    return SERIES_NAMES.get(label, label)


def dash(label: str) -> str:
    """How a line is drawn whose colour already tells the simulation."""
    return "dot" if label == "before" else "solid"


def _simulation(label: str, labels: Sequence[str], mark: str, series: Sequence[str]) -> dict[str, Any]:
    color = series_color(label, labels)
    return choice(label, series_name(label), color, mark or dash(label), is_shown(label, series))


def apply(traces: Sequence[dict[str, Any]], groups: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """The traces with the visibility that the buttons ask for at the beginning."""
    hidden = {(entry["key"], each["value"]) for entry in groups for each in entry["choices"] if not each["shown"]}
    return [{**trace, "visible": not hidden.intersection(trace["meta"].items()) or "legendonly"} for trace in traces]
