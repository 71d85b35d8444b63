"""The report of a study: the comparison of its models, their identification, the uncertainty of their parameters."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from dashpot.report import figures
from dashpot.report.axle import axle_sections
from dashpot.report.comparison import best_model, comparison_page
from dashpot.report.evidence import Evidence
from dashpot.report.parts import Column, Grid, Notice, Page, Part, Section
from dashpot.report.readable import set_value
from dashpot.study.masses import mass_sentence
from dashpot.text.digits import number, number_within, rig_unit, unit_per

Json = Mapping[str, Any]

MOST_KNOTS = 8
ALIKE = 0.02  # amplitudes that differ by less are the same test
ALIKE_LOSS = 1.01  # starts that end within this factor of the best one agree with it


def study_page(study: Json, evidence: Evidence) -> Page:
    """The report of a `dashpot-study-result/1`; `evidence` is that of a comparison."""
    compared = [model for model in study["models"] if model["name"] in study["study"]["compared"]]
    page = comparison_page({**study, "models": compared}, evidence)
    first, *others = page.sections
    added = [
        _ladder(study),
        *axle_sections(study, evidence),
        _at_amplitude(study, evidence),
        _conduct(study),
        _knowledge(study),
    ]
    sections = [first, *(section for section in added if section.parts), *others]
    about = study["study"]["about"]
    headline = " ".join(f"{mass_sentence(mass)}." for mass in study["masses"]) or page.headline
    title, lead = f"Study {study['study']['name']}", f"{about} {page.lead}".strip()
    return replace(page, title=title, headline=headline, lead=lead, sections=sections)


def stages_grid(study: Json) -> Grid:
    """Every stage of every model: what it searched, with what, how far it came."""
    columns = [
        Column("model", "model"),
        Column("stage", "stage"),
        Column("optimizer", "optimizer"),
        Column("free", "free parameters", "", 3),
        Column("loss", "best RMSE", "N", 4),
        Column("evaluations", "parameter vectors", "", 6),
        Column("starts", "starts within 1 %"),
        Column("ending", "ended because"),
    ]
    rows = [_stage_row(model["name"], stage) for model in study["models"] for stage in model["stages"]]
    return Grid("Stages", columns, rows, csv_name="stages.csv")


def intervals_grid(model: Json) -> Grid:
    """The free parameters of a model with their 95 % intervals, of every kind that the study asked for.

    Tables of many knots are left to the result file.
    """
    knots = Counter(path.partition("[")[0] for path in model["parameters"])
    profiles = {profile["parameter"]: profile for profile in model["profiles"]}
    columns = [
        Column("parameter", "parameter"),
        Column("unit", "unit"),
        Column("value", "value", "", 4, interval="ends"),
        Column("interval", "95 % interval"),
        Column("bootstrap", "bootstrap of the runs"),
        Column("profile", "profile likelihood"),
    ]
    rows = [
        _interval_row(path, entry, model["bootstrap"].get(path), profiles.get(path))
        for path, entry in model["parameters"].items()
        if entry["role"] != "fixed" and entry["interval"] is not None and knots[path.partition("[")[0]] <= MOST_KNOTS
    ]
    used = [column for column in columns if any(row[column.key] is not None for row in rows)]
    return Grid(model["name"], used, rows, csv_name=f"{model['name']}.csv")


def ladder_grid(study: Json) -> Grid:
    """How each model stands beside the one before it."""
    columns = [
        Column("model", "model"),
        Column("before", "beside"),
        Column("adds", "has or searches besides"),
        Column("lacks", "does not search"),
        Column("train", "RMSE, training runs", "%", 3),
        Column("held_out", "RMSE, held-out runs", "%", 3),
    ]
    rows = [
        {
            "model": step["model"],
            "before": step["before"],
            "adds": ", ".join(step["adds"]) or None,
            "lacks": ", ".join(step["lacks"]) or None,
            **step["changes"],
        }
        for step in study["ladder"]
    ]
    used = [column for column in columns if any(row[column.key] is not None for row in rows)]
    caption = "From the model beside it to each model, and in which parameters, or whole branches, they differ."
    return Grid("Change of the RMSE", used, rows, caption, "ladder.csv")


def _ladder(study: Json) -> Section:
    reasons = [Notice("info", step["reason"]) for step in study["ladder"] if step["reason"]]
    return Section("From model to model", parts=[ladder_grid(study), *reasons] if study["ladder"] else [])


def _at_amplitude(study: Json, evidence: Evidence) -> Section:
    amplitude = study["study"]["amplitude"]
    if amplitude is None:
        return Section("", parts=[])
    curves = [
        curve
        for curve in evidence.get("dynamic_stiffness", ())
        if math.isclose(curve.get("amplitude") or 0.0, amplitude, rel_tol=ALIKE)
    ]
    best, last = best_model(study), study["study"]["compared"][-1:]
    parts = figures.stiffness_figures(curves, [best["name"], *last] if best else last) if curves else []
    return Section(f"Dynamic stiffness at {set_value(amplitude, 'm')}", parts=list(parts))


def _conduct(study: Json) -> Section:
    found = [Notice("info" if _is_settled(model) else "warning", convergence(model)) for model in study["models"]]
    return Section("How the models were identified", _held_out(study), [stages_grid(study), *found])


def convergence(model: Json) -> str:
    """Whether the search of a model came to an end that others find too, in words."""
    spread = next((stage["spread"] for stage in reversed(model["stages"]) if len(stage["spread"]) > 1), None)
    said = [_spread_in_words(spread) if spread else "one start only, so that other minima were not looked for"]
    said += [
        f"stage {stage['name']}: {stage['ending']}" for stage in model["stages"] if not stage.get("converged", True)
    ]
    idle = model.get("without_influence") or ()
    said.append(f"without influence: {', '.join(idle)}" if idle else "every parameter has influence")
    bound = model["at_bound"]
    said.append(f"at the end of its range: {', '.join(bound)}" if bound else "none is at the end of its range")
    return f"{model['name']}: {'; '.join(said)}."


def _spread_in_words(spread: Sequence[float]) -> str:
    best, others = min(spread), [loss for loss in spread if loss > ALIKE_LOSS * min(spread)]
    alike = len(spread) - len(others)
    again = f"{alike} of {len(spread)} starts converged to {number(best)} N within 1 %"
    if alike == 1:
        again = f"none of the other {len(others)} starts converged to {number(best)} N"
    return f"{again}, the nearest of the others ended at {number(min(others))} N" if others else again


def _is_settled(model: Json) -> bool:
    spreads = [stage["spread"] for stage in model["stages"] if len(stage["spread"]) > 1]
    lonely = bool(spreads) and _alike(spreads[-1]) == 1
    return not (lonely or model["at_bound"] or model.get("without_influence"))


def _alike(spread: Sequence[float]) -> int:
    return sum(loss <= ALIKE_LOSS * min(spread) for loss in spread)


def _held_out(study: Json) -> str:
    """Which runs are held out, and the RMSE of the models on them."""
    families: dict[tuple[str, ...], list[str]] = {}
    for model in study["models"]:
        rmse = model["rmse"] or {}
        errors = f"{model['name']} {number(rmse.get('held_out'))} N ({number(rmse.get('train'))} N)"
        families.setdefault(tuple(model.get("held_out") or ()), []).append(errors)
    return " ".join(
        f"Held out from all stages: {', '.join(names)}. RMSE on them (on training runs): {', '.join(errors)}."
        if names
        else "No run was held out for some models, whose RMSE is that of the training runs only."
        for names, errors in families.items()
    )


def _knowledge(study: Json) -> Section:
    text = (
        "Intervals are 95 % and take coloured noise into account. The condition number is that of the Fisher "
        "information in relative changes of the parameters: the larger, the stronger they are correlated."
    )
    return Section("Uncertainty of the parameters", text, [part for m in study["models"] for part in _known(m)])


def _known(model: Json) -> Iterator[Part]:
    grid = intervals_grid(model)
    condition = number(model["identifiability"]["condition"], 2)
    if grid.rows:
        yield replace(grid, caption=f"Condition number {condition}.")
    told = [f"{path} is at the end of its range" for path in model["at_bound"]]
    told += [*model["identifiability"]["weak"], *model["identifiability"]["may_go"]]
    if told:
        yield Notice("warning", f"{model['name']}: {'; '.join(told)}.")


def _stage_row(model: str, stage: Json) -> dict[str, Any]:
    spread = stage["spread"]
    alike = _alike(spread)
    return {
        "model": model,
        "stage": stage["name"],
        "optimizer": stage["optimizer"] or None,
        "free": len(stage["free"]),
        "loss": stage["loss"],
        "evaluations": stage["evaluations"],
        "starts": f"{alike} of {len(spread)}" if len(spread) > 1 else None,
        "ending": stage["remark"] or stage["ending"],
    }


def _interval_row(path: str, entry: Json, bootstrap: Any, profile: Json | None) -> dict[str, Any]:
    factor, unit = rig_unit(entry["unit"], abs(entry["value"]))
    return {
        "parameter": path,
        "unit": unit_per(unit, entry.get("per")) or None,
        "value": entry["value"] * factor,
        "ends": [factor * end for end in entry["interval"]],
        "interval": _pair(entry["interval"], factor),
        "bootstrap": _pair(bootstrap, factor) if bootstrap else None,
        "profile": _pair(profile["interval"], factor, profile["open"]) if profile else None,
    }


def _pair(pair: Any, factor: float, open_ends: Any = (False, False)) -> str:
    ends = [factor * side for side in pair]
    low, high = (number_within(end, ends, 4) for end in ends)
    return f"{'below ' * bool(open_ends[0])}{low} to {'above ' * bool(open_ends[1])}{high}"
