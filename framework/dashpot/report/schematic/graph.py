"""What is to be drawn: nodes, and between each two of them one bundle of branches."""

from __future__ import annotations

from collections.abc import Mapping
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
    """The branches between two nodes."""

    lower: str
    upper: str
    members: tuple[Branch | Group, ...]


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
    for name in standing:
        nodes[_foot(name)] = Node(_foot(name), name, "ground")
    pairs: dict[tuple[str, str], list[Branch | Group]] = {}
    for member in spec.root.members:
        lower, upper = ends[member.name].lower, ends[member.name].upper
        pairs.setdefault((_foot(lower) if lower in standing else lower, upper), []).append(member)
    return Graph(nodes, tuple(Bundle(*pair, tuple(members)) for pair, members in _one_way(pairs).items()))


def _node(joint: Joint, joined: bool) -> Node:
    mark = None if joint.hold == "free" else joint.hold
    measured = joint.hold == ("driven" if joined else "ground")
    return Node(joint.name, joint.name, mark, joint_lines(joint), bool(joint.masses), measured)


def _foot(name: str) -> str:
    return f"{name}:below"


def _one_way(
    pairs: dict[tuple[str, str], list[Branch | Group]],
) -> dict[tuple[str, str], list[Branch | Group]]:
    # branches that run against others between the same nodes are drawn with them
    found: dict[tuple[str, str], list[Branch | Group]] = {}
    for (lower, upper), members in pairs.items():
        found.setdefault((upper, lower) if (upper, lower) in found else (lower, upper), []).extend(members)
    return found
