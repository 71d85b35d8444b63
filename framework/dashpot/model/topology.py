"""A network as a graph: which nodes there are, and which two of them each element connects."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from dashpot.model.network import END, GROUND, Branch, Ends, Group, Hold, Joint, NetworkSpec

COMPLIANCE = "force.compliance"  # the key of a measurement under which the fixture gives way


@dataclass(frozen=True)
class Edge:
    """An element between two nodes: its deflection is z_lower - z_upper, plus the number at the slot ``offset``."""

    branch: Branch
    lower: str
    upper: str
    offset: str = ""


@dataclass(frozen=True)
class Topology:
    """The nodes of a network, the ones inside series connections among them, and its edges in the order of the file."""

    joints: Mapping[str, Joint]
    edges: tuple[Edge, ...]

    def held(self, *holds: Hold) -> tuple[str, ...]:
        """The names of the nodes that are held in one of these ways."""
        return tuple(name for name, joint in self.joints.items() if joint.hold in holds)

    @property
    def unknown(self) -> tuple[str, ...]:
        """The nodes whose motion has to be solved for."""
        return self.held("free", "loaded")

    @property
    def parallel(self) -> bool:
        """Whether every element sees the motion of the one driven node alone."""
        return not self.unknown and self.held("driven") == (END,)

    @property
    def mounts(self) -> dict[str, str]:
        """The nodes that a fixture carries, by the driven node that it is fixed to."""
        return {joint.mounted: name for name, joint in self.joints.items() if joint.mounted is not None}

    def edges_at(self, joint: str) -> tuple[Edge, ...]:
        """The edges that end at a node."""
        return tuple(edge for edge in self.edges if joint in (edge.lower, edge.upper))


def topology_of(spec: NetworkSpec, fixture: bool = True) -> Topology:
    """The graph of a network. Nodes inside the series connection ``leg`` are called ``leg:1``, ``leg:2`` ...

    With a compliance of the ``fixture`` each driven node ``wheel`` moves the network by way of a free one,
    ``wheel:mounted``, which also has its masses; no edge lies between the two.
    """
    topology = _rigid_topology(spec)
    return _mounted(topology) if fixture and COMPLIANCE in spec.measurement else topology


def _mounted(topology: Topology) -> Topology:
    joints: dict[str, Joint] = {}
    names: dict[str, str] = {}
    for name, joint in topology.joints.items():
        if joint.hold != "driven":
            joints[name] = joint
            continue
        names[name] = inner = f"{name}:mounted"
        joints[name] = replace(joint, masses={}, shares="")
        joints[inner] = replace(joint, name=inner, hold="free", shares=joint.numbers, mounted=name)
    edges = (
        replace(edge, lower=names.get(edge.lower, edge.lower), upper=names.get(edge.upper, edge.upper))
        for edge in topology.edges
    )
    return Topology(joints, tuple(edges))


def _rigid_topology(spec: NetworkSpec) -> Topology:
    joints = dict(spec.joints) or {END: Joint(END, "driven"), GROUND: Joint(GROUND, "ground")}
    edges: list[Edge] = []
    for member in spec.root.members:
        ends = spec.ends.get(member.name, Ends(END, GROUND))
        offset = f"{ends.shares or member.name}.offset" if ends.offset else ""
        for edge in _edges(member, ends.lower, ends.upper, joints):
            edges.append(replace(edge, offset=offset if edge.lower == ends.lower else ""))
    return Topology(joints, tuple(edges))


def _edges(member: Branch | Group, lower: str, upper: str, joints: dict[str, Joint]) -> Iterator[Edge]:
    if isinstance(member, Branch):
        yield Edge(member, lower, upper)
        return
    if member.kind == "parallel":
        for inner in member.members:
            yield from _edges(inner, lower, upper, joints)
        return
    between = [f"{member.name}:{number}" for number in range(1, len(member.members))]
    joints.update({name: Joint(name, "free", place=member.place) for name in between})
    for inner, below, above in zip(member.members, [lower, *between], [*between, upper], strict=True):
        yield from _edges(inner, below, above, joints)
