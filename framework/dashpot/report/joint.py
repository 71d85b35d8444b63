"""The report of a joint fit: what the specimens share, what it costs each of them, and their own parameters."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from dashpot.report.colophon import colophon
from dashpot.report.fit import numbers_grid
from dashpot.report.parts import Column, Grid, KeyFigures, Notice, Page, Part, Section
from dashpot.report.readable import counted_words, join
from dashpot.text.digits import rig_unit

Json = Mapping[str, Any]

LEAST = 0.01  # per cent that are told
UNLIKELY = 0.01  # the specimens contradict one another
SHARED = (
    "The last column is how often chance alone would make the specimens differ as much as their own fits do "
    "(Cochran's Q)."
)
COST = "RMSE of each specimen by itself and with the parameters in common; a large step says that they are not common."


def joint_page(content: Json) -> Page:
    """The report of a `dashpot-joint-result/1`."""
    own = [
        Section(name, parts=[grid])
        for name, fit in content["specimens"].items()
        if (grid := _titled(numbers_grid(fit), name)).rows
    ]
    sections = [
        Section("Result", parts=[_tiles(content), *_notices(content)]),
        Section("Parameters in common", SHARED, parts=[shared_grid(content)]),
        Section("Specimens", COST, parts=[specimens_grid(content)]),
        *own,
    ]
    names = list(content["specimens"])
    return Page(
        title=f"Joint fit {content['name']}",
        headline=headline(content),
        lead=f"{counted_words(len(content['shared']), 'parameter')} in common, "
        f"{counted_words(len(names), 'specimen')}: {join(names)}. {content['about']}".strip(),
        sections=sections,
        colophon=colophon({"dataset": {"name": join(names)}, "seed": 0}, {}),
    )


def headline(content: Json) -> str:
    """Whether the specimens agree, and what sharing costs."""
    against = [each["number"] for each in content["shared"] if _contradicts(each)]
    if against:
        return f"The specimens contradict one another in {join(against)}."
    return "The specimens agree in all parameters in common."


def shared_grid(content: Json) -> Grid:
    """Every number in common with its interval, and the values of the specimens by themselves."""
    names = list(content["specimens"])
    rows = []
    for each in content["shared"]:
        factor, unit = rig_unit(each["unit"], abs(each["value"]))
        low, high = (side * factor for side in each["interval"])
        row = {"number": each["number"], "value": each["value"] * factor, "low": low, "high": high}
        row["interval"] = (low, high)
        row |= {"unit": unit or None, "probability": each["probability"]}
        alone = {name: own["value"] * factor for name, own in each["alone"].items()}
        rows.append(row | {name: alone.get(name) for name in names})
    columns = [
        Column("number", "parameter"),
        Column("value", "together", "", 5, interval="interval"),
        Column("low", "95 % from", "", 4, interval="interval"),
        Column("high", "to", "", 4, interval="interval"),
        Column("unit", "unit"),
        *(Column(name, f"{name} alone", "", 5, interval="interval") for name in names),
        Column("probability", "by chance", "", 2),
    ]
    return Grid("Parameters in common", columns, rows, csv_name="shared.csv")


def specimens_grid(content: Json) -> Grid:
    """The errors of every specimen alone and together."""
    rows = [
        {
            "specimen": name,
            "model": fit["model"],
            "alone": fit["rmse_alone"]["train"],
            "train": fit["rmse"]["train"],
            "held_alone": fit["rmse_alone"]["held_out"],
            "held_out": fit["rmse"]["held_out"],
            "floor": fit["noise_floor"]["value"],
        }
        for name, fit in content["specimens"].items()
    ]
    columns = [
        Column("specimen", "specimen"),
        Column("model", "model"),
        Column("alone", "training runs, alone", "N", 4),
        Column("train", "together", "N", 4),
        Column("held_alone", "held-out runs, alone", "N", 4),
        Column("held_out", "together", "N", 4),
        Column("floor", "noise floor", "N", 3),
    ]
    used = [column for column in columns if any(row[column.key] is not None for row in rows)]
    return Grid("Errors", used, rows, csv_name="specimens.csv")


def _tiles(content: Json) -> KeyFigures:
    """How many parameters are shared, the one on which the specimens agree least, and the highest price of sharing."""
    shared = [each for each in content["shared"] if each["probability"] is not None]
    shown = [("parameters in common", str(len(content["shared"])), "", f"of {len(content['specimens'])} specimens")]
    if shared:
        least = min(shared, key=lambda each: each["probability"])
        chance = f"{max(least['probability'], LEAST / 100.0):.2g}"
        shown.append(("least agreement by chance", chance, "", f"probability, {least['number']}"))
    growth = {
        name: fit["rmse"]["train"] / fit["rmse_alone"]["train"] - 1.0
        for name, fit in content["specimens"].items()
        if fit["rmse_alone"]["train"]
    }
    if growth:
        worst = max(growth, key=lambda name: growth[name])
        shown.append(
            ("largest growth of the RMSE", f"{max(100.0 * growth[worst], 0.0):.1f}", "%", f"together, {worst}")
        )
    return KeyFigures(shown)


def _notices(content: Json) -> Iterator[Part]:
    for each in content["shared"]:
        if _contradicts(each):
            share = max(100.0 * each["probability"], LEAST)
            yield Notice(
                "warning",
                f"The specimens contradict one another in {each['number']}: chance would make them differ as much in "
                f"{'less than ' if share == LEAST else ''}{share:.2g} % of cases. Leave it out of 'shared', or "
                "check the specimens.",
            )


def _contradicts(each: Json) -> bool:
    return each["probability"] is not None and each["probability"] < UNLIKELY


def _titled(grid: Grid, name: str) -> Grid:
    return Grid(f"Parameters of {name}", grid.columns, grid.rows, csv_name=f"{name}.csv")
