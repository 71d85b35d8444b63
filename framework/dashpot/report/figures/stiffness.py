"""Dynamic stiffness and loss angle over frequency."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from dashpot.report.figures import toggles
from dashpot.report.figures.tidy import TidyTable
from dashpot.report.parts import Figure
from dashpot.report.readable import set_value
from dashpot.report.theme import axis, axis_number, layout, ordered_color, plain, series_dash

FREQUENCY = "frequency (Hz)"
ROWS = (("stiffness", "|K*|", "N/mm", 1e-3), ("loss_angle", "loss angle", "deg", 180.0 / math.pi))
HEIGHTS = ([0.52, 0.98], [0.0, 0.46])
PANELS = 4
GAP = 0.05

Curve = Mapping[str, Any]


def dynamic_stiffness(curves: Sequence[Curve], series: Sequence[str] = ()) -> Figure:
    """|K*| (N/mm) and loss angle (deg) over frequency, a panel for each preload and a colour for each amplitude.

    Each curve: `run`, `frequency` (n,) Hz, `measured` and `simulated[label]`, each with `stiffness` (n,) N/m and
    `loss_angle` (n,) rad; `amplitude` and `preload` in m where the run has them. The measurement is drawn as points,
    "before" as a dotted line, "after" as a solid one, models each with a dash of their own. More than four preloads
    share one panel. The labels in `series` are drawn at first, without them all.
    """
    labels = list(dict.fromkeys(label for curve in curves for label in curve["simulated"]))
    table = TidyTable("run", "amplitude (mm)", "preload (mm)", FREQUENCY, *_headings(labels))
    panels, amplitudes = _panels(curves), _amplitudes(curves)
    traces = []
    for curve in curves:
        block = table.add(_block(curve))
        color = ordered_color(amplitudes.index(_amplitude(curve)), len(amplitudes))
        panel = panels.index(_panel(curve, panels))
        cells = [panel + level * len(panels) for level in range(len(ROWS))]
        traces += _traces(curve, block, color, cells, labels)
    title = "Amplitude" if any(curve.get("amplitude") is not None for curve in curves) else "Runs"
    groups = _groups(amplitudes, labels, title, series)
    plot = {"data": toggles.apply(traces, groups), "layout": _layout(panels, groups)}
    return Figure("Dynamic stiffness and loss angle", _caption(panels), plot, table.columns)


def _block(curve: Curve) -> dict[str, Any]:
    block = {"run": curve["run"], FREQUENCY: curve["frequency"]}
    block |= {f"{key} (mm)": 1e3 * curve[key] for key in ("amplitude", "preload") if curve.get(key) is not None}
    for label, response in _responses(curve).items():
        block |= {_heading(label, row): np.asarray(response[row[0]]) * row[3] for row in ROWS}
    return block


def _traces(
    curve: Curve, block: Mapping[str, Any], color: str, cells: Sequence[int], labels: Sequence[str]
) -> list[dict[str, Any]]:
    return [
        {
            **_look(label, color, labels),
            "type": "scatter",
            "name": f"{plain(curve['run'])}, {plain(toggles.series_name(label))}",
            "text": f"{plain(curve['run'])}, {plain(toggles.series_name(label))}",
            "meta": {"amplitude": _amplitude(curve), "series": label},
            "x": block[FREQUENCY],
            "y": block[_heading(label, row)],
            "xaxis": axis_number("x", cell),
            "yaxis": axis_number("y", cell),
            "hovertemplate": f"%{{text}}<br>%{{x:.2f}} Hz, %{{y:.4r}} {row[2]}<extra></extra>",
        }
        for label in _responses(curve)
        for cell, row in zip(cells, ROWS, strict=True)
    ]


def _look(label: str, color: str, labels: Sequence[str]) -> dict[str, Any]:
    if label == "measured":
        return {"mode": "markers", "marker": {"color": color, "size": 5, "opacity": 0.8}}
    return {"mode": "lines", "line": {"color": color, "width": 1.8, "dash": series_dash(label, labels)}}


def _responses(curve: Curve) -> dict[str, Any]:
    return {"measured": curve["measured"], **curve["simulated"]}


def _groups(
    amplitudes: Sequence[str], labels: Sequence[str], title: str, series: Sequence[str]
) -> list[dict[str, Any]]:
    shades = [
        toggles.choice(name, color=ordered_color(index, len(amplitudes)), mark="solid")
        for index, name in enumerate(amplitudes)
    ]
    simulations = [
        toggles.choice(
            label,
            toggles.series_name(label),
            "@soft",
            series_dash(label, labels),
            toggles.is_shown(label, series),
        )
        for label in labels
    ]
    measured = toggles.choice("measured", color="@soft", mark="point")
    return [toggles.group("series", "Show", [measured, *simulations]), toggles.group("amplitude", title, shades)]


def _layout(panels: Sequence[str], groups: list[dict[str, Any]]) -> dict[str, Any]:
    axes: dict[str, Any] = {}
    for panel in range(len(panels)):
        axes |= _panel_axes(panel, len(panels))
    titles = [_panel_title(index, name, len(panels)) for index, name in enumerate(panels) if len(panels) > 1]
    return layout(620, **axes, annotations=titles, meta={"toggles": groups})


def _panel_axes(panel: int, panels: int) -> dict[str, Any]:
    """Two pairs of axes, one above the other; all share the frequency, the panels of a row the value."""
    axes: dict[str, Any] = {}
    for level, (_, what, unit, _) in enumerate(ROWS):
        number = panel + level * panels
        frequency = axis(
            "" if level == 0 else FREQUENCY,
            domain=list(_span(panel, panels)),
            anchor=axis_number("y", number),
            showticklabels=level > 0,
            zeroline=False,
            **({"matches": "x"} if number else {}),
        )
        value = axis(
            f"{what} ({unit})" if panel == 0 else "",
            domain=HEIGHTS[level],
            anchor=axis_number("x", number),
            showticklabels=panel == 0,
            **({"matches": axis_number("y", level * panels)} if panel else {}),
        )
        axes |= {axis_number("x", number, "axis"): frequency, axis_number("y", number, "axis"): value}
    return axes


def _span(panel: int, panels: int) -> tuple[float, float]:
    width = (1.0 - GAP * (panels - 1)) / panels
    return panel * (width + GAP), panel * (width + GAP) + width


def _panel_title(index: int, name: str, panels: int) -> dict[str, Any]:
    place = {"x": sum(_span(index, panels)) / 2.0, "y": 1.0, "xref": "paper", "yref": "paper"}
    return {"text": plain(name), "showarrow": False, "xanchor": "center", "yanchor": "bottom", **place}


def _panels(curves: Sequence[Curve]) -> list[str]:
    preloads = sorted({curve["preload"] for curve in curves if curve.get("preload") is not None})
    if len(preloads) > PANELS:
        return [""]
    names = [_preload(value) for value in preloads]
    return names + ([""] if not names or any(curve.get("preload") is None for curve in curves) else [])


def _panel(curve: Curve, panels: Sequence[str]) -> str:
    preload = curve.get("preload")
    return "" if preload is None or _preload(preload) not in panels else _preload(preload)


def _preload(value: float) -> str:
    return f"preload {set_value(value, 'm')}"


def _amplitudes(curves: Sequence[Curve]) -> list[str]:
    known = sorted({curve["amplitude"] for curve in curves if curve.get("amplitude") is not None})
    names = dict.fromkeys(set_value(value, "m") for value in known)
    return list(names | dict.fromkeys(_amplitude(curve) for curve in curves))


def _amplitude(curve: Curve) -> str:
    amplitude = curve.get("amplitude")
    return curve["run"] if amplitude is None else set_value(amplitude, "m")


def _headings(labels: Sequence[str]) -> list[str]:
    return [_heading(label, row) for label in ["measured", *labels] for row in ROWS]


def _heading(label: str, row: tuple[str, str, str, float]) -> str:
    return f"{row[1]} {toggles.series_name(label)} ({row[2]})"


def _caption(panels: Sequence[str]) -> str:
    columns = "Columns: preloads. " if len(panels) > 1 else ""
    return f"{columns}Points: measured; lines: simulated."
