"""The marks of nodes: hatching where one is held, arrows where one is moved or loaded, a ring where a figure ends."""

from __future__ import annotations

import math
from collections.abc import Iterator

from dashpot.report.schematic.shapes import Point, Support
from dashpot.report.schematic.sizes import PAPER
from dashpot.report.schematic.strokes import Stroke

HATCH = 8.0  # points between two lines of a hatching, and their length
CLEAR = 5.0  # points between an arrow and what it moves


def support_strokes(support: Support) -> Iterator[Stroke]:
    """The strokes of a mark, in points of the page."""
    (x, y), (right, down) = support.start, _direction(support)
    if support.measured:
        yield from _through_load_cell(support.start, (right, down))
        x, y = x + PAPER.cell * right, y + PAPER.cell * down
    if support.mark == "ground":
        yield from _hatched(support, (x, y), (right, down))
    elif support.mark == "terminal":
        yield from _ring(support, (x, y))
    elif down:
        yield from _arrow((x, y + CLEAR * down), support.end, both=True)
    else:
        tip = support.end[0] - CLEAR
        yield Stroke(((x, y), (tip, y)))
        ends = (tip, y + support.half), (tip, y - support.half)
        yield from _arrow(*ends, both=support.mark == "driven")


def _through_load_cell(start: Point, way: Point) -> Iterator[Stroke]:
    # the cell itself is 16 of the points
    for first, last in ((0.0, PAPER.cell / 2 - 8.0), (PAPER.cell / 2 + 8.0, PAPER.cell)):
        yield Stroke(tuple((start[0] + place * way[0], start[1] + place * way[1]) for place in (first, last)))


def _hatched(support: Support, at: Point, way: Point) -> Iterator[Stroke]:
    (x, y), (right, down) = at, way
    if right:
        x = support.end[0] - HATCH
        yield Stroke((at, (x, y)))
    half = support.half
    yield Stroke(((x - half * abs(down), y - half * abs(right)), (x + half * abs(down), y + half * abs(right))))
    count = max(int(2 * half // HATCH), 2)
    for number in range(count):
        place = -half + number * 2 * half / count
        slant = 2 * half / count
        if down:
            yield Stroke(((x + place, y + HATCH * down), (x + place + slant, y)))
        else:
            yield Stroke(((x + HATCH * right, y + place), (x, y + place + slant)))


def _ring(support: Support, at: Point) -> Iterator[Stroke]:
    (x, y), (right, down), radius = support.end, _direction(support), 4.0
    middle = x - radius * right, y - radius * down
    yield Stroke((at, (x - 2 * radius * right, y - 2 * radius * down)))
    turns = [2 * math.pi * k / 16 for k in range(16)]
    ring = tuple((middle[0] + radius * math.cos(turn), middle[1] + radius * math.sin(turn)) for turn in turns)
    yield Stroke(ring, closed=True)


def _arrow(tail: Point, tip: Point, both: bool) -> Iterator[Stroke]:
    yield Stroke((tail, tip))
    side = math.copysign(6.0, tip[1] - tail[1])
    for (x, y), back in ((tip, -side), (tail, side))[: 2 if both else 1]:
        yield Stroke(((x, y), (x - 3.5, y + back), (x + 3.5, y + back)), closed=True, filled=True)


def _direction(support: Support) -> Point:
    (x, y), (u, v) = support.start, support.end
    return (0.0, math.copysign(1.0, v - y)) if x == u else (math.copysign(1.0, u - x), 0.0)
