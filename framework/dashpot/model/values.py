"""Reading the parameters of a branch."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

from dashpot.model.element import Parameter, Scale
from dashpot.model.network import Over, Role, Value
from dashpot.model.over import read_over
from dashpot.model.prior import Prior, read_prior
from dashpot.text.form import Form, read_items, read_quantity, read_text
from dashpot.text.node import Mapping, Node, Sequence
from dashpot.text.problem import Place, Problem


@dataclass(frozen=True)
class Kind:
    """What a number has to be: its unit, where it makes sense, how it is searched.

    ``off`` says that a fixed 0, outside the bounds, is fine: it switches the law off.
    """

    unit: str
    bounds: tuple[float, float]
    scale: Scale
    off: bool = False


@dataclass(frozen=True)
class Copy:
    """Which one of how many copies of a repeated branch is read."""

    number: int = 0
    of: int = 1


ONLY = Copy()
ROUNDING = 1e-6


@dataclass(frozen=True)
class Reading:
    """What is being read, in the words of a message, for which copy, and the list that mistakes are noted in."""

    what: str
    problems: list[Problem]
    copy: Copy = ONLY

    def named(self, what: str) -> Reading:
        """The reading of a part."""
        return replace(self, what=what)

    def complain(self, place: Place, message: str, hint: str = "") -> None:
        """Note a mistake."""
        self.problems.append(Problem(place, f"{self.what}: {message}", hint))

    def form(self, node: Node) -> Form:
        """The node as a form that notes into the same list."""
        return Form(node, self.problems, self.what)

    def pick(self, node: Node) -> Node:
        """The item of a list that this copy takes; anything else is the same for all. Raises ValueError."""
        if not isinstance(node, Sequence):
            return node
        if self.copy.of == 1:
            raise ValueError(
                f"expected one number, got a list of {len(node.items)}; a list is for the copies of a "
                "branch with 'repeat'"
            )
        if len(node.items) != self.copy.of:
            raise ValueError(f"expected {self.copy.of} numbers, one for each copy, got {len(node.items)}")
        return node.items[self.copy.number]


def kind_of(parameter: Parameter) -> Kind:
    """The kind of number that a parameter is."""
    return Kind(parameter.unit, parameter.bounds, parameter.scale)


def read_value(node: Node, kind: Kind, reading: Reading) -> Value | None:
    """A number: fixed (``220 N/mm``), free (``{start, bounds, scale}``) or identified (``{value, bounds, interval}``).

    With ``{setting: word, value: 0 kg}`` a run that has a setting of that word gives the number; one that is ``{known:
    1.5 kg, interval: [1 kg, 2 kg]}`` is not searched, but its 95 % interval is allowed for. One that is free, found or
    ``{fixed: 30 N}`` may depend on a setting, ``over: {...}``; see ``read_over``. One with ``{expression: 0.5 *
    front.stiffness}`` follows from others. In a repeated branch a list holds one number for each copy. None when there
    is no number to be had; every mistake is noted.
    """
    if isinstance(node, Mapping):
        special = next((read for key, read in SPECIAL.items() if key in node.entries), _read_searched)
        return special(node, kind, reading)
    try:
        number = read_quantity(reading.pick(node), kind.unit)
    except ValueError as error:
        reading.complain(node.place, str(error))
        return None
    _refuse_outside(number, kind, node.place, reading)
    return Value(number, kind.unit, scale=kind.scale, sensible=kind.bounds, node=node)


def _refuse_outside(number: float, kind: Kind, place: Place, reading: Reading) -> None:
    low, high = kind.bounds
    if not (low <= number <= high or (kind.off and number == 0.0)):
        reading.complain(place, f"expected {low:g} to {high:g} {kind.unit}, got {number:g}", "check its unit")


def _read_searched(node: Mapping, kind: Kind, reading: Reading) -> Value | None:
    form = reading.form(node)
    key = "value" if "value" in form else "start"
    number = form.take(key, lambda inner: read_quantity(reading.pick(inner), kind.unit))
    bounds = form.take("bounds", lambda inner: _read_bounds(inner, kind), None)
    scale: Scale = "log" if form.choice("scale", ("log", "linear"), kind.scale) == "log" else "linear"
    interval = form.take("interval", lambda inner: _read_interval(_pick_pair(inner, reading), kind.unit), None)
    over = _read_over(form, kind, reading)
    prior = _read_prior(form, kind, reading)
    form.close()
    if number is None:
        return None
    role: Role = "identified" if key == "value" else "free"
    value = Value(number, kind.unit, role, bounds, scale, interval, kind.bounds, over=over, prior=prior, node=node)
    for complaint in _complaints(value):
        reading.complain(form.place_of(key), complaint)
    return value


def _read_setting(node: Mapping, kind: Kind, reading: Reading) -> Value | None:
    form = reading.form(node)
    word = form.text("setting")
    number = form.take("value", lambda inner: read_quantity(inner, kind.unit))
    form.close()
    if word is None or number is None:
        return None
    _refuse_outside(number, kind, form.place_of("value"), reading)
    return Value(number, kind.unit, scale=kind.scale, sensible=kind.bounds, setting=word, node=node)


def _read_expression(node: Mapping, kind: Kind, reading: Reading) -> Value | None:
    from dashpot.model.expression import parse_expression

    form = reading.form(node)
    text = form.take("expression", lambda inner: read_text(reading.pick(inner)))
    form.close()
    if text is None:
        return None
    try:
        parse_expression(text)
    except ValueError as error:
        reading.complain(form.place_of("expression"), str(error))
        return None
    # what it comes to is known when all numbers have been read
    return Value(math.nan, kind.unit, scale=kind.scale, sensible=kind.bounds, expression=text, node=node)


def _read_known(node: Mapping, kind: Kind, reading: Reading) -> Value | None:
    form = reading.form(node)
    number = form.take("known", lambda inner: read_quantity(inner, kind.unit))
    interval = form.take("interval", lambda inner: _read_interval(inner, kind.unit))
    form.close()
    if number is None or interval is None:
        return None
    for each in (number, *interval):
        _refuse_outside(each, kind, form.place_of("known"), reading)
    if not interval[0] <= number <= interval[1]:
        reading.complain(
            form.place_of("known"),
            f"expected a number inside its interval {interval[0]:g} to {interval[1]:g} {kind.unit}, got {number:g}",
            "correct one of them",
        )
    return Value(number, kind.unit, scale=kind.scale, interval=interval, sensible=kind.bounds, known=True, node=node)


def _read_fixed(node: Mapping, kind: Kind, reading: Reading) -> Value | None:
    form = reading.form(node)
    number = form.take("fixed", lambda inner: read_quantity(reading.pick(inner), kind.unit))
    over = _read_over(form, kind, reading)
    if "over" not in form:
        form.complain("fixed", f"{reading.what}: 'fixed' is for a parameter with 'over'", "write the value alone")
    form.close()
    if number is None:
        return None
    _refuse_outside(number, kind, form.place_of("fixed"), reading)
    return Value(number, kind.unit, scale=kind.scale, sensible=kind.bounds, over=over, node=node)


def _read_prior(form: Form, kind: Kind, reading: Reading) -> Prior | None:
    below = form.form("prior", f"{reading.what}, 'prior'", None)
    return None if below is None else read_prior(below, kind, reading)


def _read_over(form: Form, kind: Kind, reading: Reading) -> Over | None:
    below = form.form("over", f"{reading.what}, 'over'", None)
    if below is None:
        return None

    def read(node: Node, unit: str, bounds: tuple[float, float], scale: Scale, name: str) -> Value | None:
        value = read_value(node, Kind(unit, bounds, scale), reading.named(f"{reading.what}, {name}"))
        if value and (value.over or value.setting):
            reading.complain(node.place, f"the {name} cannot depend on a setting itself", "write a value")
        return value

    return read_over(below, kind.unit, read)


SPECIAL = {"setting": _read_setting, "known": _read_known, "fixed": _read_fixed, "expression": _read_expression}


def _pick_pair(node: Node, reading: Reading) -> Node:
    nested = isinstance(node, Sequence) and node.items and isinstance(node.items[0], Sequence)
    return reading.pick(node) if nested else node


def _read_pair(node: Node, unit: str) -> tuple[float, float]:
    items = read_items(node)
    if len(items) != 2:
        raise ValueError(f"expected [low, high], got {len(items)} numbers")
    low, high = (read_quantity(item, unit) for item in items)
    return low, high


def _read_interval(node: Node, unit: str) -> tuple[float, float]:
    low, high = _read_pair(node, unit)
    if low > high:
        raise ValueError(f"expected low <= high, got {low:g} and {high:g}; exchange them")
    return low, high


def _read_bounds(node: Node, kind: Kind) -> tuple[float, float]:
    low, high = _read_pair(node, kind.unit)
    if not low < high:
        raise ValueError(f"expected low < high, got {low:g} and {high:g}; exchange or widen them")
    if low < kind.bounds[0] or high > kind.bounds[1]:
        raise ValueError(
            f"expected bounds inside {kind.bounds[0]:g} to {kind.bounds[1]:g} {kind.unit}, "
            f"got {low:g} to {high:g}; narrow them, or check their unit"
        )
    return low, high


def _complaints(value: Value) -> Iterator[str]:
    low, high = value.bounds or value.sensible
    # a number identified at its bound was rounded when it was written
    room = ROUNDING * abs(value.number) if value.role == "identified" else 0.0
    if not low - room <= value.number <= high + room:
        yield (
            f"expected a start inside its bounds {low:g} to {high:g} {value.unit}, got {value.number:g}; move it, "
            "or widen the bounds"
        )
    if value.prior and not low <= value.prior.middle <= high:
        yield (
            f"expected a prior around a number inside its bounds {low:g} to {high:g} {value.unit}, got "
            f"{value.prior.middle:g}; check its unit, or widen the bounds"
        )
    lowest = min(low, value.number) if value.bounds else value.number
    if value.scale == "log" and lowest <= 0.0:
        yield f"expected positive numbers for a log scale, got {lowest:g} {value.unit}; write scale: linear"
