"""A schematic as SVG: one self-contained text that follows the reader's light or dark colours and prints in black."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import singledispatch
from xml.sax.saxutils import escape, quoteattr

from dashpot.model.network import NetworkSpec
from dashpot.model.picture import Symbol
from dashpot.report.schematic.drawing import drawing_of
from dashpot.report.schematic.joints import dots, merged
from dashpot.report.schematic.shapes import Box, Point, Rail, Scaling, Shape, Sign, Support, Wire, Words
from dashpot.report.schematic.sizes import PAPER
from dashpot.report.schematic.strokes import CURVED, STROKES, Stroke
from dashpot.report.schematic.supports import support_strokes

MARGIN = 16.0
UNIT = 14.0  # points across for 1 of a stroke
INDEXED = re.compile(r"(\w+)_([\w+]+)(?= [=≈])")
STYLE = """
svg { color: #14181c; font: 12px Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif; }
.paper, .body { fill: #ffffff; }
path, .body, .cell { fill: none; stroke: currentColor; stroke-width: 1.5; }
path, .body, .cell { stroke-linejoin: round; stroke-linecap: round; }
.body { fill: #eef1f4; }
.node path { stroke-width: 2; }
.held path { stroke-width: 3; }
path.thin, .scaling path { stroke-width: 1.1; }
path.filled, circle { fill: currentColor; stroke: none; }
text { fill: currentColor; white-space: pre; }
.name { font-weight: bold; }
.index { font-size: 9px; }
.title .name { font-size: 13px; }
@media screen and (prefers-color-scheme: dark) {
  svg { color: #e4e8ec; }
  .paper { fill: #14181c; }
  .body { fill: #2a323a; }
}
"""


def svg(spec: NetworkSpec) -> str:
    """The schematic of a network as the text of an SVG file."""
    drawing = drawing_of(spec, [PAPER])
    width, height = (round(size + 2 * MARGIN, 1) for size in (drawing.box.right, drawing.box.bottom))
    title = f"<title>{escape(drawing.name)}</title>"
    title += f"<desc>{escape(drawing.about)}</desc>" if drawing.about else ""
    shapes = [shape.moved(MARGIN, MARGIN) for shape in merged(drawing.shapes)]
    marks = [f'<circle class="joint" cx="{x:.1f}" cy="{y:.1f}" r="2.6"/>' for x, y in dots(shapes)]
    body = "\n".join([*(line for shape in shapes for line in draw(shape)), *marks])
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
        f'role="img">\n{title}\n<style>{STYLE}</style>\n'
        f'<rect class="paper" width="{width}" height="{height}"/>\n{body}\n</svg>\n'
    )


@singledispatch
def draw(shape: Shape) -> Iterator[str]:
    """The elements of a shape."""
    raise TypeError(f"expected a shape, got {shape!r}")


@draw.register
def _(wire: Wire) -> Iterator[str]:
    if wire.start != wire.end:
        yield f'<path class="wire" d="{_path((wire.start, wire.end))}"/>'


@draw.register
def _(sign: Sign) -> Iterator[str]:
    yield f'<g class="sign {sign.symbol.name.lower()}" data-branch={_owners(sign.branches)}>'
    if sign.symbol is Symbol.BOX:
        yield from _boxed(sign)
    first, *between = (_stroke(stroke, sign) for stroke in STROKES[sign.symbol])
    marks = [_stroke(stroke, sign, "thin") for stroke in CURVED] if sign.curved else []
    yield from (first, *marks, *between)
    yield "</g>"


@draw.register
def _(scaling: Scaling) -> Iterator[str]:
    box = scaling.box
    tail, tip = (box.left, box.bottom), (box.right, box.top)
    yield f'<g class="scaling" data-branch={_owners(scaling.branches)}>'
    yield f'<path d="{_path((tail, tip))}"/>'
    yield f'<path d="{_path(_head(tail, tip))}"/>'
    for knot in range(1, scaling.knots + 1):
        share = 0.9 * knot / (scaling.knots + 1)
        x, y = (a + share * (b - a) for a, b in zip(tail, tip, strict=True))
        yield f'<circle cx="{x:.1f}" cy="{y:.1f}" r="1.9"/>'
    yield "</g>"


@draw.register
def _(words: Words) -> Iterator[str]:
    yield f'<g class="words{"" if words.owners else " title"}" data-owner={_owners(words.owners)}>'
    x = words.box.middle[0] if words.centred else words.box.left
    anchor = ' text-anchor="middle"' if words.centred else ""
    texts = [("name", escape(words.name))] if words.name else []
    texts += [("line", _typeset(line)) for line in words.lines]
    for number, (kind, text) in enumerate(texts):
        y = words.box.top + PAPER.line * (number + 0.75)
        yield f'<text class="{kind}" x="{x:.1f}" y="{y:.1f}"{anchor}>{text}</text>'
    yield "</g>"


@draw.register
def _(rail: Rail) -> Iterator[str]:
    box = rail.box
    yield f'<g class="node{" held" if rail.held else ""}" data-node={quoteattr(rail.node)}>'
    if rail.body:
        yield (
            f'<rect class="body" x="{box.left:.1f}" y="{box.top:.1f}" width="{box.right - box.left:.1f}" '
            f'height="{box.bottom - box.top:.1f}"/>'
        )
    else:
        yield f'<path d="{_path(((box.left, box.top), (box.right, box.bottom)))}"/>'
    yield "</g>"


@draw.register
def _(support: Support) -> Iterator[str]:
    yield f'<g class="support {support.mark}" data-node={quoteattr(support.node)}>'
    for stroke in support_strokes(support):
        kind = ' class="filled"' if stroke.filled else ""
        yield f'<path{kind} d="{_path(stroke.points, stroke.closed)}"/>'
    if support.measured:
        yield from _load_cell(support)
    yield "</g>"


def _load_cell(support: Support) -> Iterator[str]:
    (x, y), (u, v) = support.start, _direction(support.start, support.end)
    x, y = x + u * PAPER.cell / 2, y + v * PAPER.cell / 2
    yield f'<rect class="cell" x="{x - 8:.1f}" y="{y - 8:.1f}" width="16" height="16" rx="4"/>'
    yield f'<text x="{x:.1f}" y="{y + 4:.1f}" text-anchor="middle">F</text>'


def _boxed(sign: Sign) -> Iterator[str]:
    inset = 0.15 * (abs(sign.end[0] - sign.start[0]) + abs(sign.end[1] - sign.start[1]))
    upright = sign.start[0] == sign.end[0]
    across, down = (0.0, inset) if upright else (inset, 0.0)
    box = Box(sign.box.left + across, sign.box.top + down, sign.box.right - across, sign.box.bottom - down)
    x, y = box.middle
    yield (
        f'<rect class="body" x="{box.left:.1f}" y="{box.top:.1f}" width="{box.right - box.left:.1f}" '
        f'height="{box.bottom - box.top:.1f}"/>'
    )
    yield f'<text x="{x:.1f}" y="{y + 4:.1f}" text-anchor="middle">{escape(sign.word)}</text>'


def _stroke(stroke: Stroke, sign: Sign, kind: str = "") -> str:
    points = [_at(sign, point) for point in stroke.points]
    name = "filled" if stroke.filled else kind
    return f'<path{f" class={quoteattr(name)}" if name else ""} d="{_path(points, stroke.closed)}"/>'


def _at(sign: Sign, point: Point) -> Point:
    along, across = point
    (x, y), (right, down) = sign.start, (sign.end[0] - sign.start[0], sign.end[1] - sign.start[1])
    side = across * UNIT
    return (x + side, y + along * down) if right == 0 else (x + along * right, y - side)


def _head(tail: Point, tip: Point) -> tuple[Point, ...]:
    u, v = _direction(tail, tip)
    back = tip[0] - 7 * u, tip[1] - 7 * v
    return (back[0] - 3 * v, back[1] + 3 * u), tip, (back[0] + 3 * v, back[1] - 3 * u)


def _direction(start: Point, end: Point) -> Point:
    x, y = end[0] - start[0], end[1] - start[1]
    length = (x * x + y * y) ** 0.5
    return x / length, y / length


def _path(points: Iterable[Point], closed: bool = False) -> str:
    return "M" + " L".join(f"{x:.1f} {y:.1f}" for x, y in points) + (" Z" if closed else "")


def _typeset(line: str) -> str:
    found = INDEXED.match(line)
    if not found:
        return escape(line)
    sign, index = map(escape, found.groups())
    return f'{sign}<tspan class="index" dy="3">{index}</tspan><tspan dy="-3">{escape(line[found.end() :])}</tspan>'


def _owners(names: tuple[str, ...]) -> str:
    return quoteattr(" ".join(names))
