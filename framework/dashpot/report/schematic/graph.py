"""What is to be drawn: nodes, and between each two of them one bundle of branches."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from dashpot.model.network import END, GROUND, Branch, Ends, Group, Joint, NetworkSpec
from dashpot.report.schematic.shapes import Mark
from dashpot.report.schematic.wording import joint_lines


@dataclass(frozen=True)
class Node:
    """A node of the drawing. The ground may stand in it twice, below and above, under one ``name``."""

    key: str
    name: str
    mark: Mark | None
    lines: tuple[str, ...] = ()
    massive: bool = False
    measured: bool = False


@dataclass(frozen=True, eq=False)
class Bundle:
    """The branches between two nodes; those named ``backward`` lead from the upper to the lower one."""

    lower: str
    upper: str
    members: tuple[Branch | Group, ...]
    backward: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Graph:
    """Nodes by key, and bundles in the order of the file."""

    nodes: Mapping[str, Node]
    bundles: tuple[Bundle, ...]


def graph_of(spec: NetworkSpec) -> Graph:
    """The graph of a network. In one with two ends the force is measured at the end that is held."""
    joints = dict(spec.joints) or {END: Joint(END, "driven"), GROUND: Joint(GROUND, "ground")}
    ends = {member.name: spec.ends.get(member.name, Ends(END, GROUND)) for member in spec.root.members}
    standing = {end.lower for end in ends.values() if joints[end.lower].hold == "ground"}
    standing &= {end.upper for end in ends.values()}
    nodes = {name: _node(joint, bool(spec.joints)) for name, joint in joints.items()}
    nodes |= {_foot(name): Node(_foot(name), name, "ground") for name in sorted(standing)}
    feet = {name: _foot(name) if name in standing else name for name in joints}
    pairs = {name: (feet[end.lower], end.upper) for name, end in ends.items()}
    return Graph(nodes, tuple(_bundles(spec.root.members, pairs)))


def _node(joint: Joint, joined: bool) -> Node:
    mark = None if joint.hold == "free" else joint.hold
    measured = joint.hold == ("driven" if joined else "ground")
    return Node(joint.name, joint.name, mark, joint_lines(joint), bool(joint.masses), measured)


def _foot(name: str) -> str:
    return f"{name}:below"


def _bundles(members: Iterable[Branch | Group], pairs: Mapping[str, tuple[str, str]]) -> Iterator[Bundle]:
    found: dict[tuple[str, str], list[Branch | Group]] = {}
    for member in members:
        lower, upper = pairs[member.name]
        found.setdefault((upper, lower) if (upper, lower) in found else (lower, upper), []).append(member)
    for pair, together in found.items():
        backward = frozenset(member.name for member in together if pairs[member.name] != pair)
        yield Bundle(*pair, tuple(together), backward)
