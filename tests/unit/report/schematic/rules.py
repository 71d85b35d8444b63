"""What must hold of every schematic, judged by the drawn SVG and the topology of the network alone."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from unit.report.schematic.drawn import Drawn, Nets, Ports, Rectangle

from dashpot.model.network import END, GROUND, Branch, NetworkSpec
from dashpot.model.picture import Picture, Symbol
from dashpot.model.topology import Edge, topology_of


def symbols_of(picture: Picture) -> list[str]:
    """The symbols of a picture by name."""
    if isinstance(picture, Symbol):
        return [picture.name.lower()]
    return [name for part in picture.parts for name in symbols_of(part)]


def overlaps(drawn: Drawn) -> list[tuple[Rectangle, Rectangle]]:
    """All that covers something else: symbols, labels, masses, supports and scaling arrows, and wires under labels."""
    bodies = [box for boxes in drawn.rails.values() for box in boxes if box.what == "body"]
    signs = [sign.rectangle for sign in drawn.signs]
    solid = [*signs, *drawn.labels, *bodies, *drawn.supports, *drawn.scalings]
    found = [pair for pair in combinations(solid, 2) if pair[0].overlaps(pair[1]) and not _belong_together(*pair)]
    lines = [_line(wire) for wire in drawn.wires]
    lines += [_thick(box) for boxes in drawn.rails.values() for box in boxes if box.what == "rail"]
    found += [(line, box) for line in lines for box in (*signs, *drawn.labels, *bodies) if line.overlaps(box, 0.05)]
    return found


def _belong_together(one: Rectangle, other: Rectangle) -> bool:
    kinds = {one.what, other.what}
    own = set(one.owner.split()) == set(other.owner.split())
    return own and (kinds == {"body", "label"} or kinds == {"sign", "scaling"})


def _line(wire) -> Rectangle:
    (x, y), (u, v) = wire
    return _thick(Rectangle(min(x, u), min(y, v), max(x, u), max(y, v), "wire"))


def _thick(box: Rectangle) -> Rectangle:
    # a line with the width of its stroke, its ends left out: there it touches what it is connected with
    flat = box.bottom - box.top < box.right - box.left
    x, y = (-0.5, 0.2) if flat else (0.2, -0.5)
    return Rectangle(box.left - x, box.top - y, box.right + x, box.bottom + y, box.what, box.owner)


def misdrawn(spec: NetworkSpec, drawn: Drawn) -> list[str]:
    """Branches that do not connect the nodes that they should, or are not drawn once with all their symbols."""
    nets = Nets(drawn)
    ends = {name: _ends_of(name, drawn, nets) for name in _shown(drawn)}
    known = {node: nets.node(node) for node in drawn.rails}
    topology = topology_of(spec)
    edges = [edge for edge in topology.edges if edge.branch.name in ends]
    _name_inner_nodes(edges, ends, known)
    found = [
        edge.branch.name
        for edge in edges
        if {known.get(edge.lower), known.get(edge.upper)} != set(ends[edge.branch.name])
    ]
    names = set(known.values())
    found += ["two nodes are one net"] if len(names) < len(known) else []
    return found + list(_wrong_symbols(spec, drawn))


def _shown(drawn: Drawn) -> list[str]:
    # of branches that share a drawing, the first one
    return list(dict.fromkeys(sign.branches[0] for sign in drawn.signs if sign.branches))


def _ends_of(name: str, drawn: Drawn, nets: Nets) -> tuple[int, int]:
    mine = [(sign, ports) for sign, ports in zip(drawn.signs, nets.ports, strict=True) if sign.branches[:1] == (name,)]
    axis = 1 if mine[0][0].upright else 0
    places = [(end[axis], nets.root(port)) for sign, ports in mine for end, port in zip(sign.ends, ports, strict=True)]
    return max(places)[1], min(places)[1]


def _name_inner_nodes(edges: list[Edge], ends: dict[str, tuple[int, int]], known: dict[str, int]) -> None:
    for _ in edges:
        for edge in edges:
            one, other = ends[edge.branch.name]
            for here, there in ((edge.lower, edge.upper), (edge.upper, edge.lower)):
                if here in known and there not in known and known[here] in (one, other):
                    known[there] = other if known[here] == one else one


def _wrong_symbols(spec: NetworkSpec, drawn: Drawn) -> Iterator[str]:
    for branch in spec.leaves():
        signs: list[Ports] = [sign for sign in drawn.signs if branch.name in sign.branches]
        if sorted(sign.kind for sign in signs) != sorted(symbols_of(branch.element.picture)):
            yield f"{branch.name}: {[sign.kind for sign in signs]}"
        if len(drawn.words(branch.name)) != 1:
            yield f"{branch.name}: {len(drawn.words(branch.name))} labels"
        if (branch.scale is not None) != any(branch.name in box.owner.split() for box in drawn.scalings):
            yield f"{branch.name}: scaling arrow"


def outside(drawn: Drawn) -> list[Rectangle]:
    """What leaves the page."""
    return [box for box in drawn.everything if not box.inside(drawn.page)]


def label_of(branch: Branch) -> str:
    """The last part of the name, with which every label of a branch ends in its first line."""
    return branch.name.rpartition(".")[2]


def ends_of_network(spec: NetworkSpec) -> set[str]:
    """The names of all nodes."""
    return set(spec.joints) or {END, GROUND}
