"""Which bundle stands left of which, so that as few wires as possible cross a node."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby, permutations

from dashpot.report.schematic.graph import Bundle, Graph
from dashpot.report.schematic.levels import Levels, levels_of, raised

EXHAUSTIVE = 6  # bundles; more are ordered by exchanging and moving single ones


@dataclass(frozen=True)
class Arrangement:
    """Nodes on levels and bundles from left to right."""

    graph: Graph
    levels: Levels
    bundles: tuple[Bundle, ...]

    @property
    def top(self) -> int:
        """The highest level."""
        return max(self.levels.values())

    def span(self, bundle: Bundle) -> tuple[int, int]:
        """The levels of the lower and the upper end as drawn."""
        low, high = sorted((self.levels[bundle.lower], self.levels[bundle.upper]))
        return low, high

    def sideways(self, bundle: Bundle) -> bool:
        """Whether both ends are on one level."""
        low, high = self.span(bundle)
        return low == high

    def flipped(self, bundle: Bundle) -> bool:
        """Whether the node that the file calls the upper one is drawn below, or to the left."""
        if self.sideways(bundle):
            runs = self.runs(self.levels[bundle.lower])
            return runs.index(bundle.lower) > runs.index(bundle)
        return self.levels[bundle.upper] < self.levels[bundle.lower]

    def bundles_at(self, level: int) -> list[Bundle]:
        """The bundles that end at a level, lie in it or pass it, from left to right."""
        return [bundle for bundle in self.bundles if self.span(bundle)[0] <= level <= self.span(bundle)[1]]

    def owners(self, level: int) -> list[str | Bundle]:
        """What meets a level from left to right: a node for each bundle that ends there, else the bundle itself."""
        return [self._owner(bundle, level) for bundle in self.bundles_at(level)]

    def _owner(self, bundle: Bundle, level: int) -> str | Bundle:
        ends = [key for key in (bundle.lower, bundle.upper) if self.levels[key] == level]
        return ends[0] if len(ends) == 1 else bundle

    def runs(self, level: int) -> list[str | Bundle]:
        """The same with neighbours of one owner as one."""
        return [owner for owner, _ in groupby(self.owners(level))]

    def torn(self, level: int) -> Iterator[str]:
        """The nodes of a level that something else stands in between."""
        runs = self.runs(level)
        yield from (key for key in dict.fromkeys(runs) if isinstance(key, str) and runs.count(key) > 1)

    def left_of(self, key: str) -> bool:
        """Whether a sideways bundle comes to a node from its left."""
        runs = self.runs(self.levels[key])
        return any(
            self.sideways(bundle) and runs.index(bundle) < runs.index(key)
            for bundle in self.bundles
            if key in (bundle.lower, bundle.upper)
        )

    def marked_inside(self, key: str) -> bool:
        """Whether a node has its mark beside it, as it can have it neither below nor above."""
        mark = self.graph.nodes[key].mark
        return mark == "loaded" or (mark is not None and self.levels[key] not in (0, self.top))

    def apart(self, bundle: Bundle) -> bool:
        """Whether something stands between a sideways bundle and one of its nodes."""
        runs = self.runs(self.levels[bundle.lower])
        place = runs.index(bundle)
        return set(runs[max(place - 1, 0) : place + 2]) != {bundle, bundle.lower, bundle.upper}


def arrange(graph: Graph, sideways: bool) -> Arrangement:
    """Levels and order. A node that cannot be drawn beside the others of its level gets a level of its own."""
    levels = levels_of(graph, sideways)
    while True:
        best = _ordered(graph, levels)
        moved = _in_the_way(best, sideways)
        if moved is None:
            return best
        levels = raised(levels, moved)


def _in_the_way(arrangement: Arrangement, sideways: bool) -> str | None:
    for level in range(arrangement.top + 1):
        torn = set(arrangement.torn(level))
        nodes = [key for key in arrangement.graph.nodes if arrangement.levels[key] == level]
        for bundle in arrangement.bundles:
            if arrangement.span(bundle) == (level, level) and not (sideways and _may_lie(bundle, arrangement)):
                return bundle.upper
        if torn and len(nodes) > 1 and (clashing := _clashing(arrangement.runs(level))):
            return clashing
    return None


def _may_lie(bundle: Bundle, arrangement: Arrangement) -> bool:
    marked = any(arrangement.marked_inside(key) for key in (bundle.lower, bundle.upper))
    return not (marked or arrangement.apart(bundle))


def _clashing(runs: Sequence[str | Bundle]) -> str | None:
    nodes = [key for key, _ in groupby(run for run in runs if isinstance(run, str))]
    return next((key for key in reversed(nodes) if nodes.count(key) > 1), None)


def _ordered(graph: Graph, levels: Levels) -> Arrangement:
    def made(order: Sequence[Bundle]) -> Arrangement:
        return Arrangement(graph, levels, tuple(order))

    if len(graph.bundles) <= EXHAUSTIVE:
        return min(map(made, permutations(graph.bundles)), key=_cost)
    starts = [list(graph.bundles), _side_by_side(graph, levels)]
    return min((_improved(made, start) for start in starts), key=_cost)


def _side_by_side(graph: Graph, levels: Levels) -> list[Bundle]:
    """What hangs together without the nodes that are held stands together; a bundle between two sides in between."""
    sides = {key: {key} for key, node in graph.nodes.items() if node.mark is None}
    across = [bundle for bundle in graph.bundles if levels[bundle.lower] == levels[bundle.upper]]
    upright = [bundle for bundle in graph.bundles if bundle not in across]
    for bundle in upright:
        if bundle.lower in sides and bundle.upper in sides:
            joined = sides[bundle.lower] | sides[bundle.upper]
            sides.update(dict.fromkeys(joined, joined))
    groups: dict[frozenset[str], list[Bundle]] = {}
    for bundle in upright:
        side = next((frozenset(sides[key]) for key in (bundle.lower, bundle.upper) if key in sides), frozenset())
        groups.setdefault(side, []).append(bundle)
    first, *rest = groups.values()
    return [*first, *across, *(bundle for group in rest for bundle in group)]


def _improved(made: Callable[[Sequence[Bundle]], Arrangement], order: list[Bundle]) -> Arrangement:
    best = made(order)
    while True:
        tried = min(
            (made(_shifted(best.bundles, old, new)) for old in range(len(order)) for new in range(len(order))),
            key=_cost,
        )
        if _cost(tried) >= _cost(best):
            return best
        best = tried


def _shifted(order: Sequence[Bundle], old: int, new: int) -> list[Bundle]:
    rest = [bundle for place, bundle in enumerate(order) if place != old]
    return [*rest[:new], order[old], *rest[new:]]


def _cost(arrangement: Arrangement) -> tuple[int, int]:
    crossings = sum(
        len(runs) - len(set(runs)) for level in range(arrangement.top + 1) if (runs := arrangement.runs(level))
    )
    crossings += 2 * sum(arrangement.apart(bundle) for bundle in arrangement.bundles if arrangement.sideways(bundle))
    places = {bundle: place for place, bundle in enumerate(arrangement.graph.bundles)}
    file_order = [places[bundle] for bundle in arrangement.bundles]
    inversions = sum(a > b for i, a in enumerate(file_order) for b in file_order[i + 1 :])
    return crossings, inversions
