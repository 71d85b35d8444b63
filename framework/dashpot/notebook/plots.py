"""The figures of the report, for a cell: the same traces; what the page has as buttons is a legend here."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from dashpot.report import figures
from dashpot.report.parts import Figure
from dashpot.report.plot_json import plotly_figure
from dashpot.text.problem import nearest

if TYPE_CHECKING:
    from plotly.graph_objects import Figure as PlotlyFigure

Drawn = Callable[[Mapping[str, Any]], Sequence[Figure]]

# what can be drawn of the evidence of a result
PLOTS: Mapping[str, Drawn] = {
    "stiffness": lambda found: figures.stiffness_figures(found["dynamic_stiffness"]),
    "loops": lambda found: [figures.loops(**found["loops"])],
    "residuals": lambda found: [figures.residual_traces(**found["residuals"])],
    "harmonics": lambda found: [figures.harmonic_bars(found["harmonics"])] if found["harmonics"] else [],
    "misfit": lambda found: [figures.misfit_map(found["misfit_map"])],
    "history": lambda found: [figures.convergence_history(found["history"])],
}


def plot(what: str, evidence: Mapping[str, Any], names: Sequence[str] = tuple(PLOTS)) -> PlotlyFigure:
    """The figure ``what`` of a result, one of ``names``. ValueError for another one, or where there is none to draw."""
    if what not in names:
        hint = nearest(what, names) or "choose one of them"
        raise ValueError(f"expected a plot out of {', '.join(names)}, got '{what}'; {hint}")
    drawn = PLOTS[what](evidence)
    if not drawn:
        raise ValueError(f"expected runs with an oscillation for '{what}', these have none; take another plot")
    return interactive(drawn[0])


def interactive(figure: Figure) -> PlotlyFigure:
    """The figure as plotly's own, with a legend where the page has buttons."""
    drawn = plotly_figure(figure)
    toggles = (figure.plot["layout"].get("meta") or {}).get("toggles", [])
    drawn.update_layout(title={"text": figure.title, "font": {"size": 15}}, margin={"t": 64})
    if toggles:
        _add_legend(drawn, toggles[-1]["key"])
    return drawn


# one entry for each name, grouped by the last row of buttons
def _add_legend(drawn: PlotlyFigure, key: str) -> None:
    seen: set[str] = set()
    for trace in drawn.data:
        trace.update(legendgroup=str((trace.meta or {}).get(key, "")), showlegend=trace.name not in seen)
        seen.add(trace.name)
    beside = {"orientation": "v", "x": 1.02, "xanchor": "left", "y": 1.0, "yanchor": "top"}
    drawn.update_layout(legend={**beside, "tracegroupgap": 2})
