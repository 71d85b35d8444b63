"""The wheel contact force of an axle over frequency, for every mass on the wheels."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from dashpot.report.figures import toggles
from dashpot.report.figures.tidy import TidyTable
from dashpot.report.parts import Figure
from dashpot.report.readable import set_value
from dashpot.report.theme import axis, axis_number, layout, ordered_color, plain, series_color, series_dash

FREQUENCY, MEASURED = "frequency (Hz)", "measured (N)"
GAP = 0.05


def contact_response(curves: Sequence[Mapping[str, Any]], series: Sequence[str] = ()) -> Figure:
    """Amplitude of the first order of the contact force (N), a panel for each wheel, a colour for each added mass.

    Each curve: `run`, `wheel`, `added_mass` kg, `frequency` (n,) Hz, `measured` (n,) N and `simulated[label]` (n,) N.
    The labels in `series` are drawn at first, without them all; of several runs with one mass the first.
    """
    labels = list(dict.fromkeys(label for curve in curves for label in curve["simulated"]))
    wheels = list(dict.fromkeys(curve["wheel"] for curve in curves))
    masses = sorted({curve["added_mass"] for curve in curves})
    table = TidyTable("run", "wheel", "added mass (kg)", FREQUENCY, MEASURED, *map(_heading, labels))
    traces = []
    for curve in curves:
        color = ordered_color(masses.index(curve["added_mass"]), len(masses))
        traces += _traces(curve, table.add(_block(curve)), color, wheels.index(curve["wheel"]), labels)
    groups = [*_groups(masses, labels, series), _runs(curves)]
    plot = {"data": toggles.apply(traces, groups), "layout": _layout(wheels, groups)}
    caption = "Amplitude at the excited frequency. Points: measured; lines: simulated, by the same order tracking."
    return Figure("Wheel contact force over frequency", caption, plot, table.columns)


def contact_models(curves: Sequence[Mapping[str, Any]]) -> Figure:
    """The same as `contact_response` with the models side by side, each in its colour, on the runs with the least mass.

    Buttons choose among these runs, of which the first is drawn at first.
    """
    least = min(curve["added_mass"] for curve in curves)
    curves = [curve for curve in curves if curve["added_mass"] == least]
    labels = list(dict.fromkeys(label for curve in curves for label in curve["simulated"]))
    wheels = list(dict.fromkeys(curve["wheel"] for curve in curves))
    table = TidyTable("run", "wheel", FREQUENCY, MEASURED, *map(_heading, labels))
    traces = []
    for curve in curves:
        block = {key: value for key, value in _block(curve).items() if key != "added mass (kg)"}
        traces += _traces(curve, table.add(block), "", wheels.index(curve["wheel"]), labels)
    groups = [toggles.series_group(labels, measured="point"), _runs(curves)]
    plot = {"data": toggles.apply(traces, groups), "layout": _layout(wheels, groups)}
    caption = f"Runs with {_mass(least)} added. Points: measured; lines: simulated, by the same order tracking."
    return Figure("Models side by side", caption, plot, table.columns)


def _block(curve: Mapping[str, Any]) -> dict[str, Any]:
    simulated = {_heading(label): force for label, force in curve["simulated"].items()}
    return {
        "run": curve["run"],
        "wheel": curve["wheel"],
        "added mass (kg)": curve["added_mass"],
        FREQUENCY: curve["frequency"],
        MEASURED: curve["measured"],
        **simulated,
    }


def _traces(
    curve: Mapping[str, Any], block: Mapping[str, Any], color: str, panel: int, labels: Sequence[str]
) -> list[dict[str, Any]]:
    looks = {"measured": {"mode": "markers", "marker": {"color": color or "@measured", "size": 5, "opacity": 0.8}}} | {
        label: {"mode": "lines", "line": {"width": 1.8, **_line(label, color, labels)}} for label in curve["simulated"]
    }
    return [
        {
            **look,
            "type": "scatter",
            "name": f"{plain(curve['run'])}, {plain(label)}",
            "text": f"{plain(curve['run'])}, {plain(curve['wheel'])}, {plain(label)}",
            "meta": {"mass": _mass(curve["added_mass"]), "run": curve["run"], "series": label},
            "x": block[FREQUENCY],
            "y": block[_heading(label)],
            "xaxis": axis_number("x", panel),
            "yaxis": axis_number("y", panel),
            "hovertemplate": "%{text}<br>%{x:.2f} Hz, %{y:.4r} N<extra></extra>",
        }
        for label, look in looks.items()
    ]


def _line(label: str, color: str, labels: Sequence[str]) -> dict[str, str]:
    """A dash tells the simulation where the colour tells the mass, without a `color` its own one does."""
    return {"color": color, "dash": series_dash(label, labels)} if color else {"color": series_color(label, labels)}


def _groups(masses: Sequence[float], labels: Sequence[str], series: Sequence[str]) -> list[dict[str, Any]]:
    measured = toggles.choice("measured", color="@soft", mark="point")
    simulated = [
        toggles.choice(label, label, "@soft", series_dash(label, labels), toggles.is_shown(label, series))
        for label in labels
    ]
    shades = [
        toggles.choice(_mass(mass), color=ordered_color(index, len(masses)), mark="solid")
        for index, mass in enumerate(masses)
    ]
    return [toggles.group("series", "Show", [measured, *simulated]), toggles.group("mass", "Added mass", shades)]


def _runs(curves: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Buttons for the runs; pressed at first is the first of each mass: others move otherwise, as in anti-phase."""
    masses = {curve["run"]: curve["added_mass"] for curve in curves}
    first = {masses[run]: run for run in reversed(masses)}
    return toggles.group("run", "Run", [toggles.choice(run, shown=first[masses[run]] == run) for run in masses])


def _layout(wheels: Sequence[str], groups: list[dict[str, Any]]) -> dict[str, Any]:
    width = (1.0 - GAP * (len(wheels) - 1)) / len(wheels)
    axes: dict[str, Any] = {}
    titles = []
    for panel, wheel in enumerate(wheels):
        left = panel * (width + GAP)
        shared = {"matches": "x"} if panel else {}
        axes[axis_number("x", panel, "axis")] = axis(
            FREQUENCY, domain=[left, left + width], anchor=axis_number("y", panel), zeroline=False, **shared
        )
        axes[axis_number("y", panel, "axis")] = axis(
            "" if panel else "contact force (N)",
            anchor=axis_number("x", panel),
            rangemode="tozero",
            showticklabels=not panel,
            **({"matches": "y"} if panel else {}),
        )
        place = {"x": left + width / 2.0, "y": 1.0, "xref": "paper", "yref": "paper"}
        titles.append({"text": plain(wheel), "showarrow": False, "xanchor": "center", "yanchor": "bottom", **place})
    return layout(420, **axes, annotations=titles, meta={"toggles": groups})


def _mass(mass: float) -> str:
    return set_value(mass, "kg")


def _heading(label: str) -> str:
    return f"{label} (N)"
