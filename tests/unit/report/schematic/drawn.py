"""What can be read off an SVG schematic without knowing how it was laid out: boxes, and what is connected with what."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from xml.etree import ElementTree

NUMBER = r"-?\d+(?:\.\d+)?"
# widths of Helvetica in thousandths of the size, after its AFM file; bold is at most a fifth wider
ADVANCES = {
    **dict.fromkeys("ijl'|", 260),
    **dict.fromkeys(" .,:;/!·[]It", 278),
    **dict.fromkeys("fr()-²³", 333),
    **dict.fromkeys("cksvxyzJ", 500),
    **dict.fromkeys("=+<>~≈", 584),
    **dict.fromkeys("abdeghnopqu0123456789_L", 556),
    **dict.fromkeys("ABEKPSVXYwCDHNRU", 722),
    **dict.fromkeys("FTZ", 611),
    **dict.fromkeys("GOQ", 778),
    **dict.fromkeys("mM%", 889),
    **dict.fromkeys("W@…", 1000),
}


@dataclass(frozen=True)
class Rectangle:
    """A rectangle with what it stands for."""

    left: float
    top: float
    right: float
    bottom: float
    what: str = ""
    owner: str = ""

    def overlaps(self, other: Rectangle, play: float = 0.2) -> bool:
        """Whether the two have more than a rim in common."""
        across = min(self.right, other.right) - max(self.left, other.left)
        down = min(self.bottom, other.bottom) - max(self.top, other.top)
        return across > play and down > play

    def inside(self, other: Rectangle, play: float = 0.2) -> bool:
        """Whether it lies in the other one."""
        return (
            self.left >= other.left - play
            and self.top >= other.top - play
            and self.right <= other.right + play
            and self.bottom <= other.bottom + play
        )


@dataclass(frozen=True)
class Ports:
    """A symbol of branches between two nets, and where its ends are."""

    branches: tuple[str, ...]
    kind: str
    ends: tuple[tuple[float, float], tuple[float, float]]
    rectangle: Rectangle = field(compare=False)

    @property
    def upright(self) -> bool:
        """Whether its force runs up the page."""
        return abs(self.ends[0][1] - self.ends[1][1]) > abs(self.ends[0][0] - self.ends[1][0])


def points_of(path: str) -> list[tuple[float, float]]:
    """The points of a path of straight lines."""
    assert not set(path) - set("ML Z.-0123456789"), path
    numbers = [float(number) for number in re.findall(NUMBER, path)]
    return list(zip(numbers[::2], numbers[1::2], strict=True))


def around(points: list[tuple[float, float]], what: str, owner: str) -> Rectangle:
    """The box of points."""
    xs, ys = zip(*points, strict=True)
    return Rectangle(min(xs), min(ys), max(xs), max(ys), what, owner)


def width_of(text: str, size: float, bold: bool) -> float:
    """How wide Helvetica sets a text."""
    return (
        sum(ADVANCES.get(sign, 700 if ord(sign) < 0x2E80 else 1000) for sign in text) * size / 1000 * (1.0 + 0.1 * bold)
    )


class Drawn:
    """A schematic as its reader sees it."""

    def __init__(self, text: str) -> None:
        self.root = ElementTree.fromstring(text)
        self.groups = [child for child in self.root if _tag(child) == "g"]
        left, top, wide, high = (float(number) for number in self.root.attrib["viewBox"].split())
        self.page = Rectangle(left, top, left + wide, top + high)

    def of(self, kind: str) -> list[ElementTree.Element]:
        """The groups of a class."""
        return [group for group in self.groups if kind in group.attrib["class"].split()]

    @cached_property
    def wires(self) -> list[tuple[tuple[float, float], tuple[float, float]]]:
        """All connections."""
        return [tuple(points_of(child.attrib["d"])) for child in self.root if child.attrib.get("class") == "wire"]

    @cached_property
    def signs(self) -> list[Ports]:
        """All symbols."""
        return [self._ports(group) for group in self.of("sign")]

    def _ports(self, group: ElementTree.Element) -> Ports:
        paths = [
            points_of(child.attrib["d"])
            for child in group
            if _tag(child) == "path" and child.attrib.get("class") != "thin"
        ]
        branches = tuple(group.attrib["data-branch"].split())
        return Ports(
            branches,
            group.attrib["class"].split()[1],
            (paths[0][0], paths[-1][-1]),
            self._box(group, "sign", " ".join(branches)),
        )

    @cached_property
    def rails(self) -> dict[str, list[Rectangle]]:
        """The lines and boxes of the nodes by name."""
        found: dict[str, list[Rectangle]] = {}
        for group in self.of("node"):
            body = any(_tag(child) == "rect" for child in group)
            found.setdefault(group.attrib["data-node"], []).append(
                self._box(group, "body" if body else "rail", group.attrib["data-node"])
            )
        return found

    @cached_property
    def labels(self) -> list[Rectangle]:
        """The boxes of all labels."""
        return [self._box(group, "label", group.attrib["data-owner"]) for group in self.of("words")]

    def words(self, owner: str) -> list[list[str]]:
        """The texts of the labels of a branch or node."""
        return [
            ["".join(text.itertext()) for text in group]
            for group in self.of("words")
            if owner in group.attrib["data-owner"].split()
        ]

    @cached_property
    def scalings(self) -> list[Rectangle]:
        """The boxes of the scaling arrows."""
        return [self._box(group, "scaling", group.attrib["data-branch"]) for group in self.of("scaling")]

    @cached_property
    def supports(self) -> list[Rectangle]:
        """The boxes of the marks of nodes."""
        return [self._box(group, "support", group.attrib["data-node"]) for group in self.of("support")]

    def _box(self, group: ElementTree.Element, what: str, owner: str) -> Rectangle:
        return around([point for child in group for point in _outline(child)], what, owner)

    @cached_property
    def everything(self) -> list[Rectangle]:
        """The boxes of all that is drawn."""
        wires = [around(list(wire), "wire", "") for wire in self.wires]
        return [*wires, *(self._box(group, "", "") for group in self.groups)]


def _outline(child: ElementTree.Element) -> Iterator[tuple[float, float]]:
    kind, at = _tag(child), child.attrib
    if kind == "path":
        yield from points_of(at["d"])
    elif kind == "rect":
        x, y = float(at["x"]), float(at["y"])
        yield from ((x, y), (x + float(at["width"]), y + float(at["height"])))
    elif kind == "circle":
        x, y, radius = (float(at[key]) for key in ("cx", "cy", "r"))
        yield from ((x - radius, y - radius), (x + radius, y + radius))
    else:
        assert kind == "text"
        width = width_of("".join(child.itertext()), 12.0, at.get("class") == "name")
        x, y = float(at["x"]), float(at["y"])
        left = x - width / 2 if at.get("text-anchor") == "middle" else x
        yield from ((left, y - 9.0), (left + width, y + 3.0))


def _tag(element: ElementTree.Element) -> str:
    return element.tag.rpartition("}")[2]


class Nets:
    """What wires and nodes connect: two ends are one net where an end of one lies on the other."""

    def __init__(self, drawn: Drawn) -> None:
        self.things: list[tuple[Rectangle, tuple[tuple[float, float], ...]]] = []
        self.parent: list[int] = []
        named: dict[str, int] = {}
        for wire in drawn.wires:
            self._add(around(list(wire), "wire", ""), wire)
        for name, boxes in drawn.rails.items():
            for box in boxes:
                number = self._add(box, ())
                self._join(named.setdefault(name, number), number)
        self.named = named
        self.ports = [tuple(self._add(around([end], "port", ""), (end,)) for end in sign.ends) for sign in drawn.signs]
        for one, (_, ends) in enumerate(self.things):
            for other, (box, _) in enumerate(self.things):
                if any(_touches(end, box) for end in ends):
                    self._join(one, other)

    def node(self, name: str) -> int:
        """The net of a node."""
        return self.root(self.named[name])

    def root(self, number: int) -> int:
        """The net of a thing."""
        while self.parent[number] != number:
            number = self.parent[number]
        return number

    def _add(self, box: Rectangle, ends: tuple[tuple[float, float], ...]) -> int:
        self.things.append((box, ends))
        self.parent.append(len(self.parent))
        return len(self.parent) - 1

    def _join(self, one: int, other: int) -> None:
        self.parent[self.root(one)] = self.root(other)


def _touches(point: tuple[float, float], box: Rectangle, play: float = 0.11) -> bool:
    return (box.left - play <= point[0] <= box.right + play) and (box.top - play <= point[1] <= box.bottom + play)
