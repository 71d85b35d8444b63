"""The error of each model next to the explainable error and the noise floor."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from dashpot.report.figures.tidy import TidyTable
from dashpot.report.parts import Figure
from dashpot.report.theme import axis, layout, plain
from dashpot.text.digits import number

PARTS = (("train", "training runs", "@train"), ("held_out", "held-out runs", "@held-out"))


def rmse_bars(
    models: Sequence[Mapping[str, Any]], floor: float | None = None, explainable: float | None = None
) -> Figure:
    """RMSE of each model on training and held-out runs, with lines at the explainable error and the noise floor.

    Each model: `name`, `train` and `held_out` in N (None where there are no such runs); `floor` and
    `explainable` in N.
    """
    table = TidyTable("model", *(_heading(title) for _, title, _ in PARTS))
    for model in models:
        table.add({"model": model["name"]} | {_heading(title): _value(model.get(key)) for key, title, _ in PARTS})
    names = [plain(model["name"]) for model in models]
    traces = [_bars(names, title, color) for key, title, color in PARTS if _has(models, key)]
    if floor is not None:
        traces.append(_line("noise floor", floor, "dash"))
    if explainable is not None:
        traces.append(_line("explainable", explainable, "dot"))
    caption = ["RMSE of the force.", _bound(floor, explainable)]
    caption += [] if explainable is None else ["Explainable: RMSE of a general model of the past motion."]
    return Figure(
        "Error of the models",
        " ".join(filter(None, caption)),
        {"data": traces, "layout": _layout(names)},
        table.columns,
    )


def _bound(floor: float | None, explainable: float | None) -> str:
    """What the noise floor says of all models; empty without one."""
    if floor is None:
        return ""
    if explainable is not None and explainable < floor:
        return "A general model is below the noise floor, which so holds more than noise."
    return "No model can be below the noise floor."


def _bars(names: Sequence[str], title: str, color: str) -> dict[str, Any]:
    return {
        "type": "bar",
        "name": title,
        "x": list(names),
        "y": {"column": _heading(title), "rows": [0, len(names)]},
        "marker": {"color": color},
        "texttemplate": "%{y:.3r}",
        "textposition": "outside",
        "cliponaxis": False,
        "hovertemplate": f"%{{x}}<br>%{{y:.3r}} N on {title}<extra></extra>",
    }


# drawn from edge to edge on an axis of its own, so that it also crosses a single bar
def _line(name: str, value: float, dash: str) -> dict[str, Any]:
    return {
        "type": "scatter",
        "mode": "lines",
        "name": f"{name} {number(value)} N",
        "x": [0.0, 1.0],
        "y": [value, value],
        "xaxis": "x2",
        "line": {"color": "@ink", "dash": dash, "width": 1.6},
        "hovertemplate": f"{name} %{{y:.3r}} N<extra></extra>",
    }


def _layout(names: Sequence[str]) -> dict[str, Any]:
    return layout(
        380,
        barmode="group",
        bargap=max(0.35, 0.95 - 0.15 * len(names)),
        xaxis=axis(type="category", showgrid=False),
        xaxis2={"overlaying": "x", "range": [0.0, 1.0], "visible": False, "fixedrange": True},
        yaxis=axis("RMSE (N)", rangemode="tozero"),
    )


def _value(value: float | None) -> float:
    return float("nan") if value is None else value


def _has(models: Sequence[Mapping[str, Any]], key: str) -> bool:
    return any(model.get(key) is not None for model in models)


def _heading(title: str) -> str:
    return f"RMSE on {title} (N)"
