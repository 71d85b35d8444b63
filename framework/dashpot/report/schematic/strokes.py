"""The symbols as strokes: along the force from 0 to 1, across it from -1 to 1."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from dashpot.model.picture import Symbol
from dashpot.report.schematic.shapes import Point


@dataclass(frozen=True)
class Stroke:
    """A line through points; the first stroke of a symbol begins where it is attached, the last one ends there."""

    points: tuple[Point, ...]
    closed: bool = False
    filled: bool = False


def _line(*points: Point) -> Stroke:
    return Stroke(points)


def _shape(*points: Point, filled: bool = False) -> Stroke:
    return Stroke(points, closed=True, filled=filled)


def _hatch(first: float, last: float, count: int, across: float, depth: float) -> tuple[Stroke, ...]:
    step = (last - first) / count
    return tuple(_line((first + k * step + step / 2, across), (first + k * step, across + depth)) for k in range(count))


def _ring(middle: float, along: float, across: float, filled: bool) -> Stroke:
    turns = [2 * math.pi * k / 20 for k in range(20)]
    return _shape(*((middle + along * math.cos(turn), across * math.sin(turn)) for turn in turns), filled=filled)


_ZIGZAG = tuple((0.2 + 0.12 * k, 0.7 if k % 2 else -0.7) for k in range(6))

STROKES: Mapping[Symbol, tuple[Stroke, ...]] = {
    Symbol.SPRING: (_line((0.0, 0.0), (0.14, 0.0), *_ZIGZAG, (0.86, 0.0), (1.0, 0.0)),),
    Symbol.DASHPOT: (
        _line((0.0, 0.0), (0.22, 0.0)),
        _line((0.85, -0.75), (0.22, -0.75), (0.22, 0.75), (0.85, 0.75)),
        _line((0.55, -0.55), (0.55, 0.55)),
        _line((0.55, 0.0), (1.0, 0.0)),
    ),
    # a block on a rough face
    Symbol.SLIDER: (
        _line((0.0, 0.0), (0.12, 0.0), (0.12, -0.35), (0.88, -0.35)),
        *_hatch(0.2, 0.88, 5, -0.35, -0.45),
        _shape((0.3, -0.35), (0.3, 0.55), (0.7, 0.55), (0.7, -0.35)),
        _line((0.7, 0.0), (1.0, 0.0)),
    ),
    # a wheel in a frame
    Symbol.INERTER: (
        _line((0.0, 0.0), (0.2, 0.0)),
        _shape((0.2, -0.75), (0.2, 0.75), (0.8, 0.75), (0.8, -0.75)),
        _ring(0.5, 0.18, 0.5, filled=False),
        _ring(0.5, 0.05, 0.14, filled=True),
        _line((0.8, 0.0), (1.0, 0.0)),
    ),
    Symbol.TRACK: (
        _line((0.0, 0.0), (0.12, 0.0)),
        _shape((0.12, -0.85), (0.12, 0.85), (0.32, 0.85), (0.32, -0.85)),
        _shape((0.32, -0.2), (0.32, 0.2), (0.68, 0.2), (0.68, -0.2), filled=True),
        _shape((0.68, -0.85), (0.68, 0.85), (0.88, 0.85), (0.88, -0.85)),
        _line((0.88, 0.0), (1.0, 0.0)),
    ),
    Symbol.GAP: (
        _line((0.0, 0.0), (0.38, 0.0)),
        _line((0.38, -0.75), (0.38, 0.75)),
        _line((0.62, -0.75), (0.62, 0.75)),
        _line((0.62, 0.0), (1.0, 0.0)),
    ),
    # a head between two stops
    Symbol.PLAY: (
        _line((0.0, 0.0), (0.2, 0.0)),
        _line((0.8, -0.25), (0.8, -0.75), (0.2, -0.75), (0.2, 0.75), (0.8, 0.75), (0.8, 0.25)),
        _line((0.5, -0.45), (0.5, 0.45)),
        _line((0.5, 0.0), (1.0, 0.0)),
    ),
    Symbol.FRACTIONAL: (
        _line((0.0, 0.0), (0.12, 0.0)),
        _shape((0.12, 0.0), (0.5, 0.75), (0.88, 0.0), (0.5, -0.75)),
        _line((0.88, 0.0), (1.0, 0.0)),
    ),
    Symbol.BOX: (_line((0.0, 0.0), (0.15, 0.0)), _line((0.85, 0.0), (1.0, 0.0))),
}
# a slanted line with a foot: the characteristic is no straight line
CURVED = (_line((0.02, -1.35), (0.02, -0.95), (0.98, 0.95), (0.98, 1.35)),)
