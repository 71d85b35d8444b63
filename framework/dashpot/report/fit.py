"""The report of a single fit: how good it is, the identified parameters, and where the residual is."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from dashpot.report import figures
from dashpot.report.colophon import colophon
from dashpot.report.comparison import closeness, frequency_parts, shape_parts, signal_parts
from dashpot.report.evidence import Evidence
from dashpot.report.grids import floor_origin, floor_value, runs_grid
from dashpot.report.headline import RUNS
from dashpot.report.parts import Code, Column, Grid, KeyFigures, Notice, Page, Part, Picture, Section
from dashpot.report.patch import diff
from dashpot.report.posterior import TEXT, posterior_parts
from dashpot.text.digits import rig_unit, shown_with_unit, unit_per

Json = Mapping[str, Any]

GOOD_RATIO = 1.2
CONTRADICTION = 3.0  # deviations of a prior
PRIORS = "100 % in the last column: the data add nothing to the prior. A small one: they decide, the prior does not."


def fit_page(fit: Json, comparison: Json, evidence: Evidence) -> Page:
    """The report of a `dashpot-fit/1`; ``comparison`` is the `dashpot-comparison/1` of this model alone.

    Used keys of the evidence: those of a comparison, `patch`, the text before and after, and `draws` of a posterior.
    """
    numbers: list[Part] = [grid for grid in (numbers_grid(fit), replace(knots_grid(fit), folded=True)) if grid.rows]
    numbers += [figures.identified_curves(evidence["curves"])] if evidence.get("curves") else []
    sections = [
        Section("Result", parts=list(_result(fit, comparison["models"][0]["status"], evidence))),
        Section("Parameters", _ending(fit), parts=numbers),
        Section("Priors", PRIORS, parts=[priors_grid(fit)] if fit.get("priors") else []),
        Section("Posterior", TEXT, list(posterior_parts(fit, evidence.get("draws"))) if "posterior" in fit else []),
        Section("Over frequency and amplitude", parts=list(frequency_parts(evidence))),
        Section("The shape of the force", parts=list(shape_parts(evidence))),
        Section("Over displacement and time", parts=list(signal_parts(evidence))),
        Section("The runs", parts=[runs_grid(comparison)]),
        Section("The model", parts=list(_model(fit, evidence))),
    ]
    return Page(
        title=f"Fit of {fit['model']} to {fit['dataset']['name']}",
        headline=fit_headline(fit),
        lead=_lead(fit),
        sections=[section for section in sections if section.parts],
        colophon=colophon({**fit, "model": {"name": fit["model"]}}, evidence),
        summary=("Identified parameters", "Dynamic stiffness and loss angle"),
    )


def fit_headline(fit: Json) -> str:
    """The error on unseen runs against what the measurement can resolve."""
    return f"{fit['model']}: RMSE {closeness(fit['rmse'][_judged_on(fit)], floor_value(fit))}"


def numbers_grid(fit: Json) -> Grid:
    """Every number that was searched, but knots: its value, 95 % interval, and what is to be said of it."""
    return _grid(fit, "Identified parameters", "numbers.csv", knots=False)


def priors_grid(fit: Json) -> Grid:
    """What was known before, and what the data made of it."""
    rows = []
    for prior in fit["priors"]:
        factor, unit = rig_unit(prior["unit"], abs(prior["middle"]))
        scale = 100.0 if prior["law"] == "lognormal" else factor
        rows.append(
            {
                "number": prior["parameter"],
                "law": prior["law"],
                "middle": prior["middle"] * factor,
                "deviation": prior["deviation"] * scale,
                "of": "%" if prior["law"] == "lognormal" else unit,
                "value": prior["value"] * factor,
                "unit": unit or None,
                "pull": prior["pull"],
                "narrowed": 100.0 * prior["narrowed"],
                "source": prior["source"],
            }
        )
    columns = [
        Column("number", "parameter"),
        Column("law", "prior"),
        Column("middle", "middle", "", 4),
        Column("value", "identified", "", 4),
        Column("unit", "unit"),
        Column("deviation", "deviation", "", 3),
        Column("of", "in"),
        Column("pull", "identified less middle, in deviations", "", 2),
        Column("narrowed", "standard error over deviation, %", "", 3),
        Column("source", "from"),
    ]
    used = [column for column in columns if any(row[column.key] is not None for row in rows)]
    return Grid("Priors", used, rows, csv_name="priors.csv")


def knots_grid(fit: Json) -> Grid:
    """The knots and coefficients of the curves, likewise."""
    return _grid(fit, "Knots and coefficients of the curves", "knots.csv", knots=True)


def _grid(fit: Json, title: str, file: str, knots: bool) -> Grid:
    columns = [
        Column("number", "parameter"),
        Column("value", "value", "", 4, interval="interval"),
        Column("low", "95 % from", "", 4, interval="interval"),
        Column("high", "to", "", 4, interval="interval"),
        Column("unit", "unit"),
        Column("remark", "remark"),
    ]
    remarks = dict.fromkeys(fit["at_bound"], "at the end of its range: widen its bounds or drop it")
    remarks |= dict.fromkeys(
        (fit.get("identifiability") or {}).get("undetermined", ()), "not identifiable from these data"
    )
    remarks |= dict.fromkeys(fit["without_influence"], "without influence on these data")
    found = {
        path: entry
        for path, entry in fit["parameters"].items()
        if (entry["role"] != "fixed" or "expression" in entry) and ("[" in path) is knots
    }
    remarks |= {path: f"= {entry['expression']}" for path, entry in found.items() if "expression" in entry}
    unknown = {*fit["without_influence"], *(fit.get("identifiability") or {}).get("undetermined", ())}
    rows = [
        {"number": path, **_in_rig_units(entry, path not in unknown), "remark": remarks.get(path)}
        for path, entry in found.items()
    ]
    used = [column for column in columns if any(row[column.key] is not None for row in rows)]
    return Grid(title, used or columns[:2], rows, csv_name=file)


def _in_rig_units(entry: Json, known: bool) -> dict[str, Any]:
    factor, unit = rig_unit(entry["unit"], abs(entry["value"]))
    # the interval of a number that the data do not determine is all that was searched
    interval = [end * factor for end in entry["interval"]] if known and entry["interval"] else None
    low, high = interval or (None, None)
    return {
        "value": entry["value"] * factor,
        "low": low,
        "high": high,
        "interval": interval,
        "unit": unit_per(unit, entry.get("per")) or None,
    }


def _result(fit: Json, status: str, evidence: Evidence) -> Iterator[Part]:
    errors = [("error on held-out runs", "held_out"), ("error on training runs", "train")]
    shown = [(label, *shown_with_unit(fit["rmse"][key], "N"), "RMSE") for label, key in errors if fit["rmse"][key]]
    floor = floor_value(fit)
    if floor is not None:
        shown.append(("noise floor", *shown_with_unit(floor, "N"), f"from {fit['noise_floor']['from']}"))
    yield KeyFigures(shown)
    if status != "ok":
        yield Notice("warning", f"The fit did not converge: {status}.")
    yield from (Notice("warning", text) for text in evidence.get("warnings", ()))
    yield from (Notice("warning", text) for text in _contradictions(fit))
    if floor and fit["rmse"][_judged_on(fit)] > GOOD_RATIO * floor:
        yield Notice("info", "The error is above the noise floor: 'dashpot diagnose' says what the model lacks.")


def _contradictions(fit: Json) -> Iterator[str]:
    for prior in fit.get("priors", ()):
        if abs(prior["pull"]) > CONTRADICTION:
            yield (
                f"The data contradict the prior of {prior['parameter']}: the fit is {abs(prior['pull']):.2g} of its "
                "deviations away. Check the prior, its unit, and whether the model fits the data."
            )


def _model(fit: Json, evidence: Evidence) -> Iterator[Part]:
    yield from (Picture(title, svg) for title, svg in evidence.get("schematic", {}).items())
    patch = evidence.get("patch")
    if patch:
        title = f"{patch['before_name']} → {patch['after_name']}"
        yield Code(title, diff(patch["before"], patch["after"]), "diff", patch["after_name"], patch["after"])
    if evidence.get("history"):
        yield figures.convergence_history(evidence["history"])


def _ending(fit: Json) -> str:
    spread = fit["spread"]
    alike = sum(loss <= 1.01 * spread[0] for loss in spread)
    starts = f" {alike} of {len(spread)} starts end within 1 % of the best." if len(spread) > 1 else ""
    return f"{fit['evaluations']} parameter vectors were tried.{starts}"


def _lead(fit: Json) -> str:
    held_out = len(fit["held_out"])
    trained = len(fit["per_run"]) - held_out
    judged = f", {held_out} others held out" if held_out else ""
    searched = sum(entry["role"] != "fixed" for entry in fit["parameters"].values())
    found = f"{searched} parameters identified on {trained} runs by {fit['optimizer']}{judged}."
    return f"{found} {floor_origin(fit)}".strip()


def _judged_on(fit: Json) -> str:
    return next(key for key in RUNS if fit["rmse"].get(key) is not None)
