"""Curves taken out of measured and simulated forces without a model, one figure for each way of looking."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from dashpot.report.figures import toggles
from dashpot.report.figures.tidy import TidyTable
from dashpot.report.parts import Figure
from dashpot.report.theme import axis, layout, ordered_color, plain, series_color, series_dash

Curve = Mapping[str, Any]
SHOWN_AT_FIRST = 12  # runs
DECADES = 6.0  # of a spectrum that are drawn


@dataclass(frozen=True)
class Way:
    """A way of looking: titles of figure and axes with units, factors to these units, and how it is drawn."""

    title: str
    caption: str
    x: str
    y: str
    x_factor: float = 1.0
    y_factor: float = 1.0
    points: bool = False
    logarithmic: tuple[bool, bool] = (False, False)
    first: int = SHOWN_AT_FIRST


WAYS = {
    "mid_stroke": Way(
        "Force over velocity at mid stroke",
        "One point for each stroke: the spring force is that of the middle, so what changes with velocity is "
        "damping; a step at zero is friction. The mean force of each run is subtracted.",
        "velocity (mm/s)",
        "force minus its mean (N)",
        1e3,
        points=True,
    ),
    "low_speed": Way(
        "Force over deflection at low speed",
        "The runs below a tenth of the largest speed, or the slowest one, loading and unloading: the middle is the "
        "spring, the distance between both is friction and slow relaxation.",
        "displacement (mm)",
        "force (N)",
        1e3,
    ),
    "less_spring": Way(
        "Force minus a linear spring",
        "A linear spring fitted to all measured curves is subtracted: a bend is a rising or falling stiffness, the "
        "distance between loading and unloading is friction.",
        "displacement (mm)",
        "force minus a linear spring (N)",
        1e3,
    ),
    "after_reversals": Way(
        "Stiffness after reversals",
        "The mean change of the force since a reversal of the motion, over the travel since then. High at first and "
        "falling: friction behind a stiffness, in fast runs damping; low at first and rising, or a dip on the way: "
        "clearance or slack; level: a spring.",
        "travel since the reversal (mm)",
        "stiffness since the reversal (N/mm)",
        1e3,
        1e-3,
        logarithmic=(True, False),
    ),
    "cycles": Way(
        "Loss stiffness over time",
        "Energy of every closed cycle over pi times amplitude squared, over the time of a run: what falls or "
        "rises while nothing else changes is wear, warming or bedding in. In a sweep the frequency changes as well.",
        "time (s)",
        "loss stiffness (N/mm)",
        1.0,
        1e-3,
    ),
    "force_spectrum": Way(
        "Amplitude spectrum of the force",
        "Lines that the displacement does not have are harmonics "
        "that the specimen makes, a resonance or hum; the broad floor below is noise.",
        "frequency (Hz)",
        "force (N)",
        logarithmic=(True, True),
        first=3,
    ),
    "displacement_spectrum": Way(
        "Amplitude spectrum of the displacement",
        "Motion of the actuator: its harmonics are not caused by the specimen.",
        "frequency (Hz)",
        "displacement (mm)",
        1.0,
        1e3,
        logarithmic=(True, True),
        first=3,
    ),
    "repeats": Way(
        "Repeats against each other",
        "Each run minus the mean of its repeats, small differences of their motion compensated. An even band is the "
        "noise floor; a slope is drift, a constant a zero shift, a pattern means that the specimen changed.",
        "time (s)",
        "deviation from the mean of the repeats (N)",
        first=4,
    ),
}


def shape_figure(way: str, curves: Sequence[Curve], shapes: Mapping[str, Any], series: Sequence[str] = ()) -> Figure:
    """The curves `{run, label, x, y}` (SI) of one way of looking.

    `shapes["runs"]`: `{run, shade}`; the measurement alone is coloured by the shade, the condition `shaded_by`, beside
    simulations it has one colour. The labels in `series` are drawn at first, without them all.
    """
    about = WAYS[way]
    labels = list(dict.fromkeys(curve["label"] for curve in curves if curve["label"] != "measured"))
    table = TidyTable("run", "series", about.x, about.y)
    colors = _run_colors(curves, shapes["runs"])
    traces = []
    for curve in curves:
        block = table.add(
            {
                "run": curve["run"],
                "series": curve["label"],
                about.x: about.x_factor * np.asarray(curve["x"], dtype=float),
                about.y: about.y_factor * np.asarray(curve["y"], dtype=float),
            }
        )
        color = series_color(curve["label"], labels) if labels else colors[curve["run"]]
        traces.append(_trace(curve, block, about, color, labels))
    groups = _groups(curves, {} if labels else colors, series, about.first)
    axes = {"xaxis": _axis(about.x, about.logarithmic[0]), "yaxis": _axis(about.y, about.logarithmic[1])}
    if all(about.logarithmic):
        axes["yaxis"]["range"] = _decades(curves, about.y_factor)
    plot = {"data": toggles.apply(traces, groups), "layout": layout(440, **axes, meta={"toggles": groups})}
    shade = shapes["shaded_by"].replace("_", " ")
    caption = about.caption + ("" if labels else f" Dark to light: {shade} from small to large.")
    return Figure(about.title, caption, plot, table.columns)


def _trace(curve: Curve, block: Mapping[str, Any], about: Way, color: str, labels: Sequence[str]) -> dict[str, Any]:
    name = f"{plain(curve['run'])}, {plain(toggles.series_name(curve['label']))}"
    measured = curve["label"] == "measured"
    look: dict[str, Any] = {"mode": "lines", "line": {"color": color, "width": 2.0 if measured else 1.5}}
    if not measured:
        look["line"]["dash"] = series_dash(curve["label"], labels)
    if about.points:
        look = {"mode": "markers", "marker": {"color": color, "size": 6 if measured else 4, "opacity": 0.75}}
    return {
        "type": "scatter",
        **look,
        "name": name,
        "text": name,
        "meta": {"run": curve["run"], "series": curve["label"]},
        "x": block[about.x],
        "y": block[about.y],
        "showlegend": False,
        "hovertemplate": f"%{{text}}<br>{about.x} %{{x:.4r}}<br>{about.y} %{{y:.4r}}<extra></extra>",
    }


def _run_colors(curves: Sequence[Curve], runs: Sequence[Mapping[str, Any]]) -> dict[str, str]:
    shades = {each["run"]: each["shade"] for each in runs}
    levels = sorted(set(shades.values()))
    return {curve["run"]: ordered_color(levels.index(shades[curve["run"]]), len(levels)) for curve in curves}


def _groups(
    curves: Sequence[Curve], colors: Mapping[str, str], series: Sequence[str], most: int
) -> list[dict[str, Any]]:
    """Buttons for the simulations and for the runs, of which so many, spread over all, are drawn at first."""
    labels = list(dict.fromkeys(curve["label"] for curve in curves if curve["label"] != "measured"))
    names = list(dict.fromkeys(curve["run"] for curve in curves))
    spread = sorted(names, key=lambda name: colors.get(name, ""))
    first = set(spread[:: max(1, -(-len(names) // most))])
    runs = [
        toggles.choice(name, color=colors.get(name, ""), mark="solid" if colors else "", shown=name in first)
        for name in names
    ]
    shown = [toggles.series_group(labels, series=series)] if labels else []
    return [*shown, toggles.group("run", "Runs", runs)]


def _axis(title: str, logarithmic: bool) -> dict[str, Any]:
    return axis(title, **({"type": "log"} if logarithmic else {}))


def _decades(curves: Sequence[Curve], factor: float) -> list[float]:
    top = np.log10(factor * max(float(np.max(curve["y"])) for curve in curves))
    return [float(top - DECADES), float(top + 0.3)]
