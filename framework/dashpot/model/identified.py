"""Where the parameters of an identified network came from, and the motions with which they were found."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial

from dashpot.text.digits import beside
from dashpot.text.form import Form, read_items, read_quantity
from dashpot.text.node import Mapping as MappingNode
from dashpot.text.node import Node, Scalar
from dashpot.text.quantity import pretty_all

Range = Mapping[str, tuple[float, float]]

QUANTITIES = {"displacement": "m", "speed": "m/s", "amplitude": "m", "preload": "m", "frequency": "Hz"}
PLACES = ("displacement", "preload")  # count from anywhere
DIGITS = 6
SLACK = {"displacement": 0.02, "speed": 0.02, "amplitude": 0.02, "preload": 0.02, "frequency": 0.1}


@dataclass(frozen=True)
class Identified:
    """``record`` tells data, optimizer, seed and so on in words; ``range`` the least and the largest of every quantity.

    A quantity is called ``speed``, or ``speed@wheel`` where a node is moved that has a name; all are in SI.
    ``amplitude`` and ``preload`` are half the stroke and the middle of a half cycle, from one turning point to the
    next, and ``frequency`` is half over its duration.
    """

    record: Mapping[str, str] = field(default_factory=dict)
    range: Range = field(default_factory=dict)

    def told(self) -> str:
        """The range in words; empty where none is recorded."""
        return ", ".join(f"{name} {_span(name, self.range)}" for name in self.range)


def read_identified(form: Form) -> Identified:
    """What stands under ``identified:``; files of earlier versions have no range there."""
    node = form.node("identified")
    if not isinstance(node, MappingNode):
        return Identified()
    record = {key: entry.written for key, entry in node.entries.items() if isinstance(entry, Scalar)}
    if "range" not in node.entries:
        return Identified(record)
    ranges = Form(node.entries["range"], form.problems, "the range of identification")
    found = {
        key: ranges.take(key, partial(_read_ends, unit=unit_of(key)), None)
        for key in ranges.keys
        if quantity_of(key) in QUANTITIES
    }
    for quantity in QUANTITIES:
        ranges.node(quantity)
    ranges.close()
    return Identified(record, {key: ends for key, ends in found.items() if ends is not None})


def range_text(found: Range) -> str:
    """The range as it is written into a file."""
    return f"{{{', '.join(f'{name}: {_listed(name, found)}' for name in found)}}}"


def widened(found: Range) -> dict[str, tuple[float, float]]:
    """The range with room for rounding and for samples that lie elsewhere on the same motion."""
    return {name: _widened(name, ends, found) for name, ends in found.items()}


def outside(seen: Range, identified: Range) -> list[str]:
    """What of a motion lies outside the range of identification, in words; both by the same names."""
    limits = widened(identified)
    return [
        f"{name} {_span(name, seen)}, identified in {_span(name, identified)}"
        for name, (low, high) in limits.items()
        if name in seen and not (seen[name][0] >= low and seen[name][1] <= high)
    ]


def quantity_of(name: str) -> str:
    """The quantity in a name such as ``speed@wheel``."""
    return name.partition("@")[0]


def unit_of(name: str) -> str:
    """The unit of a quantity by its name."""
    return QUANTITIES[quantity_of(name)]


def _read_ends(node: Node, unit: str) -> tuple[float, float]:
    ends = [read_quantity(item, unit) for item in read_items(node)]
    if len(ends) != 2 or ends[0] > ends[1]:
        raise ValueError(f"expected [least, largest], got {node.describe()}")
    return ends[0], ends[1]


def _widened(name: str, ends: tuple[float, float], found: Range) -> tuple[float, float]:
    # places count from anywhere: their room is a share of how far the motion went
    quantity, at, node = name.partition("@")
    (low, high), slack = ends, SLACK[quantity]
    if quantity not in PLACES:
        return low * (1.0 - slack), high * (1.0 + slack)
    least, largest = found.get(f"displacement{at}{node}", ends)
    room = slack * (largest - least)
    return low - room, high + room


def _listed(name: str, found: Range) -> str:
    return f"[{', '.join(_pretty(name, found, DIGITS))}]"


def _span(name: str, found: Range) -> str:
    low, high = _pretty(name, found, 3)
    return low if low == high else f"{low} to {high}"


def _pretty(name: str, found: Range, digits: int) -> list[str]:
    quantity, at, node = name.partition("@")
    ends = found[name]
    if quantity in PLACES:
        # what is a thousandth of the way of the node is no place of its own, but noise
        largest = max(map(abs, (*ends, *found.get(f"displacement{at}{node}", ()))))
        ends = beside(ends[0], largest), beside(ends[1], largest)
    return pretty_all(ends, unit_of(name), digits)
