"""What a laid out schematic consists of, in the coordinates of the page: x to the right, y downwards."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

from dashpot.model.picture import Symbol

Point: TypeAlias = tuple[float, float]
Mark = Literal["driven", "ground", "loaded", "terminal"]


@dataclass(frozen=True)
class Box:
    """A rectangle."""

    left: float
    top: float
    right: float
    bottom: float

    @staticmethod
    def around(*points: Point) -> Box:
        """The smallest rectangle that holds the points."""
        xs, ys = zip(*points, strict=True)
        return Box(min(xs), min(ys), max(xs), max(ys))

    @staticmethod
    def union(boxes: list[Box]) -> Box:
        """The smallest rectangle that holds the rectangles."""
        return Box.around(*(corner for box in boxes for corner in ((box.left, box.top), (box.right, box.bottom))))

    @property
    def middle(self) -> Point:
        """The centre."""
        return (self.left + self.right) / 2, (self.top + self.bottom) / 2

    def moved(self, right: float, down: float) -> Box:
        """The same rectangle elsewhere."""
        return Box(self.left + right, self.top + down, self.right + right, self.bottom + down)


@dataclass(frozen=True)
class Wire:
    """A straight connection; where one ends on another they are joined, where they cross they are not."""

    start: Point
    end: Point

    @property
    def box(self) -> Box:
        """What it covers."""
        return Box.around(self.start, self.end)

    def moved(self, right: float, down: float) -> Wire:
        """The same elsewhere."""
        return Wire(_moved(self.start, right, down), _moved(self.end, right, down))


@dataclass(frozen=True)
class Sign:
    """A symbol between two points, of the branches that it stands for; ``word`` is what a box says.

    ``curved`` marks a characteristic that is no straight line, ``half`` is the width to each side of the axis.
    """

    symbol: Symbol
    start: Point
    end: Point
    half: float
    branches: tuple[str, ...]
    word: str = ""
    curved: bool = False

    @property
    def box(self) -> Box:
        """What it covers."""
        upright = self.start[0] == self.end[0]
        wide, high = (self.half, 0.0) if upright else (0.0, self.half)
        box = Box.around(self.start, self.end)
        return Box(box.left - wide, box.top - high, box.right + wide, box.bottom + high)

    def moved(self, right: float, down: float) -> Sign:
        """The same elsewhere."""
        return replace(self, start=_moved(self.start, right, down), end=_moved(self.end, right, down))


@dataclass(frozen=True)
class Scaling:
    """The slanted arrow over a branch whose force is multiplied by a factor; each knot of the factor is a dot on it."""

    box: Box
    knots: int
    branches: tuple[str, ...]

    def moved(self, right: float, down: float) -> Scaling:
        """The same elsewhere."""
        return replace(self, box=self.box.moved(right, down))


@dataclass(frozen=True)
class Words:
    """A name and the lines below it, of a branch or a node."""

    name: str
    lines: tuple[str, ...]
    box: Box
    owners: tuple[str, ...]
    centred: bool = False

    def moved(self, right: float, down: float) -> Words:
        """The same elsewhere."""
        return replace(self, box=self.box.moved(right, down))


@dataclass(frozen=True)
class Rail:
    """A node: a line, or with ``body`` the box of its mass."""

    node: str
    box: Box
    body: bool = False
    held: bool = False

    def moved(self, right: float, down: float) -> Rail:
        """The same elsewhere."""
        return replace(self, box=self.box.moved(right, down))


@dataclass(frozen=True)
class Support:
    """How a node is held or moved: ``start`` is on the node, ``end`` away from it; ``half`` is the width to each side.

    ``measured`` puts a load cell between the two.
    """

    mark: Mark
    node: str
    start: Point
    end: Point
    half: float
    measured: bool = False

    @property
    def box(self) -> Box:
        """What it covers."""
        return Sign(Symbol.BOX, self.start, self.end, self.half, ()).box

    def moved(self, right: float, down: float) -> Support:
        """The same elsewhere."""
        return replace(self, start=_moved(self.start, right, down), end=_moved(self.end, right, down))


Shape: TypeAlias = Wire | Sign | Scaling | Words | Rail | Support


def _moved(point: Point, right: float, down: float) -> Point:
    return point[0] + right, point[1] + down
