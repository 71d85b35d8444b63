"""The report of a comparison of models."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from operator import itemgetter
from typing import Any

from dashpot.report import figures
from dashpot.report.colophon import colophon
from dashpot.report.evidence import Evidence
from dashpot.report.grids import (
    comparison_grid,
    explainable_value,
    floor_origin,
    floor_value,
    metrics_grid,
    parameters_grid,
    runs_grid,
)
from dashpot.report.headline import RUNS
from dashpot.report.parts import Grid, KeyFigures, Notice, Page, Part, Picture, Section
from dashpot.report.readable import above_floor, counted_words
from dashpot.report.shapes import shape_figures
from dashpot.text.digits import quantity, shown_with_unit

Json = Mapping[str, Any]

FEW = 2  # models that a plot takes without becoming crowded


def comparison_page(comparison: Json, evidence: Evidence) -> Page:
    """The report of a `dashpot-comparison/1`; in `evidence` the labels are the names of the models.

    Used keys: `loops`, `residuals`, `shapes`, `dynamic_stiffness`, `harmonics`, `misfit_map`, `history`, `schematic`,
    `warnings`, `provenance`; see `Evidence` for shapes and units. Beyond the contract a parameter of a model may be
    `{"value", "unit"}`, and `status` other than "ok" is shown as it is.
    """
    sections = [section for section in _sections(comparison, evidence) if section.parts]
    return Page(
        title=f"Comparison on {_dataset_name(comparison)}",
        headline=comparison_headline(comparison),
        lead=_lead(comparison),
        sections=sections,
        colophon=colophon(comparison, evidence),
        summary=("Models against the measurement", "Dynamic stiffness and loss angle"),
    )


def comparison_headline(comparison: Json) -> str:
    """The best model, and how far it is from what the measurement can resolve."""
    best, floor = best_model(comparison), floor_value(comparison)
    error = None if best is None else _error(best)
    if best is None or error is None:
        return "No model could be compared."
    return f"{best['name']} has the lowest RMSE: {closeness(error, floor)}"


def closeness(error: float, floor: float | None) -> str:
    """An error in N against the noise floor."""
    if not floor:
        return f"{quantity(error, 'N')} (noise floor unknown)."
    return f"{quantity(error, 'N')}, {above_floor(error, floor)} ({quantity(floor, 'N')})."


def best_model(comparison: Json) -> Json | None:
    """The model with the smallest error on held-out runs, or on the training runs where none were held out."""
    errors = [(error, model) for model in comparison["models"] if (error := _error(model)) is not None]
    return min(errors, key=itemgetter(0), default=(None, None))[1]


def _sections(comparison: Json, evidence: Evidence) -> Iterator[Section]:
    series = _first_shown(comparison)
    yield Section("Result", parts=list(_result(comparison, evidence)))
    yield Section("The shape of the force", parts=list(shape_parts(evidence, series)))
    yield Section("Over frequency and amplitude", parts=list(frequency_parts(evidence, series)))
    yield Section("Over displacement and time", parts=list(signal_parts(evidence, series)))
    yield Section("The models", parts=list(_models(comparison, evidence)))


def _result(comparison: Json, evidence: Evidence) -> Iterator[Part]:
    yield _key_figures(comparison)
    yield comparison_grid(comparison)
    bars = [{"name": model["name"], **model["rmse"]} for model in comparison["models"] if model["rmse"]]
    yield figures.rmse_bars(bars, floor_value(comparison), explainable_value(comparison))
    yield from _filled(metrics_grid(comparison))
    yield from _filled(runs_grid(comparison))
    yield from (Notice("warning", text) for text in evidence.get("warnings", ()))


def frequency_parts(evidence: Evidence, series: Sequence[str] = ()) -> Iterator[Part]:
    """Dynamic stiffness, map of the misfit and harmonics, as far as there are any."""
    if evidence.get("dynamic_stiffness"):
        yield from figures.stiffness_figures(evidence["dynamic_stiffness"], series)
    if evidence.get("misfit_map"):
        yield figures.misfit_map(evidence["misfit_map"])
    if evidence.get("harmonics"):
        yield figures.harmonic_bars(evidence["harmonics"], series)


def shape_parts(evidence: Evidence, series: Sequence[str] = ()) -> Iterator[Part]:
    """What measured and simulated force look like without a model, where there are such curves."""
    if "shapes" in evidence:
        yield from shape_figures(evidence["shapes"], series)


def signal_parts(evidence: Evidence, series: Sequence[str] = ()) -> Iterator[Part]:
    """Loops and residuals, as far as there are any."""
    if "loops" in evidence:
        yield figures.loops(**evidence["loops"], series=series)
    if "loops" in evidence and evidence.get("branches"):
        yield figures.branch_loops(evidence["loops"]["measured"], evidence["branches"])
    if "residuals" in evidence:
        yield figures.residual_traces(**evidence["residuals"], series=series)


def _first_shown(comparison: Json) -> tuple[str, ...]:
    """Of many models only the best is drawn at first; the others are a press on a button away."""
    best = best_model(comparison)
    return (best["name"],) if best and len(comparison["models"]) > FEW else ()


def _models(comparison: Json, evidence: Evidence) -> Iterator[Part]:
    yield from (Picture(title, svg) for title, svg in evidence.get("schematic", {}).items())
    yield from _filled(parameters_grid(comparison))
    if evidence.get("history"):
        yield figures.convergence_history(evidence["history"])


def _filled(grid: Grid) -> Iterator[Grid]:
    if grid.rows:
        yield grid


def _key_figures(comparison: Json) -> KeyFigures:
    best, floor = best_model(comparison), floor_value(comparison)
    shown = []
    if best is not None:
        error = shown_with_unit(_error(best), "N")
        shown.append((f"error of {best['name']}", *error, f"lowest RMSE on {RUNS[_judged_on(best)]}"))
    explainable = explainable_value(comparison)
    if explainable is not None:
        shown.append(("explainable", *shown_with_unit(explainable, "N"), "of a general model of the past motion"))
    if floor is not None:
        shown.append(("noise floor", *shown_with_unit(floor, "N"), f"from {comparison['noise_floor']['from']}"))
    return KeyFigures(shown)


def _lead(comparison: Json) -> str:
    best = best_model(comparison)
    runs = len(best.get("per_run") or {}) if best else 0
    counted = f" on {counted_words(runs, 'run')}" if runs else ""
    models = counted_words(len(comparison["models"]), "model")
    return f"{models} against measured forces{counted}. {floor_origin(comparison)}".strip()


def _error(model: Json) -> float | None:
    return (model["rmse"] or {}).get(_judged_on(model))


def _judged_on(model: Json) -> str:
    return next((key for key in RUNS if (model["rmse"] or {}).get(key) is not None), "all")


def _dataset_name(comparison: Json) -> str:
    return (comparison.get("dataset") or {}).get("name") or "the measurement"
