"""The tables of the result files, ready for page, terminal and CSV."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from dashpot.report.parts import Column, Grid
from dashpot.report.readable import join, percent_interval
from dashpot.text.digits import number, rig_unit, unit_per, with_interval

Json = Mapping[str, Any]

ERROR_COLUMNS = (
    Column("train", "RMSE train", "N", 3),
    Column("held_out", "RMSE held-out", "N", 3),
    Column("all", "RMSE all", "N", 3),
    Column("nrmse", "NRMSE held-out", "%", 3),
    Column("ratio", "held-out / noise floor", "", 3),
)
UNIT = Column("unit", "unit")


def comparison_grid(comparison: Json) -> Grid:
    """Every model of a `dashpot-comparison/1`, next to the explainable error and the noise floor."""
    floor = floor_value(comparison)
    rows = [_model_row(model, floor) for model in comparison["models"]]
    if explainable_value(comparison) is not None:
        rows.append(_explainable_row(comparison, floor))
    if floor is not None:
        rows.append({"name": "noise floor", "train": floor, "held_out": floor, "all": floor, "ratio": 1.0})
    columns = [Column("name", "model"), Column("free", "free parameters", "", 3), *ERROR_COLUMNS]
    used = [column for column in columns if any(row.get(column.key) is not None for row in rows)]
    remarks = [floor_origin(comparison), explainable_origin(comparison), *_remarks(comparison["models"])]
    caption = " ".join(filter(None, remarks))
    return Grid("Models against the measurement", used, rows, caption, "models.csv")


def runs_grid(comparison: Json) -> Grid:
    """RMSE of every model on every run of a `dashpot-comparison/1`."""
    models = comparison["models"]
    runs = list(dict.fromkeys(run for model in models for run in model.get("per_run", {})))
    held_out = (comparison.get("dataset") or {}).get("held_out") or ()
    part = [Column("part", "used for")] if held_out else []
    columns = [Column("run", "run"), *part] + [Column(f"model {i}", m["name"], "N", 3) for i, m in enumerate(models)]
    rows = [
        {"run": run, "part": "hold-out" if run in held_out else "training"}
        | {f"model {i}": model.get("per_run", {}).get(run) for i, model in enumerate(models)}
        for run in runs
    ]
    return Grid("RMSE run by run", columns, rows, csv_name="runs.csv")


def metrics_grid(comparison: Json) -> Grid:
    """The metrics of the runs of a `dashpot-comparison/1`, measured and by every model."""
    told = comparison.get("metrics") or ()
    labels = list(dict.fromkeys(label for row in told for label in row["models"]))
    columns = [Column("metric", "metric"), Column("run", "run"), UNIT, Column("measured", "measured", "", 4)]
    columns += [Column(f"model {i}", label, "", 4) for i, label in enumerate(labels)]
    rows = [
        {key: row[key] for key in ("metric", "run", "unit", "measured")}
        | {f"model {i}": row["models"].get(label) for i, label in enumerate(labels)}
        for row in told
    ]
    return Grid("Metrics", columns, rows, csv_name="metrics.csv")


def parameters_grid(comparison: Json) -> Grid:
    """The identified parameters, a column for each model, in rig units where the file says the unit."""
    models = [model for model in comparison["models"] if model.get("parameters")]
    names = sorted(_in_order([list(model["parameters"]) for model in models]), key=_is_knot)
    columns = [Column("parameter", "parameter"), UNIT]
    columns += [Column(f"model {i}", model["name"], "", 4, interval=f"interval {i}") for i, model in enumerate(models)]
    rows = [_parameter_row(name, [model["parameters"].get(name) for model in models]) for name in names]
    return Grid("Identified parameters", columns, rows, csv_name="parameters.csv")


def _is_knot(path: str) -> bool:
    """Whether a path is one of many numbers of a curve; these come last."""
    return "[" in path


def cause_grid(diagnosis: Json) -> Grid:
    """The suspected causes of a `dashpot-diagnosis/1`, ranked, with evidence, expected and realised gain."""
    return _causes(diagnosis, "Candidate causes", diagnosis["causes"])


def named_grid(diagnosis: Json) -> Grid:
    """The causes that a diagnosis tells: the accepted and the probable ones."""
    return _causes(diagnosis, "Causes", [cause for cause in diagnosis["causes"] if is_likely(cause)])


def unnamed_grid(diagnosis: Json) -> Grid:
    """The causes that were suspected and explain less."""
    causes = [cause for cause in diagnosis["causes"] if not is_likely(cause)]
    return replace(
        _causes(diagnosis, "Candidates with a probability below 50 %", causes), folded=True, csv_name="suspected.csv"
    )


def is_likely(cause: Json) -> bool:
    """Whether a cause is accepted, or more likely than not."""
    return bool(cause.get("accepted")) or cause.get("standing") == "probable"


def _causes(diagnosis: Json, title: str, causes: Sequence[Json]) -> Grid:
    columns = [
        Column("rank", "rank", "", 1),
        Column("cause", "cause"),
        Column("found", "verdict"),
        Column("evidence", "evidence"),
        Column("gain", "gain held-out", "%", 2, interval="ends"),
        Column("interval", "interval", "%"),
        Column("parameters", "parameters"),
        Column("confused", "indistinguishable from"),
    ]
    rows = [_cause_row(cause, diagnosis) for cause in causes]
    used = [column for column in columns if any(row[column.key] is not None for row in rows)]
    return Grid(title, used, rows, csv_name="causes.csv")


def misfit_grid(diagnosis: Json) -> Grid:
    """Significant misfits, in words, with its share of the error and where it is."""
    columns = [Column("what", "what"), Column("share", "share of the error", "%", 2), Column("where", "where")]
    rows = [
        {"what": item["what"], "share": _percent(item.get("share")), "where": _where(item.get("where"))}
        for item in diagnosis["misfit"]
    ]
    return Grid("Significant misfits", columns, rows, csv_name="misfit.csv")


def limits_grid(limits: Sequence[Json]) -> Grid:
    """The detection limit of each cause at 95 % power; see `Evidence.limits`."""
    columns = [
        Column("cause", "cause"),
        Column("quantity", "smallest"),
        Column("value", "value", "", 3),
        UNIT,
        Column("force", "force RMS", "N", 3),
        Column("left", "unabsorbed RMS", "N", 3),
    ]
    rows = [
        {
            "cause": cause_title(limit),
            "quantity": limit["quantity"],
            "force": limit.get("force"),
            "left": limit.get("left"),
            **_in_rig_units(limit["value"], limit["unit"]),
        }
        for limit in limits
    ]
    return Grid("Detection limits at 95 % power", columns, rows, csv_name="limits.csv", folded=True)


def rejected_grid(rejected: Sequence[Json]) -> Grid:
    """What was tried and did not hold, with the reason; see `Evidence.rejected`."""
    columns = [
        Column("cause", "tried"),
        Column("reason", "rejected because"),
        Column("gain", "gain held-out", "%", 2),
    ]
    rows = [
        {
            "cause": cause_title(item),
            "reason": item["reason"],
            "gain": _percent(item.get("gain")),
        }
        for item in rejected
    ]
    return Grid("Rejected candidates", columns, rows, csv_name="rejected.csv", folded=True)


def cause_name(cause: Json) -> str:
    """The cause in the engineer's words: its `title` where its plugin gave one, else its word."""
    return cause.get("title") or cause["cause"].replace("_", " ")


def cause_title(cause: Json) -> str:
    """The same with its `place` in the network, where it has one."""
    return " ".join(filter(None, [cause_name(cause), cause.get("place")]))


def parameter_texts(cause: Json) -> list[str]:
    """Every parameter of the cause with its interval, in rig units where the file says the unit; curves by name."""
    found = cause.get("parameters") or {}
    curves = dict.fromkeys(path.partition("[")[0] for path in found if _is_knot(path))
    return [f"{name.replace('_', ' ')} {size_of(entry)}" for name, entry in found.items() if not _is_knot(name)] + [
        f"the curve {path.replace('_', ' ')}" for path in curves
    ]


def size_of(entry: Json) -> str:
    """A parameter of a result file with its interval, and a word where that leaves its sign or size open."""
    size = with_interval(entry["value"], entry.get("interval"), entry.get("unit") or "", entry.get("per") or "")
    return size if is_determined(entry) else f"{size}, not determined by these runs"


def is_determined(entry: Json) -> bool:
    """Whether the runs tell a parameter of a result file; fixed ones count as known."""
    return entry.get("determined") is not False


def floor_value(result: Json) -> float | None:
    """The noise floor of a result file in N, None where it has none."""
    return (result.get("noise_floor") or {}).get("value")


def floor_origin(result: Json) -> str:
    """Where the noise floor comes from, as a sentence; empty without one."""
    origins = {
        "repeats": "The noise floor is what repeated runs differ by.",
        "residual": "The noise floor is estimated from the residual: there are no repeated runs.",
    }
    return origins.get((result.get("noise_floor") or {}).get("from") or "", "")


def floor_note(result: Json) -> str:
    """What the noise floor bounds: no bound where a general model leaves less than that."""
    floor, explainable = floor_value(result), explainable_value(result)
    if floor is None or explainable is None or explainable >= floor:
        return "no model gets below"
    repeated = (result.get("noise_floor") or {}).get("from") == "repeats"
    more = "repeats differ by more" if repeated else "more"
    return f"{more} than a general model leaves, so {'repeats hold' if repeated else 'it holds'} more than noise"


def explainable_value(result: Json) -> float | None:
    """The error in N that a general model leaves on runs that it did not see, None where there is none."""
    told = result.get("explainable") or {}
    return told.get("cross_validated") if told.get("held_out") is None else told["held_out"]


def cross_validated(result: Json) -> str:
    """What the explainable error is where no run was held out, behind its name; empty where one was."""
    told = result.get("explainable") or {}
    return " in cross-validation" if told.get("held_out") is None else ""


def explainable_origin(result: Json) -> str:
    """What the explainable error is and how far it can be trusted, in sentences; empty without one."""
    told = result.get("explainable") or {}
    if explainable_value(result) is None:
        return f"No explainable error: {told['reason']}." if told.get("reason") else ""
    kind = "ridge regression" + (" and boosted trees" if told.get("by") == "boosting" else "")
    seen = (
        ""
        if told.get("held_out") is not None
        else (
            "No run is held out: the RMSE of cross-validation over training runs is "
            f"{number(told['cross_validated'])} N."
        )
    )
    remarks = [f"The explainable error is the RMSE of a general model of the past motion ({kind}).", seen]
    return " ".join(filter(None, [*remarks, *(told.get("remarks") or ())]))


def _explainable_row(comparison: Json, floor: float | None) -> dict[str, Any]:
    told = comparison["explainable"]
    errors = {key: told.get(key) for key in ("train", "held_out")}
    ratio = errors["held_out"] / floor if errors["held_out"] is not None and floor else None
    return {"name": "explainable", **errors, "ratio": ratio}


def _model_row(model: Json, floor: float | None) -> dict[str, Any]:
    rmse, nrmse = model["rmse"] or {}, model.get("nrmse") or {}
    held_out = rmse.get("held_out")
    return {
        "name": model["name"],
        "free": _free_count(model.get("parameters")),
        **{key: rmse.get(key) for key in ("train", "held_out", "all")},
        "nrmse": _percent(nrmse.get("held_out")),
        "ratio": held_out / floor if held_out is not None and floor else None,
    }


def _free_count(parameters: Mapping[str, Any] | None) -> int | None:
    if not parameters:
        return None
    roles = [entry.get("role") if isinstance(entry, Mapping) else None for entry in parameters.values()]
    return sum(role != "fixed" for role in roles)


def _remarks(models: Sequence[Json]) -> list[str]:
    """What is to be known of fits that did not come to a good end."""
    return [f"{m['name']}: {m['status'].rstrip('.')}." for m in models if m.get("status") not in (None, "ok")]


def _in_order(lists: Sequence[Sequence[str]]) -> list[str]:
    """All names once; a name that only later lists have comes after the one before it there."""
    found: list[str] = []
    for names in lists:
        place = 0
        for name in names:
            if name not in found:
                found.insert(place, name)
            place = found.index(name) + 1
    return found


def _parameter_row(name: str, entries: Sequence[Any]) -> dict[str, Any]:
    """A parameter of all models with its intervals, in the unit that suits the largest of them."""
    described = [entry if isinstance(entry, Mapping) else {"value": entry} for entry in entries]
    unit = next((entry["unit"] for entry in described if entry.get("unit")), "")
    known = [abs(entry["value"]) for entry in described if entry["value"] is not None]
    factor, shown = rig_unit(unit, max(known, default=0.0))
    per = next((entry["per"] for entry in described if entry.get("per")), None)
    row: dict[str, Any] = {"parameter": name, "unit": unit_per(shown, per) or None}
    for i, entry in enumerate(described):
        row[f"model {i}"] = None if entry["value"] is None else entry["value"] * factor
        row[f"interval {i}"] = [end * factor for end in entry.get("interval") or ()]
    return row


def _in_rig_units(value: float | None, unit: str | None) -> dict[str, Any]:
    if value is None or unit is None:
        return {"value": None, "unit": None}
    factor, name = rig_unit(unit, value)
    return {"value": value * factor, "unit": name or None}


def _cause_row(cause: Json, diagnosis: Json) -> dict[str, Any]:
    others = [_title_of(word, diagnosis) for word in cause.get("indistinguishable_from") or ()]
    others = [cause_title(other) for other in cause.get("alternatives") or ()] or others
    return {
        "rank": cause.get("rank"),
        "cause": cause_title(cause) + (" (measurement)" if cause.get("class") == "measurement" else ""),
        "found": _found(cause),
        "evidence": cause.get("evidence"),
        "gain": _percent(cause.get("gain")),
        "interval": percent_interval(cause.get("gain_interval")),
        "ends": [100.0 * end for end in cause.get("gain_interval") or ()],
        "parameters": join(parameter_texts(cause)) if cause.get("parameters") else None,
        "confused": join(others) if others else None,
    }


def _found(cause: Json) -> str:
    rivals = " (it or a rival)" * bool(cause.get("indistinguishable_from"))
    if cause.get("accepted"):
        return f"accepted{rivals}"
    return f"probable{rivals}" if is_likely(cause) else "resembles it, less likely than not"


def _title_of(word: str, diagnosis: Json) -> str:
    return cause_title(next((cause for cause in diagnosis["causes"] if cause["cause"] == word), {"cause": word}))


def _where(where: Any) -> str | None:
    if isinstance(where, Mapping):
        return "; ".join(f"{key.replace('_', ' ')}: {value}" for key, value in where.items()) or None
    return where


def _percent(share: float | None) -> float | None:
    return None if share is None else 100.0 * share
