"""Nodes that nothing holds."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Literal

from dashpot.model.lint.law import Law
from dashpot.model.network import Joint, NetworkSpec
from dashpot.model.topology import Edge, Topology
from dashpot.text.problem import Place, Problem


def find_loose_nodes(topology: Topology, spec: NetworkSpec) -> Iterator[Problem]:
    """Networks that nothing moves, nodes that nothing connects or that hang on nothing, masses that cannot move."""
    if not topology.held("driven", "loaded"):
        place = spec.document.root.place if spec.document else Place()
        yield Problem(place, "nothing moves the network: no node is driven or loaded", "write e.g. 'platform: driven'")
    standing = reached(topology.held("driven", "ground"), topology.edges)
    for name, joint in topology.joints.items():
        if not topology.edges_at(name):
            severity: Literal["error", "warning"] = "warning" if joint.hold in ("driven", "ground") else "error"
            yield Problem(
                joint.place, f"nothing connects the node '{name}'", "connect it by a branch, or remove it", severity
            )
        elif name not in standing:
            yield Problem(
                joint.place,
                f"{_called(name)} floats: no chain of branches leads from it to a driven or held node",
                "connect it to a node that is 'driven' or 'ground'",
            )
        if joint.hold == "ground" and joint.masses:
            yield Problem(
                joint.place,
                f"nothing depends on the mass of '{name}', which is held still",
                "remove the mass, or let the node move",
                "warning",
            )


def find_sliding_nodes(topology: Topology, spec: NetworkSpec) -> Iterator[Problem]:
    """Nodes from which no chain of branches that hold a static force leads to a driven or held node."""
    holding = [edge for edge in topology.edges if Law.of(edge.branch).holds()]
    standing = reached(topology.held("driven", "ground"), holding)
    for name in topology.unknown:
        if name not in standing:
            yield Problem(
                topology.joints[name].place,
                f"{_called(name)} can only slide: no chain of branches that "
                f"hold a static force leads from it to a driven or held node{_pulled(topology, name, spec)}",
                "add a stiffness",
                "warning",
            )


def reached(start: Iterable[str], edges: Iterable[Edge]) -> set[str]:
    """The nodes that chains of these edges lead to."""
    found, left = set(start), list(edges)
    while crossing := [edge for edge in left if edge.lower in found or edge.upper in found]:
        found |= {end for edge in crossing for end in (edge.lower, edge.upper)}
        left = [edge for edge in left if edge not in crossing]
    return found


def _called(name: str) -> str:
    series, _, number = name.partition(":")
    return f"the node behind part {number} of the series '{series}'" if number else f"the node '{name}'"


def _pulled(topology: Topology, name: str, spec: NetworkSpec) -> str:
    joint: Joint = topology.joints[name]
    if joint.hold == "loaded":
        return ", but a load acts on it"
    return ", but gravity pulls at its mass" if spec.gravity and joint.masses else ""
