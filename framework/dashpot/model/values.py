"""Reading numbers and curves of a branch."""

from __future__ import annotations

import math
from dataclasses import dataclass

from dashpot.model.element import Curve, Parameter, Scale
from dashpot.model.network import Characteristic, Value
from dashpot.text.form import Form, read_items, read_quantity
from dashpot.text.node import Mapping, Node, Sequence
from dashpot.text.problem import Problem

FACTOR = Curve(("factor", "1"), ("deflection", "m"), "factor on the force over deflection", bounds=(0.02, 50.0))
SOURCES = ("quasi_static",)


@dataclass(frozen=True)
class Kind:
    """What a number has to be: its unit, where it makes sense, how it is searched."""

    unit: str
    bounds: tuple[float, float]
    scale: Scale


def kind_of(parameter: Parameter) -> Kind:
    """The kind of number that a parameter is."""
    return Kind(parameter.unit, parameter.bounds, parameter.scale)


def read_value(node: Node, kind: Kind, problems: list[Problem], what: str, copy: int = 0) -> Value | None:
    """A number: fixed (``220 N/mm``), free (``{start, bounds, scale}``) or identified (``{value, bounds, interval}``).

    In a repeated branch a list holds one number per copy; ``copy`` is which one to take.
    """
    if not isinstance(node, Mapping):
        return _fixed(_pick(node, copy), kind, problems, what)
    form = Form(node, problems, what)
    key = "value" if "value" in form else "start"
    number = form.take(key, lambda inner: read_quantity(_pick(inner, copy), kind.unit))
    bounds = form.take("bounds", lambda inner: _read_bounds(inner, kind), None)
    scale = form.choice("scale", ("log", "linear"), kind.scale)
    interval = form.take("interval", lambda inner: _read_pair(_pick_pair(inner, copy), kind.unit), None)
    form.close()
    if number is None:
        return None
    role = "identified" if key == "value" else "free"
    value = Value(number, kind.unit, role, bounds, scale, interval, node)
    for complaint in _complaints(value, kind, what):
        problems.append(Problem(form.place_of(key), complaint))
    return value


def read_curve(node: Node, curve: Curve, problems: list[Problem], what: str, copy: int = 0) -> Characteristic | None:
    """A curve: a constant slope, ``{polynomial: [...]}``, a table of both axes, or ``{from: quasi_static}``."""
    keys = set(node.entries) if isinstance(node, Mapping) else set()
    if "from" in keys:
        return _read_data(node, curve, problems, what)
    if "polynomial" in keys:
        return _read_polynomial(node, curve, problems, what)
    if keys & {curve.over[0], curve.value[0]}:
        return _read_table(node, Form(node, problems, what), curve, problems, what)
    value = read_value(node, Kind(curve.slope_unit, curve.bounds, curve.scale), problems, what, copy)
    return Characteristic(curve, "constant", (value,), node=node) if value else None


def _fixed(node: Node, kind: Kind, problems: list[Problem], what: str) -> Value | None:
    try:
        number = read_quantity(node, kind.unit)
    except ValueError as error:
        problems.append(Problem(node.place, f"{what}: {error}"))
        return None
    low, high = kind.bounds
    if not low <= number <= high and number != 0.0:
        problems.append(Problem(node.place, f"{what}: expected {low:g} to {high:g} {kind.unit}, got {number:g}"))
    return Value(number, kind.unit, scale=kind.scale, node=node)


def _pick(node: Node, copy: int) -> Node:
    if not isinstance(node, Sequence):
        return node
    if copy >= len(node.items):
        raise ValueError(f"expected a number for each copy, got {len(node.items)} for copy {copy + 1}")
    return node.items[copy]


def _pick_pair(node: Node, copy: int) -> Node:
    nested = isinstance(node, Sequence) and node.items and isinstance(node.items[0], Sequence)
    return _pick(node, copy) if nested else node


def _read_pair(node: Node, unit: str) -> tuple[float, float]:
    items = read_items(node)
    if len(items) != 2:
        raise ValueError(f"expected [low, high], got {len(items)} numbers")
    low, high = (read_quantity(item, unit) for item in items)
    if not low < high:
        raise ValueError(f"expected low < high, got {low:g} and {high:g}")
    return low, high


def _read_bounds(node: Node, kind: Kind) -> tuple[float, float]:
    low, high = _read_pair(node, kind.unit)
    if low < kind.bounds[0] or high > kind.bounds[1]:
        raise ValueError(f"expected bounds inside {kind.bounds[0]:g} to {kind.bounds[1]:g} {kind.unit}, "
                         f"got {low:g} to {high:g}")  # fmt: skip
    return low, high


def _complaints(value: Value, kind: Kind, what: str) -> list[str]:
    low, high = value.bounds or kind.bounds
    found = []
    if not low <= value.number <= high:
        found.append(f"{what}: expected a start inside its bounds {low:g} to {high:g} {kind.unit}, got {value.number:g}")
    if value.scale == "log" and (low <= 0.0 or value.number <= 0.0):
        found.append(f"{what}: expected positive numbers for a log scale, got {min(low, value.number):g} {kind.unit}; "
                     "write scale: linear")  # fmt: skip
    return found


def _read_data(node: Mapping, curve: Curve, problems: list[Problem], what: str) -> Characteristic | None:
    form = Form(node, problems, what)
    data = form.choice("from", SOURCES)
    knots = form.integer("knots", 0)
    if curve.over[0] in form or curve.value[0] in form:
        table = _read_table(node, form, curve, problems, what, role="identified")
        return table and Characteristic(curve, "table", table.values, table.at, data or "", knots, node)
    form.close()
    return Characteristic(curve, "data", (), (), data or "", knots, node)


def _read_polynomial(node: Mapping, curve: Curve, problems: list[Problem], what: str) -> Characteristic | None:
    form = Form(node, problems, what)
    items = form.take("polynomial", read_items)
    form.close()
    values = []
    for power, item in enumerate(items or (), 1):
        unit = f"({curve.value[1]})/({curve.over[1]})^{power}"
        bounds = curve.bounds if power == 1 else (-math.inf, math.inf)
        kind = Kind(unit, bounds, curve.scale if power == 1 else "linear")
        values.append(read_value(item, kind, problems, f"{what}, power {power}"))
    if not values or None in values:
        return None
    return Characteristic(curve, "polynomial", tuple(values), node=node)


def _read_table(node: Mapping, form: Form, curve: Curve, problems: list[Problem], what: str, role: str = "fixed",
                ) -> Characteristic | None:  # fmt: skip
    at = form.quantities(curve.over[0], curve.over[1])
    entry = form.node(curve.value[0])
    if entry is None:
        form.complain(None, f"{what} lacks '{curve.value[0]}'", f"give one {curve.value[0]} for each {curve.over[0]}")
    form.close()
    if at is None or entry is None:
        return None
    values = _table_values(entry, curve, problems, what, role)
    if len(values) != len(at) or len(at) < 2:
        problems.append(Problem(form.place, f"{what}: expected as many {curve.value[0]} as {curve.over[0]} and at least "
                                f"two, got {len(values)} and {len(at)}"))  # fmt: skip
        return None
    if any(b <= a for a, b in zip(at, at[1:], strict=False)):
        problems.append(Problem(form.place, f"{what}: expected growing {curve.over[0]}, got {at}"))
        return None
    if None in values:
        return None
    return Characteristic(curve, "table", tuple(values), tuple(at), node=node)


def _table_values(entry: Node, curve: Curve, problems: list[Problem], what: str, role: str) -> list[Value | None]:
    bounds = curve.bounds if curve is FACTOR else (-math.inf, math.inf)
    kind = Kind(curve.value[1], bounds, "log" if curve is FACTOR else "linear")
    if isinstance(entry, Sequence):
        values = [read_value(item, kind, problems, what) for item in entry.items]
    else:
        inner = entry.entries.get("start") if isinstance(entry, Mapping) else None
        count = len(inner.items) if isinstance(inner, Sequence) else 0
        values = [read_value(entry, kind, problems, what, copy) for copy in range(count)]
    if role == "fixed":
        return values
    return [v and Value(v.number, v.unit, "identified", v.bounds, v.scale, v.interval, v.node) for v in values]


