"""A schematic in characters: forces run from left to right, nodes are heavy lines, labels stand above their branch."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import singledispatchmethod

from dashpot.model.network import NetworkSpec
from dashpot.model.picture import Symbol
from dashpot.report.schematic.drawing import drawing_of
from dashpot.report.schematic.plain import LINES
from dashpot.report.schematic.shapes import Point, Rail, Scaling, Shape, Sign, Support, Wire, Words
from dashpot.report.schematic.sizes import TERMINAL, columns

COLUMNS = 100
FILLINGS = (90.0, 60.0, 40.0, 1.0)  # how long the lines of a label may become: one of them fits best
SIGNS = {
    Symbol.SPRING: "╱╲╱╲╱",
    Symbol.DASHPOT: "─╢ ╟─",
    Symbol.SLIDER: "─▄▄▄─",
    Symbol.INERTER: "─(●)─",
    Symbol.TRACK: "─█━█─",
    Symbol.GAP: "─┤ ├─",
    Symbol.PLAY: "─[┤]─",
    Symbol.FRACTIONAL: "─<=>─",
}
# right, left, up, down: where a cell is connected; light wires, and heavy lines of nodes up and down
LIGHT = {
    "rl": "─",
    "ud": "│",
    "rd": "┌",
    "ld": "┐",
    "ru": "└",
    "lu": "┘",
    "rud": "├",
    "lud": "┤",
    "rld": "┬",
    "rlu": "┴",
    "rlud": "┼",
    "r": "─",
    "l": "─",
    "u": "│",
    "d": "│",
}
HEAVY = {"": "┃", "r": "┠", "l": "┨", "rl": "╂"}


def text_drawing(spec: NetworkSpec, ascii_only: bool = False) -> str:
    """The schematic of a network as text, in at most 100 columns where its names and tree allow it."""
    variants = [replace(TERMINAL, filling=filling, ascii_only=ascii_only) for filling in FILLINGS]
    drawing = drawing_of(spec, variants, COLUMNS)
    if drawing.box.right > COLUMNS:
        drawing = drawing_of(spec, variants, COLUMNS, large=1)
    sheet = Sheet()
    for shape in sorted(drawing.shapes, key=lambda shape: not isinstance(shape, Rail)):
        sheet.put(shape)
    text = "".join(f"{line}\n" for line in sheet.lines())
    return text.translate(LINES) if ascii_only else text


class Sheet:
    """Characters by row and column, and how the cells are connected."""

    def __init__(self) -> None:
        self.text: dict[tuple[int, int], str] = {}
        self.ways: dict[tuple[int, int], set[str]] = {}
        self.rails: set[tuple[int, int]] = set()

    def lines(self) -> list[str]:
        """The lines of the sheet."""
        cells = {cell: self._wire(cell) for cell in (*self.ways, *self.rails)} | self.text
        last = max(row for row, _ in cells)
        return [self._line(cells, row) for row in range(last + 1)]

    def _line(self, cells: dict[tuple[int, int], str], row: int) -> str:
        found = sorted((column, sign) for (own, column), sign in cells.items() if own == row)
        line, at = "", 0
        for column, sign in found:
            line += " " * (column - at) + sign
            at = column + columns(sign)
        return line.rstrip()

    def _wire(self, cell: tuple[int, int]) -> str:
        ways = self.ways.get(cell, set())
        if cell in self.rails:
            return HEAVY["".join(way for way in "rl" if way in ways)]
        return LIGHT["".join(way for way in "rlud" if way in ways)]

    @singledispatchmethod
    def put(self, shape: Shape) -> None:
        """Put a shape on the sheet."""
        raise TypeError(f"expected a shape, got {shape!r}")

    @put.register
    def _(self, rail: Rail) -> None:
        self.rails |= set(_cells((rail.box.left, rail.box.top), (rail.box.right, rail.box.bottom)))

    @put.register
    def _(self, wire: Wire) -> None:
        cells = list(_cells(wire.start, wire.end))
        onward, back = ("r", "l") if wire.start[1] == wire.end[1] else ("d", "u")
        for cell in cells[:-1]:
            self._join(cell, onward, passing=cell != cells[0])
        for cell in cells[1:]:
            self._join(cell, back, passing=cell != cells[-1])

    def _join(self, cell: tuple[int, int], way: str, passing: bool) -> None:
        # a wire that only passes a node lies behind it
        if not (passing and cell in self.rails):
            self.ways.setdefault(cell, set()).add(way)

    @put.register
    def _(self, sign: Sign) -> None:
        width = round(sign.end[0] - sign.start[0]) + 1
        text = f"[{sign.word.center(width - 2 - columns(sign.word) + len(sign.word))}]"
        if sign.symbol is not Symbol.BOX:
            text = SIGNS[sign.symbol].center(width, "─")
        if sign.curved:
            text = f"{text[:-1]}~"
        self._write(round(sign.start[1]), round(sign.start[0]), text)

    @put.register
    def _(self, scaling: Scaling) -> None:
        row = round((scaling.box.top + scaling.box.bottom) / 2)
        self._write(row, round(scaling.box.right), "↗")

    @put.register
    def _(self, words: Words) -> None:
        left, top = round(words.box.left), round(words.box.top)
        for row, text in enumerate(filter(None, [words.name, *words.lines]), start=top):
            spare = round(words.box.right - words.box.left) - columns(text) if words.centred else 0
            self._write(row, left + spare // 2, text)

    @put.register
    def _(self, support: Support) -> None:
        mark = {"driven": "↔", "ground": "▒", "loaded": "→", "terminal": "○"}[support.mark]
        x, y = round(support.start[0]), round(support.start[1])
        if support.start[1] != support.end[1]:
            return self._write(y + 1, x, mark)
        cell = "[F]" if support.measured else ""
        text = f"{cell} {mark}" if support.mark == "driven" else f"{cell}{mark}"
        if support.end[0] < support.start[0]:
            text = text[::-1].translate(str.maketrans("[]", "]["))
            return self._write(y, x - len(text), text)
        return self._write(y, x + 1, text)

    def _write(self, row: int, column: int, text: str) -> None:
        for sign in text:
            self.text[row, column] = sign
            column += columns(sign)


def _cells(start: Point, end: Point) -> Iterator[tuple[int, int]]:
    x, y, u, v = map(round, (*start, *end))
    steps = max(abs(u - x), abs(v - y))
    for step in range(steps + 1):
        yield y + (v > y) * step - (v < y) * step, x + (u > x) * step - (u < x) * step
