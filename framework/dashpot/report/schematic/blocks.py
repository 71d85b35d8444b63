"""Branches, series and parallel connections as blocks: each has a place for its symbols and its label.

A block lies along the force, between two points of one axis, and reaches ``before`` and ``after`` to the sides.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from dashpot.model.picture import Symbol
from dashpot.report.schematic.shapes import Box, Point, Scaling, Shape, Sign, Wire, Words
from dashpot.report.schematic.sizes import Sizes


@dataclass(frozen=True)
class Frame:
    """Where along and across are on the page: upright, along is up and across to the right; else right and down."""

    upright: bool

    def at(self, along: float, across: float) -> Point:
        """A point of the page."""
        return (across, -along) if self.upright else (along, across)


class Block(ABC):
    """Something between two ends of an axis. It is at least ``length`` long and may be drawn longer."""

    length: float
    before: float
    after: float

    @abstractmethod
    def draw(self, frame: Frame, start: float, end: float, axis: float) -> Iterator[Shape]:
        """Its shapes between two places along the axis."""


@dataclass(frozen=True)
class Piece(Block):
    """One symbol with a lead on both sides."""

    symbol: Symbol
    size: float
    half: float
    lead: float
    branches: tuple[str, ...]
    word: str = ""
    curved: bool = False

    @property
    def length(self) -> float:  # type: ignore[override]
        """The symbol and its leads."""
        return self.size + 2 * self.lead

    @property
    def before(self) -> float:  # type: ignore[override]
        """Half of the symbol."""
        return self.half

    @property
    def after(self) -> float:  # type: ignore[override]
        """Half of the symbol."""
        return self.half

    def draw(self, frame: Frame, start: float, end: float, axis: float) -> Iterator[Shape]:
        """The symbol in the middle."""
        first = start + (end - start - self.size) // 2
        last = first + self.size
        yield Wire(frame.at(start, axis), frame.at(first, axis))
        yield Sign(
            self.symbol, frame.at(first, axis), frame.at(last, axis), self.half, self.branches, self.word, self.curved
        )
        yield Wire(frame.at(last, axis), frame.at(end, axis))


class Chain(Block):
    """Blocks in series."""

    def __init__(self, members: Sequence[Block]) -> None:
        self.members = members
        self.length = sum(member.length for member in members)
        self.before = max(member.before for member in members)
        self.after = max(member.after for member in members)

    def draw(self, frame: Frame, start: float, end: float, axis: float) -> Iterator[Shape]:
        """One after the other, each with its share of the room that is left."""
        share = (end - start - self.length) // len(self.members)
        for member in self.members[:-1]:
            yield from member.draw(frame, start, start + member.length + share, axis)
            start += member.length + share
        yield from self.members[-1].draw(frame, start, end, axis)


class Row(Block):
    """Blocks side by side, without what joins their ends. ``axes`` are their places beside the middle axis."""

    def __init__(self, members: Sequence[Block], gap: float, whole: bool) -> None:
        self.members = members
        self.length = max(member.length for member in members)
        places = [0.0]
        for left, right in zip(members, members[1:], strict=False):
            places.append(places[-1] + left.after + gap + right.before)
        middle = places[-1] // 2 if whole else places[-1] / 2
        self.axes = tuple(place - middle for place in places)
        self.before = members[0].before - self.axes[0]
        self.after = members[-1].after + self.axes[-1]

    def draw(self, frame: Frame, start: float, end: float, axis: float) -> Iterator[Shape]:
        """All of them between the same ends."""
        for member, place in zip(self.members, self.axes, strict=True):
            yield from member.draw(frame, start, end, axis + place)


class Fan(Block):
    """Blocks side by side, joined by a bar at both ends."""

    def __init__(self, row: Row, stub: float) -> None:
        self.row, self.stub = row, stub
        self.length = row.length + 2 * stub
        self.before, self.after = row.before, row.after

    def draw(self, frame: Frame, start: float, end: float, axis: float) -> Iterator[Shape]:
        """The bars, what is between them, and the leads to them."""
        first, last = start + self.stub, end - self.stub
        yield Wire(frame.at(start, axis), frame.at(first, axis))
        for bar in (first, last):
            yield Wire(frame.at(bar, axis + self.row.axes[0]), frame.at(bar, axis + self.row.axes[-1]))
        yield from self.row.draw(frame, first, last, axis)
        yield Wire(frame.at(last, axis), frame.at(end, axis))


class Scaled(Block):
    """A block under a scaling arrow, which reaches ``margin`` beyond it, or with one ``aside``, behind it."""

    def __init__(self, inner: Block, margin: float, aside: float, knots: int, branches: tuple[str, ...]) -> None:
        self.inner, self.aside, self.knots, self.branches = inner, aside, knots, branches
        self.length = inner.length + aside
        self.before, self.after = inner.before + margin, inner.after + margin

    def draw(self, frame: Frame, start: float, end: float, axis: float) -> Iterator[Shape]:
        """The block, and the arrow over its middle or behind it."""
        yield from self.inner.draw(frame, start, end - self.aside, axis)
        if self.aside:
            place = frame.at(end - self.aside / 2, axis)
            yield Wire(frame.at(end - self.aside, axis), frame.at(end, axis))
            yield Scaling(Box.around(place), self.knots, self.branches)
            return
        middle, reach = (start + end) / 2, min((self.before + self.after) / 2, self.length / 2)
        corners = frame.at(middle - reach, axis - self.before), frame.at(middle + reach, axis + self.after)
        yield Scaling(Box.around(*corners), self.knots, self.branches)


class Labelled(Block):
    """A block with its name and numbers: beside it where the force runs up, above it where it runs to the right."""

    def __init__(
        self, inner: Block, name: str, lines: tuple[str, ...], owners: tuple[str, ...], sizes: Sizes, upright: bool
    ) -> None:
        self.inner, self.owners, self.upright = inner, owners, upright
        self.name, self.lines = sizes.label(name, lines)
        self.width, self.height = sizes.extent(self.name, self.lines)
        self.space = sizes.space if upright or not sizes.whole else 0.0
        self.before = inner.before + (0.0 if upright else self.height + self.space)
        self.after = inner.after + (self.width + self.space if upright else 0.0)
        needed = self.height if upright else self.width
        self.length = max(inner.length, needed + 2 * sizes.lead)

    def draw(self, frame: Frame, start: float, end: float, axis: float) -> Iterator[Shape]:
        """The block, and the label around the middle of it."""
        yield from self.inner.draw(frame, start, end, axis)
        x, y = frame.at((start + end) // 2, axis)
        if self.upright:
            left, top = x + self.inner.after + self.space, y - self.height / 2
        else:
            left, top = x - self.width // 2, y - self.inner.before - self.space - self.height
        box = Box(left, top, left + self.width, top + self.height)
        yield Words(self.name, self.lines, box, self.owners, centred=not self.upright)


@dataclass(frozen=True)
class Lead(Block):
    """A plain wire."""

    length: float
    before: float = 0.0
    after: float = 0.0

    def draw(self, frame: Frame, start: float, end: float, axis: float) -> Iterator[Shape]:
        """The wire."""
        yield Wire(frame.at(start, axis), frame.at(end, axis))
