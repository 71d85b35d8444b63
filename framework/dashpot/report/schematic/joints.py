"""Wires where they meet: pieces of one line become one, and where some only cross a node, the joined ones get dots."""

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
    """Where wires end on nodes, if in this drawing any wire crosses a node without being joined to it."""
    shapes = list(shapes)
    wires = [shape for shape in shapes if isinstance(shape, Wire)]
    rails = [shape.box for shape in shapes if isinstance(shape, Rail) and not shape.body]
    if not any(_passes(wire, rail) for wire in wires for rail in rails):
        return []
    ends = [end for wire in wires for end in (wire.start, wire.end)]
    return list(dict.fromkeys(end for end in ends if any(_lies_on(end, rail) for rail in rails)))


def _passes(wire: Wire, rail: Box) -> bool:
    return _cross(wire.box, rail) and not (_lies_on(wire.start, rail) or _lies_on(wire.end, rail))


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
