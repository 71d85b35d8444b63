"""One figure: nodes on their levels, bundles between them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace

from dashpot.report.schematic.blocks import Block, Frame
from dashpot.report.schematic.graph import Bundle, Graph, Node
from dashpot.report.schematic.order import Arrangement, arrange
from dashpot.report.schematic.room import NodeRoom, Places, Placing
from dashpot.report.schematic.shapes import Box, Rail, Shape, Support, Wire, Words
from dashpot.report.schematic.sizes import Sizes

# the block of a bundle: may its wires end apart, does its force run up, is its upper node at the start
MakeBlock = Callable[[Bundle, bool, bool, bool], Block]


def figure(graph: Graph, make: MakeBlock, sizes: Sizes) -> list[Shape]:
    """The shapes of a graph whose bundles are drawn as ``make`` says."""
    arrangement = arrange(graph, sideways=sizes.upright)
    blocks = {bundle: _block(bundle, arrangement, make, sizes) for bundle in arrangement.bundles}
    styles = {key: Style(node, arrangement, sizes) for key, node in graph.nodes.items()}
    rooms = {key: style.room for key, style in styles.items()}
    placing = Placing(arrangement, blocks, rooms, sizes)
    drawing = Figure(arrangement, blocks, styles, placing, placing.places(), sizes)
    return list(drawing.shapes())


def _block(bundle: Bundle, arrangement: Arrangement, make: MakeBlock, sizes: Sizes) -> Block:
    low, high = arrangement.span(bundle)
    upright = sizes.upright and low != high
    return make(bundle, high == low + 1, upright, arrangement.flipped(bundle))


class Style:
    """How a node is drawn: with a mark beyond the outermost levels, else named beside its end or inside its mass."""

    def __init__(self, node: Node, arrangement: Arrangement, sizes: Sizes) -> None:
        self.node, self.sizes = node, replace(sizes, filling=0.0)
        level = arrangement.levels[node.key]
        below = all(
            arrangement.span(bundle)[0] == level
            for bundle in arrangement.bundles
            if node.key in (bundle.lower, bundle.upper)
        )
        held = node.mark in ("driven", "ground", "terminal")
        self.side = 0
        if held and level in (0, arrangement.top):
            self.side = -1 if level == 0 and below else 1 if level == arrangement.top else 0
        torn = node.key in set(arrangement.torn(level))
        self.body = node.massive and sizes.upright and not torn and not self.side
        name = node.name or "driven end"
        self.name, self.lines = self.sizes.label(name, node.lines)
        width, height = self.sizes.extent(self.name, self.lines)
        self.label = (height, width) if sizes.upright else (width, height)  # along, across
        self.lifted = not self.side and not self.body and arrangement.left_of(node.key)

    @property
    def mark_length(self) -> float:
        """How far the mark reaches from the node."""
        if self.node.mark is None:
            return 0.0
        mark = self.sizes.support / 2 if self.node.mark == "ground" and not self.sizes.whole else self.sizes.support
        return mark + (self.sizes.cell if self.node.measured else 0.0)

    @property
    def half(self) -> float:
        """Half of what the node itself covers along the force."""
        return self.label[0] / 2 + self.sizes.pad if self.body else 0.0

    @property
    def rim(self) -> float:
        """How far the box of a mass reaches beyond its outermost wires."""
        return 1.5 * self.sizes.pad if self.body else 0.0

    @property
    def room(self) -> NodeRoom:
        """What it needs across the force."""
        if self.side:
            return NodeRoom(max(self.label[1] - self.sizes.whole, 4 * self.sizes.half))
        mark = self.mark_length + self.sizes.half
        if self.body:
            return NodeRoom(self.label[1], self.rim, self.rim + (mark if self.node.mark else 0.0))
        return NodeRoom(0.0, self.label[1] + self.sizes.space, mark if self.node.mark else 0.0)

    @property
    def reach(self) -> tuple[float, float]:
        """What it needs along the force, below and above its line."""
        outer = self.mark_length + self.sizes.space + self.label[0]
        inner = max(self.half, self.label[0] / 2, self.sizes.half if self.node.mark else 0.0)
        if self.sizes.whole:
            inner = float(-(-inner // 1))
        above = self.label[0] + self.sizes.space if self.lifted else inner
        return (outer if self.side < 0 else inner, outer if self.side > 0 else above)

    def shapes(self, frame: Frame, along: float, left: float, right: float) -> Iterator[Shape]:
        """The line or box of the node, its mark, its name."""
        ends = frame.at(along - self.half, left - self.rim), frame.at(along + self.half, right + self.rim)
        held = self.node.mark in ("driven", "ground")
        yield Rail(self.node.name, Box.around(*ends), self.body, held)
        if self.side:
            yield from self._outer(frame, along, self._halved(left + right), self._halved(right - left))
        else:
            yield from self._inner(frame, along, left, right)

    def _outer(self, frame: Frame, along: float, across: float, reach: float) -> Iterator[Shape]:
        end = along + self.side * self.mark_length
        assert self.node.mark
        half = reach if self.node.mark == "ground" and not self.node.measured else self.sizes.half
        yield Support(
            self.node.mark, self.node.name, frame.at(along, across), frame.at(end, across), half, self.node.measured
        )
        near = end + self.side * self.sizes.space
        far = near + self.side * self.label[0]
        first = across - self._halved(self.label[1])
        yield self._words(Box.around(frame.at(near, first), frame.at(far, first + self.label[1])))

    def _inner(self, frame: Frame, along: float, left: float, right: float) -> Iterator[Shape]:
        if self.node.mark:
            edge = right + self.rim
            yield Support(
                self.node.mark,
                self.node.name,
                frame.at(along, edge),
                frame.at(along, edge + self.mark_length),
                self.sizes.half,
                self.node.measured,
            )
        if self.body:
            first = (left + right - self.label[1]) / 2
        else:
            first = left - self.sizes.space - self.label[1]
        start = along - self._halved(self.label[0])
        if self.lifted:
            start = along + self.sizes.space / 2
        yield self._words(Box.around(frame.at(start, first), frame.at(start + self.label[0], first + self.label[1])))

    def _halved(self, length: float) -> float:
        return length // 2 if self.sizes.whole else length / 2

    def _words(self, box: Box) -> Words:
        return Words(self.name, self.lines, box, (self.node.name,), centred=True)


@dataclass(frozen=True)
class Figure:
    """Everything that has its place, ready to be drawn."""

    arrangement: Arrangement
    blocks: Mapping[Bundle, Block]
    styles: Mapping[str, Style]
    placing: Placing
    places: Places
    sizes: Sizes

    def shapes(self) -> Iterator[Shape]:
        """All shapes."""
        frame = Frame(self.sizes.upright)
        lines = self._lines()
        for key, style in self.styles.items():
            yield from style.shapes(frame, lines[self.arrangement.levels[key]], *self.places.nodes[key])
        for bundle in self.arrangement.bundles:
            if self.arrangement.sideways(bundle):
                yield from self._sideways(bundle, lines)
            else:
                yield from self._upright(bundle, frame, lines)

    def _lines(self) -> list[float]:
        """Where along the force the levels are."""
        found = [0.0]
        for level in range(self.arrangement.top):
            found.append(found[-1] + self._reach(level)[1] + self._room(level) + self._reach(level + 1)[0])
        return found

    def _room(self, level: int) -> float:
        lengths = [
            self.blocks[bundle].length
            for bundle in self.arrangement.bundles
            if self.arrangement.span(bundle)[0] == level and not self.arrangement.sideways(bundle)
        ]
        return max(lengths, default=2 * self.sizes.lead) + 2 * self.sizes.lead

    def _reach(self, level: int) -> tuple[float, float]:
        reaches = [style.reach for key, style in self.styles.items() if self.arrangement.levels[key] == level]
        reaches += [
            (block.after, block.before)
            for bundle, block in self.blocks.items()
            if self.arrangement.span(bundle) == (level, level)
        ]
        below, above = zip(*reaches, strict=True)
        return max(below), max(above)

    def _upright(self, bundle: Bundle, frame: Frame, lines: list[float]) -> Iterator[Shape]:
        low, high = self.arrangement.span(bundle)
        start = lines[low] + self._reach(low)[1]
        end, axis = start + self._room(low), self.places.bundles[bundle]
        yield from self.blocks[bundle].draw(frame, start, end, axis)
        ends = sorted((bundle.lower, bundle.upper), key=lambda key: self.arrangement.levels[key])
        edges = lines[low] + self.styles[ends[0]].half, lines[high] - self.styles[ends[1]].half
        for place in self.placing.axes_of(bundle):
            for one, other in ((edges[0], start), (end, edges[1])):
                if one < other:
                    yield Wire(frame.at(one, axis + place), frame.at(other, axis + place))

    def _sideways(self, bundle: Bundle, lines: list[float]) -> Iterator[Shape]:
        y = -lines[self.arrangement.levels[bundle.lower]]
        block, middle = self.blocks[bundle], self.places.bundles[bundle]
        first, last = middle - block.length / 2, middle + block.length / 2
        yield from block.draw(Frame(upright=False), first, last, y)
        left, right = sorted((self.places.nodes[bundle.lower], self.places.nodes[bundle.upper]))
        rims = (self.styles[key].rim for key in sorted((bundle.lower, bundle.upper), key=self.places.nodes.__getitem__))
        yield Wire((left[1] + next(rims), y), (first, y))
        yield Wire((last, y), (right[0] - next(rims), y))
