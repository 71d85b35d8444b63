"""The parameters of a network as a table."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from dashpot.model.meanings import meanings_of
from dashpot.model.network import NetworkSpec, Slot, Value
from dashpot.model.slopes import RUN, per_run
from dashpot.report.parts import Column, Grid
from dashpot.text.digits import rig_unit, unit_per

ROLES = {"fixed": "fixed", "free": "free", "identified": "identified"}
COLUMNS = (
    Column("number", "parameter"),
    Column("about", "meaning"),
    Column("value", "value", "", 4, interval="interval"),
    Column("low", "95 % from", "", 4, interval="interval"),
    Column("high", "to", "", 4, interval="interval"),
    Column("unit", "unit"),
    Column("lower", "lower bound", "", 3),
    Column("upper", "upper bound", "", 3),
    Column("role", "role"),
)


def parameters_grid(spec: NetworkSpec, remarks: Mapping[str, str] | None = None) -> Grid:
    """Every parameter with its interval and its bounds in rig units; ``remarks`` by path take the place of the role.

    Without remarks a column tells what each parameter means.
    """
    meanings = meanings_of(spec) if remarks is None else {}
    slopes = per_run({slot.path: slot.value for slot in spec.slots()})
    rows = [
        _row(slot, meanings.get(slot.path.partition("[")[0]), (remarks or {}).get(slot.path), slot.path in slopes)
        for slot in spec.slots()
    ]
    used = [column for column in COLUMNS if any(row[column.key] is not None for row in rows)]
    waiting = [path for path, curve in spec.data_curves().items() if curve.form == "data"]
    below = [f"A fit takes {', '.join(waiting)} from the data."] if waiting else []
    if any(slot.value.searched and slot.value.bounds is None for slot in spec.slots()):
        below.append("A parameter without bounds has the sensible range of its element; a fit narrows it by the data.")
    caption = " ".join(below)
    return Grid("Parameters", used, rows, caption, "numbers.csv")


def _range(value: Value) -> tuple[float, float]:
    if value.bounds is not None:
        return value.bounds
    return value.sensible if value.searched else (-math.inf, math.inf)


def _row(slot: Slot, meaning: str | None, remark: str | None, of_runs: bool) -> dict[str, Any]:
    value = slot.value
    factor, unit = rig_unit(value.unit, abs(value.number))
    interval = None if value.interval is None else [side * factor for side in value.interval]
    low, high = interval or (None, None)
    lower, upper = (side * factor if math.isfinite(side) else None for side in _range(value))
    return {
        "number": slot.path,
        "about": meaning,
        "value": value.number * factor,
        "low": low,
        "high": high,
        "interval": interval,
        "unit": unit_per(unit, RUN if of_runs else "") or None,
        "lower": lower,
        "upper": upper,
        "role": remark or (f"= {value.expression}" if value.expression else ROLES[value.role]),
    }
