"""Work and energy as rows of the workspace, gathered step by step beside the motion.

The work of a step is the mean of the forces at its two ends times its travel. For the same mean the forces balance at
every node, so the work put in is that done on all branches and masses, but for what the time scheme itself takes away.
"""

from __future__ import annotations

from collections.abc import Mapping

from dashpot.expr.node import Node, symbol
from dashpot.expr.rebuild import replaced
from dashpot.kernel.compiler.elimination import ZERO
from dashpot.kernel.compiler.mechanics import GIVES_WAY, GRAVITY, Balance, Moving, Rows, row_of
from dashpot.kernel.compiler.trace import TracedBranch, trace_stored
from dashpot.model.topology import Edge, Topology

WORK, STORED, BEGIN = "work", "stored", "begin"


def edge_row(edge: Edge, key: str) -> str:
    """The name of a row of a branch: ``work`` done on it, ``stored`` in it, and stored at the ``begin``, in J."""
    return f"edge:{edge.branch.name}|{key}"


class EnergyMeter:
    """Rows ``work``, ``stored`` and ``begin`` of every branch, of every node with a mass and of every driven node with
    a fixture that gives way; ``work`` of every drive.

    What a branch stores is not known where its element does not say it: then it has no rows ``stored`` and ``begin``.
    """

    def __init__(self, topology: Topology) -> None:
        self.topology = topology
        self.stored = {edge.branch.name: trace_stored(edge.branch, "edge") for edge in topology.edges}

    def rest(self, still: Balance) -> Rows:
        """No work is done yet."""
        rows: dict[str, Node] = {}
        for edge, law, force in self._edges(still):
            held = self._held(still, edge, law)
            rows |= {
                edge_row(edge, "force"): force,
                edge_row(edge, WORK): ZERO,
                **_first(edge_row(edge, BEGIN), held),
                **_first(edge_row(edge, STORED), held),
            }
        for joint in self._weighty():
            held = self._weight(still, joint)
            rows |= {row_of(joint, BEGIN): held, row_of(joint, STORED): held}
        for joint in self._pushed():
            rows |= {row_of(joint, WORK): ZERO, row_of(joint, "push"): self._outside(still, joint)}
        for joint in self.topology.mounts:
            held = self._strain(still, joint)
            rows |= {row_of(joint, BEGIN): held, row_of(joint, STORED): held}
        return rows

    def commit(self, moving: Moving) -> Rows:
        """The work of the step is added."""
        rows: dict[str, Node] = {}
        for edge, law, force in self._edges(moving):
            motion = moving.motion(edge)
            done = _added(edge_row(edge, WORK), edge_row(edge, "force"), force, motion["edge.new"] - motion["edge.old"])
            rows |= {
                edge_row(edge, "force"): force,
                edge_row(edge, WORK): done,
                **_first(edge_row(edge, STORED), self._held(moving, edge, law, done)),
            }
        for joint in self._weighty():
            rows[row_of(joint, STORED)] = self._weight(moving, joint)
        for joint in self._pushed():
            push = self._outside(moving, joint)
            travel = moving.position(joint) - moving.before(joint, "old", "position")
            rows |= {
                row_of(joint, WORK): _added(row_of(joint, WORK), row_of(joint, "push"), push, travel),
                row_of(joint, "push"): push,
            }
        for joint in self.topology.mounts:
            rows[row_of(joint, STORED)] = self._strain(moving, joint)
        return rows

    def _edges(self, balance: Balance) -> list[tuple[Edge, TracedBranch, Node]]:
        return list(zip(self.topology.edges, balance.laws, balance.forces, strict=True))

    def _held(self, balance: Balance, edge: Edge, law: TracedBranch, work: Node = ZERO) -> Node | None:
        stored = self.stored[edge.branch.name]
        if stored is None:
            return None
        memory = {name: balance.along(edge, node) for name, node in law.states.items()}
        speed = balance.difference(edge, balance.velocity)
        return replaced(stored, {**balance.motion(edge), "edge.velocity_new": speed, **memory, WORK: work})

    def _weighty(self) -> list[str]:
        return [name for name, joint in self.topology.joints.items() if joint.masses and joint.hold != "ground"]

    def _weight(self, balance: Balance, joint: str) -> Node:
        speed = balance.velocity(joint)
        return balance.mass(joint) * (0.5 * speed * speed + GRAVITY * balance.position(joint))

    def _pushed(self) -> tuple[str, ...]:
        return self.topology.held("driven", "loaded")

    def _outside(self, balance: Balance, joint: str) -> Node:
        return balance.driving(joint) if self.topology.joints[joint].hold == "driven" else balance.load(joint)

    def _strain(self, balance: Balance, joint: str) -> Node:
        """What a fixture stores."""
        force = balance.driving(joint)
        return 0.5 * GIVES_WAY * force * force


def _first(name: str, value: Node | None) -> Mapping[str, Node]:
    return {} if value is None else {name: value}


def _added(work: str, before: str, force: Node, travel: Node) -> Node:
    return symbol(work) + 0.5 * (symbol(before) + force) * travel
