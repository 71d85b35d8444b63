"""The numbers of a network as a table."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from dashpot.model.network import NetworkSpec, Slot
from dashpot.report.parts import Column, Grid
from dashpot.report.readable import rig_unit

ROLES = {"fixed": "fixed", "free": "to be found", "identified": "found"}
COLUMNS = (
    Column("number", "number"),
    Column("value", "value", "", 4),
    Column("low", "95 % from", "", 4),
    Column("high", "to", "", 4),
    Column("unit", "unit"),
    Column("lower", "searched from", "", 3),
    Column("upper", "up to", "", 3),
    Column("role", "role"),
)


def numbers_grid(spec: NetworkSpec, remarks: Mapping[str, str] | None = None) -> Grid:
    """Every number with its interval and its bounds in rig units; ``remarks`` by path take the place of the role."""
    rows = [_row(slot, (remarks or {}).get(slot.path)) for slot in spec.slots()]
    used = [column for column in COLUMNS if any(row[column.key] is not None for row in rows)]
    waiting = [path for path, curve in spec.data_curves().items() if curve.form == "data"]
    caption = f"A fit takes {', '.join(waiting)} out of the data." if waiting else ""
    return Grid("Numbers", used, rows, caption, "numbers.csv")


def _row(slot: Slot, remark: str | None) -> dict[str, Any]:
    value = slot.value
    factor, unit = rig_unit(value.unit, abs(value.number))
    low, high = (None, None) if value.interval is None else (side * factor for side in value.interval)
    lower, upper = (None, None) if value.bounds is None else (side * factor for side in value.bounds)
    return {
        "number": slot.path,
        "value": value.number * factor,
        "low": low,
        "high": high,
        "unit": unit or None,
        "lower": lower,
        "upper": upper,
        "role": remark or ROLES[value.role],
    }
