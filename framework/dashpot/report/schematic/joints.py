"""Wires where they meet: pieces of one line become one; on a node that others only cross, joined ones get dots."""

from __future__ import annotations

from collections.abc import Iterable

from dashpot.report.schematic.shapes import Box, Point, Rail, Shape, Wire

NEAR = 0.01  # points


def merged(shapes: Iterable[Shape]) -> list[Shape]:
    """The shapes with wires that continue each other as one, unless something else is joined between them."""
    shapes = list(shapes)
    wires = [wire for wire in shapes if isinstance(wire, Wire) and wire.start != wire.end]
    lines = [*(wire.box for wire in wires), *(rail.box for rail in shapes if isinstance(rail, Rail))]
    found: list[Wire] = []
    while wires:
        wire = wires.pop()
        while follower := _follower(wire, wires, lines):
            wires.remove(follower)
            wire = _joined(wire, follower)
        found.append(wire)
    return [*reversed(found), *(shape for shape in shapes if not isinstance(shape, Wire))]


def dots(shapes: Iterable[Shape]) -> list[Point]:
    """Where wires end on a node that others cross without being joined to it."""
    shapes = list(shapes)
    wires = [shape for shape in shapes if isinstance(shape, Wire)]
    found: list[Point] = []
    for rail in shapes:
        if isinstance(rail, Rail) and not rail.body:
            ends = [end for wire in wires for end in (wire.start, wire.end) if _lies_on(end, rail.box)]
            if any(_cross(wire.box, rail.box) and not {wire.start, wire.end} & set(ends) for wire in wires):
                found += ends
    return list(dict.fromkeys(found))


def _follower(wire: Wire, wires: list[Wire], lines: list[Box]) -> Wire | None:
    for other in wires:
        shared = {wire.start, wire.end} & {other.start, other.end}
        if len(shared) == 1 and _upright(wire) == _upright(other):
            [place] = shared
            if not any(_lies_on(place, line) for line in lines if _across(line, wire)):
                return other
    return None


def _joined(one: Wire, other: Wire) -> Wire:
    box = Box.union([one.box, other.box])
    return Wire((box.left, box.top), (box.right, box.bottom))


def _upright(wire: Wire) -> bool:
    return abs(wire.start[0] - wire.end[0]) < NEAR


def _across(line: Box, wire: Wire) -> bool:
    return (line.right - line.left < NEAR) != _upright(wire) or (line.right - line.left < NEAR > line.bottom - line.top)


def _lies_on(point: Point, line: Box) -> bool:
    x, y = point
    return line.left - NEAR <= x <= line.right + NEAR and line.top - NEAR <= y <= line.bottom + NEAR


def _cross(one: Box, other: Box) -> bool:
    return (
        max(one.left, other.left) <= min(one.right, other.right) + NEAR
        and max(one.top, other.top) <= min(one.bottom, other.bottom) + NEAR
    )
