"""The room that nodes and bundles need, and their places across the force."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise

from dashpot.report.schematic.blocks import Block, Row
from dashpot.report.schematic.graph import Bundle
from dashpot.report.schematic.order import Arrangement
from dashpot.report.schematic.positions import CENTRED, SHORT, STRAIGHT, Program
from dashpot.report.schematic.sizes import Sizes


@dataclass(frozen=True)
class NodeRoom:
    """What a node needs across the force: at least ``width``, and ``before`` and ``after`` beyond its ends."""

    width: float
    before: float = 0.0
    after: float = 0.0


@dataclass(frozen=True)
class Places:
    """Where the nodes begin and end, and where the axes of the bundles are; of one drawn sideways, its middle."""

    nodes: Mapping[str, tuple[float, float]]
    bundles: Mapping[Bundle, float]


@dataclass(frozen=True)
class Footing:
    """What stands in a row of the drawing: from one place less a margin to another place plus a margin."""

    left: int
    before: float
    right: int
    after: float


class Placing:
    """Sets up the program of a drawing and reads its answer."""

    def __init__(
        self, arrangement: Arrangement, blocks: Mapping[Bundle, Block], rooms: Mapping[str, NodeRoom], sizes: Sizes
    ) -> None:
        self.arrangement, self.blocks, self.rooms, self.sizes = arrangement, blocks, rooms, sizes
        self.program = Program(sizes.whole)
        self.axes = {bundle: self.program.unknown(1e-4) for bundle in arrangement.bundles}
        self.ends = {key: (self.program.unknown(-SHORT + 1e-3), self.program.unknown(SHORT)) for key in rooms}

    def places(self) -> Places:
        """The places of all nodes and bundles."""
        for level in range(self.arrangement.top + 1):
            self._keep_apart(list(self._level(level)))
            self._keep_apart(list(self._between(level)))
            self._keep_crossings_apart(level)
        for key, room in self.rooms.items():
            self.program.apart(*self.ends[key], room.width)
            self._reach_over(key)
            self._straighten(key)
        found = self.program.solve()
        return Places(
            {key: (found[left], found[right]) for key, (left, right) in self.ends.items()},
            {bundle: found[axis] for bundle, axis in self.axes.items()},
        )

    def axes_of(self, bundle: Bundle) -> tuple[float, ...]:
        """The wires of a bundle beside its axis."""
        block = self.blocks[bundle]
        return block.axes if isinstance(block, Row) else (0.0,)

    def _level(self, level: int) -> Iterator[Footing]:
        # a wire that has to cross a node does not keep clear of it
        torn = set(self.arrangement.torn(level))
        inside = self._inside(level) if torn else set()
        for owner in dict.fromkeys(self.arrangement.runs(level)):
            if isinstance(owner, str):
                yield self._node(owner)
            elif self.arrangement.sideways(owner):
                half = self.blocks[owner].length / 2
                yield Footing(self.axes[owner], half, self.axes[owner], half)
            elif owner not in inside:
                yield Footing(self.axes[owner], 0.0, self.axes[owner], 0.0)
        met = {owner for owner in self.arrangement.owners(level) if isinstance(owner, str)}
        yield from (self._node(key) for key in self.rooms if self.arrangement.levels[key] == level and key not in met)

    def _inside(self, level: int) -> set[Bundle]:
        runs = self.arrangement.runs(level)
        found: set[Bundle] = set()
        for key in self.arrangement.torn(level):
            first, last = runs.index(key), len(runs) - 1 - runs[::-1].index(key)
            found |= {owner for owner in runs[first:last] if not isinstance(owner, str)}
        return found

    def _node(self, key: str) -> Footing:
        left, right = self.ends[key]
        return Footing(left, self.rooms[key].before, right, self.rooms[key].after)

    def _between(self, level: int) -> Iterator[Footing]:
        for bundle, axis in self.axes.items():
            low, high = self.arrangement.span(bundle)
            if low == level < high:
                yield Footing(axis, self.blocks[bundle].before, axis, self.blocks[bundle].after)
            elif low < level < high:
                yield Footing(axis, 0.0, axis, 0.0)

    def _keep_apart(self, row: list[Footing]) -> None:
        for one, other in pairwise(row):
            self.program.apart(one.right, other.left, one.after + other.before + self.sizes.gap)

    def _keep_crossings_apart(self, level: int) -> None:
        met = list(zip(self.arrangement.owners(level), self.arrangement.bundles_at(level), strict=True))
        for (one, left), (other, right) in pairwise(met):
            if one != other and not (self.arrangement.sideways(left) or self.arrangement.sideways(right)):
                distance = self.axes_of(left)[-1] - self.axes_of(right)[0] + self.sizes.gap
                self.program.apart(self.axes[left], self.axes[right], distance)

    def _reach_over(self, key: str) -> None:
        left, right = self.ends[key]
        for bundle in self._upright_at(key):
            self.program.demand({self.axes[bundle]: 1.0, left: -1.0}, -self.axes_of(bundle)[0])
            self.program.demand({right: 1.0, self.axes[bundle]: -1.0}, self.axes_of(bundle)[-1])
            self.program.near({left: 0.5, right: 0.5, self.axes[bundle]: -1.0}, CENTRED)

    def _straighten(self, key: str) -> None:
        own = self.arrangement.levels[key]
        met = self._upright_at(key)
        below = [bundle for bundle in met if self.arrangement.span(bundle)[1] == own]
        above = [bundle for bundle in met if self.arrangement.span(bundle)[0] == own]
        for low in below:
            for high in above:
                self.program.near({self.axes[low]: 1.0, self.axes[high]: -1.0}, STRAIGHT)

    def _upright_at(self, key: str) -> list[Bundle]:
        return [
            bundle
            for bundle in self.axes
            if key in (bundle.lower, bundle.upper) and not self.arrangement.sideways(bundle)
        ]
