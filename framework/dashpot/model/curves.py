"""Reading the curves of a branch."""

from __future__ import annotations

import math
from collections.abc import Sequence as SequenceType
from dataclasses import replace

from dashpot.model.element import Curve
from dashpot.model.network import Characteristic, Role, Value
from dashpot.model.values import Copy, Kind, Reading, read_value
from dashpot.text.form import Form, read_items
from dashpot.text.node import Mapping, Node, Sequence

FACTOR = Curve(("factor", "1"), ("deflection", "m"), "factor on the force over deflection", bounds=(0.02, 50.0))
SOURCES = ("quasi_static",)
FEWEST_KNOTS, MOST_KNOTS = 2, 200
UNBOUNDED = (-math.inf, math.inf)


def read_curve(node: Node, curve: Curve, reading: Reading) -> Characteristic | None:
    """A curve: a constant slope, ``{polynomial: [...]}``, a table of both axes, or ``{from: quasi_static}``.

    None when there is no curve to be had; every mistake is noted.
    """
    keys = set(node.entries) if isinstance(node, Mapping) else set()
    if isinstance(node, Mapping) and "from" in keys:
        return _read_data(node, curve, reading)
    if isinstance(node, Mapping) and "polynomial" in keys:
        return _read_polynomial(node, curve, reading)
    if keys & {curve.over[0], curve.value[0]}:
        return _read_table(reading.form(node), curve, reading)
    value = read_value(node, Kind(curve.slope_unit, curve.bounds, curve.scale, off=True), reading)
    return Characteristic(curve, "constant", (value,), node=node) if value else None


def read_scale(node: Node, reading: Reading) -> Characteristic | None:
    """The factor on a branch's force: a table over deflection. None when there is none; every mistake is noted."""
    if not isinstance(node, Mapping):
        reading.complain(
            node.place,
            f"expected a table over deflection, got {node.describe()}",
            "write {deflection: [5 mm, 20 mm], factor: [1.2, 1]}",
        )
        return None
    return _read_table(reading.form(node), FACTOR, reading)


def _read_data(node: Mapping, curve: Curve, reading: Reading) -> Characteristic | None:
    form = reading.form(node)
    data = form.choice("from", SOURCES)
    knots = form.integer("knots", 0)
    refine = form.flag("refine", False)
    if "knots" in form and not FEWEST_KNOTS <= knots <= MOST_KNOTS:
        form.complain("knots", f"{reading.what}: expected {FEWEST_KNOTS} to {MOST_KNOTS} knots, got {knots}")
    if (curve.value[1], curve.over[1]) != ("N", "m"):
        reading.complain(
            form.key_place("from"),
            "expected a number, a polynomial or a table; only a force over "
            f"deflection can be taken from data, not a {curve.value[0]} over {curve.over[0]}",
        )
    if curve.over[0] in form or curve.value[0] in form:
        table = _read_table(form, curve, reading, "identified" if refine else "fixed")
        return replace(table, data=data or "", knots=knots, refine=refine) if table else None
    form.close()
    return Characteristic(curve, "data", (), (), data or "", knots, node, refine)


def _read_polynomial(node: Mapping, curve: Curve, reading: Reading) -> Characteristic | None:
    form = reading.form(node)
    items = form.take("polynomial", _read_coefficients)
    form.close()
    found = [_coefficient(item, power, curve, reading) for power, item in enumerate(items or (), 1)]
    values = tuple(value for value in found if value)
    return Characteristic(curve, "polynomial", values, node=node) if values and len(values) == len(found) else None


def _read_coefficients(node: Node) -> tuple[Node, ...]:
    items = read_items(node)
    if not items:
        raise ValueError("expected at least one coefficient, got an empty list")
    return items


def _coefficient(node: Node, power: int, curve: Curve, reading: Reading) -> Value | None:
    unit = curve.coefficient_unit(power)
    kind = Kind(unit, curve.bounds, curve.scale, off=True) if power == 1 else Kind(unit, UNBOUNDED, "linear")
    return read_value(node, kind, reading.named(f"{reading.what}, power {power}"))


def _read_table(form: Form, curve: Curve, reading: Reading, role: Role = "fixed") -> Characteristic | None:
    at = form.quantities(*curve.over)
    entry = form.node(curve.value[0])
    if entry is None:
        form.complain(
            None, f"{reading.what} lacks '{curve.value[0]}'", f"give one {curve.value[0]} for each {curve.over[0]}"
        )
    form.close()
    if at is None or entry is None:
        return None
    found = _read_column(entry, curve, reading, role)
    if not found or not _is_sound(form, curve, reading, at, len(found)):
        return None
    values = tuple(value for value in found if value)
    if len(values) < len(found):
        return None
    return Characteristic(curve, "table", values, tuple(at), node=form.origin)


def _is_sound(form: Form, curve: Curve, reading: Reading, at: SequenceType[float], count: int) -> bool:
    over, value = curve.over[0], curve.value[0]
    if count != len(at) or len(at) < 2:
        reading.complain(
            form.place_of(value),
            f"expected as many {value} as {over}, at least two of each, got {count} and {len(at)}",
            f"give one {value} for each {over}",
        )
        return False
    for number, (before, after) in enumerate(zip(at, at[1:], strict=False), 2):
        if not before < after:
            reading.complain(
                form.place_of(over),
                f"expected growing {over}, got {after:g} {curve.over[1]} as number {number} after {before:g}",
                "sort the table",
            )
            return False
    return True


def _read_column(entry: Node, curve: Curve, reading: Reading, role: Role) -> list[Value | None]:
    kind = Kind(curve.value[1], curve.bounds, "log") if curve is FACTOR else Kind(curve.value[1], UNBOUNDED, "linear")
    if isinstance(entry, Sequence) and not entry.items:
        reading.complain(
            entry.place,
            f"expected a list of {curve.value[0]}, got an empty one",
            f"give one {curve.value[0]} for each {curve.over[0]}",
        )
    if isinstance(entry, Sequence):
        values = [read_value(item, kind, reading) for item in entry.items]
    else:
        values = _read_whole_column(entry, kind, reading)
    for value in values:
        if value and value.over:
            reading.complain(
                value.node.place if value.node else entry.place,
                "a knot of a table cannot depend on a setting",
                "write a constant or a polynomial, or give the branch a 'scale'",
            )
    return [value.as_role(role) if value and role != "fixed" else value for value in values]


def _read_whole_column(entry: Node, kind: Kind, reading: Reading) -> list[Value | None]:
    # {start: [...], bounds: ...}: one entry that holds all knots
    numbers = _whole_numbers(entry)
    if numbers is None:
        reading.complain(entry.place, f"expected a list of numbers, got {entry.describe()}")
        return []
    if reading.copy.of > 1:
        reading.complain(
            entry.place,
            "expected a list with an entry for each knot, as the branch is repeated",
            "write [{start: ...}, {start: ...}]",
        )
        return []
    count, before = len(numbers.items), len(reading.problems)
    found: list[Value | None] = [None] * count
    for number in range(count):
        found[number] = read_value(entry, kind, replace(reading, copy=Copy(number, count)))
        if len(reading.problems) > before:
            break
    return found


def _whole_numbers(entry: Node) -> Sequence | None:
    inner = entry.entries if isinstance(entry, Mapping) else {}
    numbers = inner.get("value", inner.get("start"))
    return numbers if isinstance(numbers, Sequence) and numbers.items else None
