"""The report of a comparison of models."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from operator import itemgetter
from typing import Any

from dashpot.report import figures
from dashpot.report.colophon import colophon
from dashpot.report.evidence import Evidence
from dashpot.report.grids import comparison_grid, floor_origin, floor_value, parameters_grid, runs_grid
from dashpot.report.headline import RUNS
from dashpot.report.parts import Grid, KeyFigures, Notice, Page, Part, Picture, Section
from dashpot.report.readable import number

Json = Mapping[str, Any]


def comparison_page(comparison: Json, evidence: Evidence) -> Page:
    """The report of a `dashpot-comparison/1`; in `evidence` the labels are the names of the models.

    Used keys: `loops`, `residuals`, `dynamic_stiffness`, `harmonics`, `misfit_map`, `history`, `schematic`,
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
    )


def comparison_headline(comparison: Json) -> str:
    """The best model, and how far it is from what the measurement can resolve."""
    best, floor = best_model(comparison), floor_value(comparison)
    error = None if best is None else _error(best)
    if best is None or error is None:
        return "No model could be compared."
    if not floor:
        return f"{best['name']} is closest: {number(error)} N of error (noise floor unknown)."
    ratio = number(error / floor, 2)
    return f"{best['name']} is closest: {number(error)} N of error, {ratio} × the noise floor ({number(floor)} N)."


def best_model(comparison: Json) -> Json | None:
    """The model with the smallest error on held-out runs, or on the training runs where none were held out."""
    errors = [(error, model) for model in comparison["models"] if (error := _error(model)) is not None]
    return min(errors, key=itemgetter(0), default=(None, None))[1]


def _sections(comparison: Json, evidence: Evidence) -> Iterator[Section]:
    yield Section("Result", parts=list(_result(comparison, evidence)))
    yield Section("Over frequency", parts=list(_frequency(evidence)))
    yield Section("Over displacement and time", parts=list(_signals(evidence)))
    yield Section("The models", parts=list(_models(comparison, evidence)))


def _result(comparison: Json, evidence: Evidence) -> Iterator[Part]:
    yield from (Notice("warning", text) for text in evidence.get("warnings", ()))
    yield _key_figures(comparison)
    yield comparison_grid(comparison)
    yield figures.rmse_bars([{"name": m["name"], **m["rmse"]} for m in comparison["models"]], floor_value(comparison))
    yield from _filled(runs_grid(comparison))


def _frequency(evidence: Evidence) -> Iterator[Part]:
    if evidence.get("dynamic_stiffness"):
        yield figures.dynamic_stiffness(evidence["dynamic_stiffness"])
    if evidence.get("misfit_map"):
        yield figures.misfit_map(evidence["misfit_map"])
    if evidence.get("harmonics"):
        yield figures.harmonic_bars(evidence["harmonics"])


def _signals(evidence: Evidence) -> Iterator[Part]:
    if "loops" in evidence:
        yield figures.loops(**evidence["loops"])
    if "residuals" in evidence:
        yield figures.residual_traces(**evidence["residuals"])


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
    shown = [("models compared", str(len(comparison["models"])), "", "")]
    if best is not None:
        shown.append(("best model", best["name"], "", ""))
        shown.append(("its error", number(_error(best)), "N", f"RMSE on {RUNS[_judged_on(best)]}"))
    if floor is not None:
        shown.append(("noise floor", number(floor), "N", f"from {comparison['noise_floor']['from']}"))
    return KeyFigures(shown)


def _lead(comparison: Json) -> str:
    best = best_model(comparison)
    runs = len(best.get("per_run") or {}) if best else 0
    counted = f" on {runs} runs" if runs else ""
    return f"{len(comparison['models'])} models against measured forces{counted}. {floor_origin(comparison)}".strip()


def _error(model: Json) -> float | None:
    return model["rmse"].get(_judged_on(model))


def _judged_on(model: Json) -> str:
    return next((key for key in RUNS if model["rmse"].get(key) is not None), "all")


def _dataset_name(comparison: Json) -> str:
    return (comparison.get("dataset") or {}).get("name") or "the measurement"
