"""The report of a look at measured runs, before any model."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from dashpot.report import figures
from dashpot.report.colophon import colophon
from dashpot.report.evidence import Evidence
from dashpot.report.faults import told_faults
from dashpot.report.figures import excerpt
from dashpot.report.grids import explainable_origin, explainable_value, floor_origin, floor_value, metrics_grid
from dashpot.report.parts import Column, Figure, Grid, KeyFigures, Notice, Page, Part, Section
from dashpot.report.readable import join
from dashpot.report.shapes import shape_figures
from dashpot.text.digits import beside, quantity, shown_with_unit

Json = Mapping[str, Any]

POINTS = 1200
ENERGIES = {"J": 1.0, "mJ": 1e-3}
# for a terminal
FEW = ("run", "amplitude", "peak_speed", "least_force", "largest_force", "energy", "stiffness", "loss", "remark")

COLUMNS = (
    Column("run", "run"),
    Column("amplitude", "amplitude", "mm", 3),
    Column("preload", "middle", "mm", 3),
    Column("peak_speed", "largest speed", "mm/s", 3),
    Column("least_force", "least force", "N", 3),
    Column("largest_force", "largest force", "N", 3),
    Column("cycles", "closed cycles", "", 3),
    Column("energy", "energy per cycle", "J", 3),
    Column("stiffness", "stiffness", "N/mm", 3),
    Column("loss", "loss stiffness", "N/mm", 3),
    Column("remark", "remark"),
)


def look_page(look: Json, evidence: Evidence) -> Page:
    """The report of a `dashpot-look/1`: `loops`, `shapes`, `spectra`, `repeats`, `dynamic_stiffness`.

    See `compare.look.Look.evidence` for shapes and units.
    """
    sections = (
        Section("The runs", parts=list(_result(look, evidence))),
        Section("Over displacement and velocity", parts=[figures.loops(**evidence["loops"])]),
        Section("The shape of the force", parts=list(shape_figures(evidence["shapes"]))),
        Section("Over frequency", parts=list(_over_frequency(evidence))),
        Section("Repeats", parts=list(_repeats(evidence))),
    )
    return Page(
        title=f"A look at {look['dataset']['name']}",
        headline=look_headline(look),
        lead=" ".join(filter(None, [f"{len(look['runs'])} runs.", floor_origin(look), explainable_origin(look)])),
        sections=[section for section in sections if section.parts],
        colophon=colophon(look, evidence),
    )


def look_figures(evidence: Evidence) -> list[Figure]:
    """All figures of the report."""
    return [
        figures.loops(**evidence["loops"]),
        *shape_figures(evidence["shapes"]),
        *_over_frequency(evidence),
        *_repeats(evidence),
    ]


def look_headline(look: Json) -> str:
    """What is wrong with the runs, or what is to be explained."""
    if look["faults"]:
        return " ".join(f"{runs[0].upper()}{runs[1:]}: {what}." for runs, what in told_faults(look["faults"]))
    wrong = [run["run"] for run in look["runs"] if run["gives_back"]]
    if wrong:
        gives = "gives" if len(wrong) == 1 else "give"
        return f"{join(wrong)} {gives} back energy over closed cycles: check signs, swapped channels and delays."
    forces = [abs(run[key]) for run in look["runs"] for key in ("least_force", "largest_force")]
    floor, explainable = floor_value(look), explainable_value(look)
    told = [f"Forces up to {quantity(max(forces), 'N')}"]
    told += [f"noise floor {quantity(floor, 'N')}"] if floor else []
    told += [f"explainable error {quantity(explainable, 'N')}"] if explainable else []
    return f"{'; '.join(told)}."


def look_grid(look: Json, keys: Sequence[str] = ()) -> Grid:
    """The runs in numbers, with what their closed cycles take up; of the columns those in `keys`, or all."""
    faults = {fault["run"]: fault["kind"].replace("_", " ") for fault in look["faults"]}
    unit = _energy_unit(look["runs"])
    rows = [_row(run, faults.get(run["run"], ""), ENERGIES[unit]) for run in look["runs"]]
    columns = [replace(column, unit=unit) if column.key == "energy" else column for column in COLUMNS]
    chosen = [column for column in columns if not keys or column.key in keys]
    used = [column for column in chosen if any(row.get(column.key) is not None for row in rows)]
    caption = "Energy per cycle is the mean over closed cycles; positive: the specimen takes up work."
    return Grid("The runs", used, rows, caption, "runs.csv")


def _energy_unit(runs: Sequence[Json]) -> str:
    """The unit that suits the largest energy of a cycle."""
    largest = max((abs(run["energy_per_cycle"] or 0.0) for run in runs), default=0.0)
    return next((name for name, size in ENERGIES.items() if largest >= 0.1 * size), "mJ")


def _row(run: Json, fault: str, unit: float) -> dict[str, Any]:
    remarks = [
        fault,
        f"repeats {run['repeats']}" if run["repeats"] else "",
        "gives back work" if run["gives_back"] else "",
    ]
    thousandth = {key: None if run[key] is None else 1e-3 * run[key] for key in ("stiffness", "loss")}
    middle = beside(run["preload"], run["amplitude"])
    in_mm = {"preload": 1e3 * middle, **{key: 1e3 * run[key] for key in ("amplitude", "peak_speed")}}
    return {
        **run,
        **in_mm,
        **thousandth,
        "energy": None if run["energy_per_cycle"] is None else run["energy_per_cycle"] / unit,
        "remark": ", ".join(filter(None, remarks)) or None,
    }


def _result(look: Json, evidence: Evidence) -> Iterator[Part]:
    shown = [("runs", str(len(look["runs"])), "", "")]
    for name, value in (("explainable", explainable_value(look)), ("noise floor", floor_value(look))):
        if value is not None:
            shown.append((name, *shown_with_unit(value, "N"), ""))
    yield KeyFigures(shown)
    yield look_grid(look)
    if look["metrics"]:
        yield metrics_grid(look)
    yield from (Notice("warning", text) for text in evidence.get("warnings", ()))


def _over_frequency(evidence: Evidence) -> Iterator[Figure]:
    if evidence.get("dynamic_stiffness"):
        yield from figures.stiffness_figures(evidence["dynamic_stiffness"], ())
    for of in ("force", "displacement"):
        curves = [curve for curve in evidence["spectra"] if curve["of"] == of]
        yield figures.shape_figure(f"{of}_spectrum", curves, evidence["shapes"])


def _repeats(evidence: Evidence) -> Iterator[Figure]:
    curves = []
    for group in evidence["repeats"]:
        for name, departure in zip(group["runs"], group["departure"], strict=True):
            kept = excerpt.envelope([departure], POINTS)
            curves.append({"run": name, "label": "measured", "x": group["sample_time"] * kept, "y": departure[kept]})
    if curves:
        yield figures.shape_figure("repeats", curves, evidence["shapes"])
