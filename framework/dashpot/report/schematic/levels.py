"""At which height each node is drawn: what is driven below, what is held above, and no branch runs down."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from dashpot.report.schematic.graph import Bundle, Graph

Levels = Mapping[str, int]


def levels_of(graph: Graph, sideways: bool) -> dict[str, int]:
    """The level of every node, counted from below. With ``sideways``, branches may join nodes of one level."""
    bundles = list(graph.bundles)
    if sideways:
        for bundle in graph.bundles:
            others = [other for other in bundles if other is not bundle]
            levels = _climb(graph, others)
            if 0 < levels[bundle.lower] == levels[bundle.upper] and not _held(graph, bundle):
                bundles = others
    return _climb(graph, bundles)


def raised(levels: Levels, node: str) -> dict[str, int]:
    """The levels with a new one for this node alone, just above its own."""
    own = levels[node]
    return {name: level + 1 if level > own or name == node else level for name, level in levels.items()}


def _held(graph: Graph, bundle: Bundle) -> bool:
    return any(graph.nodes[key].mark in ("ground", "driven") for key in (bundle.lower, bundle.upper))


def _climb(graph: Graph, bundles: Iterable[Bundle]) -> dict[str, int]:
    above: dict[str, list[str]] = {key: [] for key in graph.nodes}
    for bundle in bundles:
        above[bundle.lower].append(bundle.upper)
    bases = [key for key in graph.nodes if _is_base(graph, key)]
    levels = dict.fromkeys(graph.nodes, 0)
    for key in (*bases, *graph.nodes):
        _lift(key, above, levels, set(bases), ())
    tops = [key for key in graph.nodes if _is_top(graph, key)]
    highest = max([levels[key] for key in graph.nodes if key not in tops], default=0) + 1
    levels = {key: max(level, highest) if key in tops else level for key, level in levels.items()}
    ranks = {level: rank for rank, level in enumerate(sorted(set(levels.values())))}
    return {key: ranks[level] for key, level in levels.items()}


def _lift(
    key: str, above: Mapping[str, list[str]], levels: dict[str, int], bases: set[str], way: tuple[str, ...]
) -> None:
    # the longest way from below; a branch that would close a circle is drawn from above
    for upper in above[key]:
        if upper in way or upper == key or upper in bases:
            continue
        if levels[upper] < levels[key] + 1:
            levels[upper] = levels[key] + 1
            _lift(upper, above, levels, bases, (*way, key))


def _is_base(graph: Graph, key: str) -> bool:
    held = graph.nodes[key].mark in ("driven", "ground", "terminal")
    return held and any(bundle.lower == key for bundle in graph.bundles)


def _is_top(graph: Graph, key: str) -> bool:
    held = graph.nodes[key].mark in ("driven", "ground", "terminal")
    return held and not _is_base(graph, key) and any(bundle.upper == key for bundle in graph.bundles)
