"""A network without the massless nodes inside its series connections: nodes that count, and what lies between them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import permutations
from typing import Literal

from dashpot.model.likeness.make import Make, is_even, make_of
from dashpot.model.network import NetworkSpec
from dashpot.model.topology import Edge, Joint, topology_of

Label = Make | tuple[object, ...]


@dataclass(frozen=True)
class Part:
    """An edge, with its make as seen from here and from the other side, or several parts in series or in parallel."""

    kind: Literal["edge", "series", "parallel"]
    edge: Edge | None = None
    members: tuple[Part, ...] = ()
    make: Make | None = None
    other_side: Make | None = None

    @cached_property
    def label(self) -> Label:
        """What parts of one structure share; the order within a series or a parallel connection does not count."""
        if self.make:
            return self.make
        return (self.kind, *sorted((member.label for member in self.members), key=repr))

    def edges(self) -> list[Part]:
        """The single edges, in an order that parts of one label share."""
        if self.kind == "edge":
            return [self]
        return [edge for member in sorted(self.members, key=lambda part: repr(part.label)) for edge in member.edges()]

    def describe(self, fully: bool = False) -> str:
        """The part in words."""
        if self.make:
            return self.make.describe(fully)
        words = [member.describe(fully) if member.make else f"({member.describe(fully)})" for member in self.members]
        return f"series of {' and '.join(words)}" if self.kind == "series" else " parallel to ".join(words)


@dataclass(frozen=True)
class Reduced:
    """The nodes that are held, loaded, have a mass or branch, and the parts between every two of them."""

    spec: NetworkSpec
    joints: Mapping[str, Joint]
    parts: Mapping[tuple[str, str], tuple[Part, ...]]

    def between(self, lower: str, upper: str) -> tuple[Part, ...]:
        """What lies between two nodes, seen from the first to the second."""
        forth = self.parts.get((lower, upper), ())
        return forth + tuple(_turned(part) for part in self.parts.get((upper, lower), ()))

    @cached_property
    def labels(self) -> dict[tuple[str, str], Counter[Label]]:
        """How many parts of each structure lie between every two nodes, seen from the first to the second."""
        return {pair: Counter(part.label for part in self.between(*pair)) for pair in permutations(self.joints, 2)}


def reduce_network(spec: NetworkSpec) -> Reduced:
    """The network with every massless free node between two parts taken into a series connection."""
    topology = topology_of(spec, fixture=False)
    joints = dict(topology.joints)
    links = [(edge.lower, edge.upper, _edge(edge, spec)) for edge in topology.edges]
    loose = True
    while loose:
        loose = False
        for name in [name for name, joint in joints.items() if joint.hold == "free" and not joint.masses]:
            links = _merged_at(name, links)
            touching = [link for link in links if name in link[:2]]
            if len(touching) == 2:
                links = [link for link in links if name not in link[:2]] + [_joined(name, touching)]
                del joints[name]
                loose = True
    parts: dict[tuple[str, str], tuple[Part, ...]] = {}
    for lower, upper, part in links:
        parts[lower, upper] = parts.get((lower, upper), ()) + (part.members if part.kind == "parallel" else (part,))
    return Reduced(spec, joints, parts)


Link = tuple[str, str, Part]


def _edge(edge: Edge, spec: NetworkSpec) -> Part:
    ends = spec.ends.get(edge.offset.rpartition(".")[0])
    offset = ends.offset if ends else None
    even = offset is None and is_even(edge.branch)
    makes = tuple(make_of(edge.branch, offset, turned and not even) for turned in (False, True))
    return Part("edge", edge, make=makes[0], other_side=makes[1])


def _turned(part: Part) -> Part:
    if part.edge:
        return replace(part, make=part.other_side, other_side=part.make)
    return replace(part, members=tuple(_turned(member) for member in reversed(part.members)))


def _seen_from(name: str, link: Link) -> tuple[str, Part]:
    lower, upper, part = link
    return (upper, part) if lower == name else (lower, _turned(part))


def _merged_at(name: str, links: list[Link]) -> list[Link]:
    # what is in parallel next to a massless node becomes one part
    others = [link for link in links if name not in link[:2]]
    beside: dict[str, list[Part]] = {}
    for link in links:
        if name in link[:2]:
            other, part = _seen_from(name, link)
            beside.setdefault(other, []).extend(part.members if part.kind == "parallel" else [part])
    return others + [
        (name, other, parts[0] if len(parts) == 1 else Part("parallel", members=tuple(parts)))
        for other, parts in beside.items()
    ]


def _joined(name: str, touching: list[Link]) -> Link:
    (below, first), (above, second) = (_seen_from(name, link) for link in touching)
    members = [
        member for part in (_turned(first), second) for member in (part.members if part.kind == "series" else (part,))
    ]
    return below, above, Part("series", members=tuple(members))
