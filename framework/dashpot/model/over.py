"""Reading what a number does over a setting, or along a channel."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise

from dashpot.model.element import Scale
from dashpot.model.network import LISTED, WAYS_OVER, Over, Value, Way
from dashpot.text.form import Form, read_items
from dashpot.text.node import Node, Scalar
from dashpot.text.node import Sequence as Items
from dashpot.text.quantity import base_unit_of, measure

UNBOUNDED = (-math.inf, math.inf)
FACTORS = (1e-3, 1e3)
SHARES = (0.0, 1.0)
# the parameters of a shift with temperature: name, unit, and the range in which they make sense
SHIFTS = {
    "wlf": (("C1", "1", (0.1, 100.0)), ("C2", "K", (5.0, 1000.0))),
    "arrhenius": (("activation temperature", "K", (100.0, 1e5)),),
}
CALLED = {"kg^1*m^-1*s^-2": "Pa", "kg^1*m^1*s^-2": "N", "K^1": "K", "A^1": "A", "m^1": "m", "s^1": "s", "kg^1": "kg"}

# a number at a node, with its unit, range and search scale, by the name that stands in messages
ReadNumber = Callable[[Node, str, tuple[float, float], Scale, str], Value | None]


def read_over(form: Form, unit: str, read: ReadNumber) -> Over | None:
    """The dependence of a number in ``unit``: ``{setting: pressure, at: 2 bar, slope: 5 N/bar}``.

    Instead of ``setting`` there may be ``channel``, instead of ``slope`` a ``rate``, a ``factor`` for each of several
    places, or, over a temperature, ``wlf: [C1, C2]`` or ``arrhenius``. ``kept: 0.5`` needs no ``at``. None where
    something is wrong; every mistake is noted.
    """
    channel = "channel" in form
    word = form.text("channel" if channel else "setting")
    way = next((key for key in WAYS_OVER if key in form), None)
    node, entry = form.node("at") if way != "kept" else None, form.node(way) if way else None
    if way is None:
        form.complain(
            None, f"{form.what} lacks one of {', '.join(WAYS_OVER)}", "write 'slope: {start: 0}' for a straight line"
        )
    elif node is None and way != "kept":
        form.complain(None, f"{form.what} lacks 'at'", "give the setting at which the parameter has its base value")
    form.close()
    if way == "kept" and word and entry:
        share = read(entry, "1", SHARES, "linear", way)
        return Over(word, way, (0.0,), (share,), channel) if share else None
    if word is None or way is None or node is None or entry is None:
        return None
    try:
        at, setting = _places(node, way == "factor")
    except ValueError as error:
        form.complain("at", f"{form.what}, 'at': {error}")
        return None
    if way == "factor":
        factors = _factors(form, entry, at, read)
        return Over(word, way, at, factors, channel) if factors else None
    if way in SHIFTS:
        shift = _shift(form, way, entry, setting, read)
        return Over(word, way, at, shift, channel) if shift else None
    per = "" if setting == "1" else f"/{CALLED.get(setting, f'({setting})')}"
    found = read(entry, (unit if way == "slope" else "1") + per, UNBOUNDED, "linear", way)
    return Over(word, way, at, (found,), channel) if found else None


def _places(node: Node, several: bool) -> tuple[tuple[float, ...], str]:
    """The settings at which numbers are told, and their base unit. ValueError for what is none."""
    items: Sequence[Node] = read_items(node) if several else [node]
    texts = [item.value for item in items if isinstance(item, Scalar) and isinstance(item.value, str | int | float)]
    if len(texts) < len(items) or len(items) < 1 + several:
        wanted = "two or more settings" if several else "one setting"
        raise ValueError(f"expected {wanted}, got {node.describe()}")
    units = {base_unit_of(text) for text in texts}
    if len(units) > 1:
        raise ValueError("expected settings of one kind; write the same unit behind all")
    at = tuple(measure(text) for text in texts)
    if any(high <= low for low, high in pairwise(at)):
        raise ValueError("expected growing settings; sort them")
    return at, units.pop()


def _shift(form: Form, way: Way, entry: Node, setting: str, read: ReadNumber) -> tuple[Value, ...]:
    """The parameters of a shift with temperature."""
    wanted = SHIFTS[way]
    items = entry.items if isinstance(entry, Items) else () if way in LISTED else (entry,)
    if CALLED.get(setting) != "K":
        form.complain("at", f"{form.what}: expected a temperature, as '{way}' shifts by it", "write 'at: 23 degC'")
    elif len(items) != len(wanted):
        form.complain(way, f"{form.what}: expected [C1, C2], got {entry.describe()}", "write 'wlf: [17.44, 51.6 K]'")
    else:
        found = [
            read(item, unit, sensible, "log", name) for item, (name, unit, sensible) in zip(items, wanted, strict=True)
        ]
        values = tuple(value for value in found if value)
        return values if len(values) == len(found) else ()
    return ()


def _factors(form: Form, entry: Node, at: tuple[float, ...], read: ReadNumber) -> tuple[Value, ...]:
    items = entry.items if isinstance(entry, Items) else ()
    if len(items) != len(at):
        form.complain(
            "factor",
            f"{form.what}: expected a list of {len(at)} factors, one for each place, got {entry.describe()}",
            "give one factor for each of 'at'",
        )
        return ()
    found = [read(item, "1", FACTORS, "log", f"factor {number}") for number, item in enumerate(items, 1)]
    values = tuple(value for value in found if value)
    return values if len(values) == len(items) else ()
