"""The part of a study's report that is about an axle: masses, contact forces, damper curves, quasi-static tests."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from dashpot.report import figures
from dashpot.report.evidence import Evidence
from dashpot.report.parts import Column, Grid, Notice, Part, Section
from dashpot.study.masses import mass_sentence, mass_warnings
from dashpot.text.digits import MISSING, number, quantity

Json = Mapping[str, Any]

OFF = 0.02  # share of the RMS of the force; test rigs for dampers repeat to about 1 %
FIXINGS = {"rigid": "rigid", "elastic": "in rubber"}


def axle_sections(study: Json, evidence: Evidence) -> list[Section]:
    """Sections in the order of the report; those that have nothing to show have no parts."""
    axle = study.get("axle") or {}
    slow = [figures.slow_curves(evidence["slow_curves"])] if evidence.get("slow_curves") else []
    return [
        Section("Masses", _MASSES if axle.get("wheels") else "", list(_masses(study))),
        Section("Wheel contact forces", parts=list(_contact(study, evidence))),
        Section("Damper curves", parts=list(_velocity(study))),
        Section("Quasi-static tests", parts=[*slow, *([slow_grid(axle)] if axle.get("slow_curves") else [])]),
    ]


_MASSES = (
    "With the tire: identified from the forces alone, through the model of the tire. Without the tire: the same model "
    "driven by the measured motion of the wheels, so that no error of the tire is left in it. An elastic fixing of the "
    "shock absorber that a model leaves out makes both too small."
)


def masses_grid(study: Json) -> Grid:
    """The identified masses of all models, with the tire and without."""
    columns = [
        Column("model", "model"),
        Column("node", "node"),
        Column("value", "mass", "kg", 5),
        Column("interval", "95 % interval"),
        Column("off", "off the reference", "%", 2),
        Column("without", "without the tire", "kg", 5),
        Column("without_interval", "its 95 % interval"),
        Column("rmse", "its RMSE", "N", 3),
    ]
    known = {each["parameter"]: each for each in study.get("references", ()) if "value" in each}
    rows = [
        _mass_row(model, mass, known.get(mass["parameter"])) for model in study["models"] for mass in model["masses"]
    ]
    used = [column for column in columns if any(row.get(column.key) is not None for row in rows)]
    names = {f"{mass['node']}: {_reference(mass)}." for mass in study["masses"] if mass["reference"]}
    caption = f"References, which no model has seen: {' '.join(sorted(names))}" if names else ""
    return Grid("Identified masses", used, rows, caption, "masses.csv")


def wheels_grid(axle: Json) -> Grid:
    """The masses of the wheels from contact force over wheel motion, without any model."""
    columns = [
        Column("node", "node"),
        Column("fixing", "fixing of the shock absorber taken as"),
        Column("value", "mass", "kg", 5),
        Column("interval", "95 % interval of the regression"),
        Column("rubber", "stiffness of the fixing"),
    ]
    rows = [
        {
            "node": wheel["node"],
            "fixing": FIXINGS[wheel["fixing"]],
            "value": wheel["value"],
            "interval": _pair(wheel["interval"]),
            "rubber": quantity(1.0 / wheel["compliance"], "N/m") if wheel["compliance"] > 0.0 else None,
        }
        for wheel in axle["wheels"]
    ]
    caption = (
        "Re(F / z) over the square of the frequency, all mass variants together. Neither a tire nor a damper curve is "
        "assumed; in rubber, damping is taken as proportional to speed, which a digressive curve is not."
    )
    return Grid("Masses without any model", columns, rows, caption, "wheels.csv")


def excited_grid(study: Json) -> Grid:
    """The knots of all curves over velocity, those that were not excited named."""
    columns = [
        Column("model", "model"),
        Column("curve", "curve"),
        Column("velocity", "velocity", "m/s", 3),
        Column("force", "force", "N", 4),
        Column("interval", "95 % interval", "N"),
    ]
    rows = [
        {
            "model": model["name"],
            "curve": curve["curve"],
            "velocity": velocity,
            "force": force if excited else None,
            "interval": _knot(low, high) if excited else "not excited",
        }
        for model in study["models"]
        for curve in model.get("velocity_curves", ())
        for velocity, force, low, high, excited in zip(
            curve["velocity"], curve["force"], curve["low"], curve["high"], curve["excited"], strict=True
        )
    ]
    return Grid("Knots of the damper curves", columns, rows, csv_name="velocity_curves.csv")


def deviations_grid(measured: Sequence[Json], models: Sequence[Json]) -> Grid:
    """How far identified and known curves of models are from those that were measured by other means."""
    columns = [
        Column("model", "model"),
        Column("curve", "curve"),
        Column("by", "measured by"),
        Column("within", "from and to", "m/s"),
        Column("rms", "RMS of the difference", "N", 3),
        Column("share", "of the RMS of the measured force", "%", 3),
    ]
    rows = [
        {
            "model": each["model"],
            "curve": reference["parameter"],
            "by": reference["by"],
            "within": _pair(each["within"]) if each["within"] else None,
            "rms": each["rms"],
            "share": None if each["share"] is None else 100.0 * each["share"],
        }
        for reference in measured
        for each in reference["deviations"]
    ]
    order = [model["name"] for model in models]
    rows.sort(key=lambda row: order.index(row["model"]))
    caption = "Over the velocities that the runs of a model reached and both tables hold, all alike."
    return Grid("Identified beside measured curves", columns, rows, caption, "measured_curves.csv")


def taken_as_known(study: Json) -> Iterator[str]:
    """Damper curves that a model does not search, where nothing tells that they are those of the specimen."""
    deviations = {
        (each["model"], reference["parameter"]): each["share"]
        for reference in study.get("references", ())
        for each in reference.get("deviations", ())
    }
    for model in study["models"]:
        for curve in model.get("velocity_curves", ()):
            share = deviations.get((model["name"], curve["curve"]))
            if curve["low"] != curve["high"] or (share is not None and share <= OFF):
                continue
            told = (
                "the data state no measured curve"
                if share is None
                else f"{number(100.0 * share, 2)} % off the measured"
            )
            yield (
                f"{model['name']} takes {curve['curve']} as known, {told}: its parameters hold if the curve in its "
                "file is that of this specimen."
            )


def slow_grid(axle: Json) -> Grid:
    """Spring rates and widths of the loops, measured and of every model."""
    columns = [
        Column("of", "of"),
        Column("left", "spring rate left", "N/mm", 4),
        Column("right", "spring rate right", "N/mm", 4),
        Column("heave", "friction force in phase", "N", 3),
        Column("bar", "anti-roll bar", "N/mm", 4),
        Column("roll", "friction force in anti-phase", "N", 3),
    ]
    rows = [
        {
            "of": each["of"],
            "left": 1e-3 * each["rate"][0],
            "right": 1e-3 * each["rate"][1],
            "heave": sum(each["half_width"]) / len(each["half_width"]),
            "bar": None if each["bar_rate"] is None else 1e-3 * each["bar_rate"],
            "roll": each["roll_half_width"],
        }
        for each in axle["slow_curves"]
    ]
    first = axle["slow_curves"][0]
    speeds = [
        f"{number(1e3 * each, 2)} mm/s {way}"
        for each, way in ((first["speed"], "in phase"), (first["roll_speed"], "in anti-phase"))
        if each
    ]
    caption = (
        f"Mean speed of the wheels: {' and '.join(speeds)}. The friction force is half the width of the loop, dampers "
        "at that speed included; the anti-roll bar adds its own friction in anti-phase. The rate of the bar is per "
        "difference of the wheels."
    )
    return Grid("Springs, friction and anti-roll bar", columns, rows, caption, "slow_curves.csv")


def disagreements(study: Json) -> Iterator[str]:
    """What the masses say about one another, and what their intervals take for granted, in words."""
    for mass in study["masses"]:
        yield from (f"{text}." for text in mass_warnings(mass))
    for row in masses_grid(study).rows:
        if row.get("without") is not None:
            yield _tire_sentence(row)
    yield from _fixings(study.get("axle") or {})


def _masses(study: Json) -> Iterator[Part]:
    grid = masses_grid(study)
    if not grid.rows:
        return
    yield from (Notice("info", f"{mass_sentence(mass)}.") for mass in study["masses"])
    yield grid
    if (study.get("axle") or {}).get("wheels"):
        yield wheels_grid(study["axle"])
    yield from (Notice("info" if "agree within" in text else "warning", text) for text in disagreements(study))


def _contact(study: Json, evidence: Evidence) -> Iterator[Part]:
    if evidence.get("contact_response"):
        compared = study["study"]["compared"]
        yield figures.contact_response(evidence["contact_response"], compared[-1:])
        if len(compared) > 1:
            yield figures.contact_models(evidence["contact_response"])


def _velocity(study: Json) -> Iterator[Part]:
    several = any(len(model.get("velocity_curves", ())) > 1 for model in study["models"])
    curves = {
        f"{model['name']}, {curve['curve']}" if several else model["name"]: curve
        for model in study["models"]
        for curve in model.get("velocity_curves", ())
    }
    if curves:
        paths = {curve["curve"] for curve in curves.values()}
        measured = [each for each in study.get("references", ()) if each["parameter"] in paths]
        points = {f"{each['parameter']}, {each['by']}" if several else each["by"]: each for each in measured}
        yield figures.velocity_curves(curves, points)
        if measured:
            yield deviations_grid(measured, study["models"])
        yield from (Notice("warning", text) for text in taken_as_known(study))
        yield excited_grid(study)


def _reference(mass: Json) -> str:
    return f"{number(mass['reference']['value'], 4)} kg {mass['reference']['by']}"


def _mass_row(model: Json, mass: Json, known: Json | None) -> dict[str, Any]:
    without = next((each for each in model.get("masses_without_tire", ()) if each["node"] == mass["node"]), None)
    row = {
        "model": model["name"],
        "node": mass["node"],
        "value": mass["value"],
        "interval": _pair(mass["interval"]) if mass["interval"] else None,
        "within": mass["interval"],
        "off": 100.0 * (mass["value"] / known["value"] - 1.0) if known else None,
    }
    if without is None:
        return row
    return row | {
        "without": without["value"],
        "without_interval": _pair(without["interval"]),
        "rmse": without["rmse"],
        "without_within": without["interval"],
    }


def _tire_sentence(row: Mapping[str, Any]) -> str:
    apart = row["value"] - row["without"]
    allowed = math.hypot(_half(row["within"]), _half(row["without_within"]))
    both = (
        f"{row['node']} with {row['model']}: {number(row['value'], 4)} kg with the tire and "
        f"{number(row['without'], 4)} kg without it"
    )
    if abs(apart) <= allowed:
        return f"{both} agree within their intervals."
    share = number(100.0 * abs(apart) / row["value"], 2)
    return (
        f"{both} disagree by {number(abs(apart), 2)} kg ({share} %), where the intervals allow "
        f"{number(allowed, 2)} kg. The model of the tire, a gain or a delay between the channels, or the structure "
        "of the axle is not as assumed; the value without the tire does not depend on the first."
    )


def _fixings(axle: Json) -> Iterator[str]:
    wheels = axle.get("wheels", ())
    for node in dict.fromkeys(wheel["node"] for wheel in wheels):
        rigid, elastic = (
            next((w for w in wheels if w["node"] == node and w["fixing"] == fixing), None) for fixing in FIXINGS
        )
        if rigid is None or elastic is None or elastic["compliance"] <= 0.0:
            continue
        if elastic["value"] - rigid["value"] > math.hypot(_half(rigid["interval"]), _half(elastic["interval"])):
            rubber = quantity(1.0 / elastic["compliance"], "N/m", 2)
            yield (
                f"{node}: the wheel moves as if its shock absorber stood in rubber of about {rubber}. A model that "
                "takes the fixing as rigid finds the mass too small, by about "
                f"{number(elastic['value'] - rigid['value'], 2)} kg or more."
            )


def _half(pair: Sequence[float] | None) -> float:
    return 0.5 * (pair[1] - pair[0]) if pair else 0.0


def _pair(pair: Sequence[float]) -> str:
    return f"{number(pair[0], 4)} to {number(pair[1], 4)}"


def _knot(low: float, high: float) -> str:
    return MISSING if low == high else f"{number(low, 3)} to {number(high, 3)}"
