"""The static equilibrium with which a record begins."""

from __future__ import annotations

from collections.abc import Mapping

from dashpot.expr.derive import derive
from dashpot.expr.node import Node, symbol
from dashpot.expr.rebuild import replaced
from dashpot.kernel.compiler.elimination import ZERO
from dashpot.kernel.compiler.mechanics import (
    DAMPING,
    DISTANCE,
    DONE,
    KEPT,
    LINES,
    NEVER,
    ONE,
    Balance,
    driven_symbol,
    row_of,
)
from dashpot.kernel.compiler.trace import RATES, TracedBranch
from dashpot.model.topology import Edge, Topology


class Still(Balance):
    """The static equilibrium: nothing moves, no branch has a memory.

    Where all that gives way is a fixture, a law without a memory sees the first motion of the drive, as it does where
    the fixture is rigid.
    """

    def __init__(self, topology: Topology, laws: list[TracedBranch]) -> None:
        self.given = set(topology.unknown) == set(topology.mounts.values()) != set()
        self.prompt = {law.name for law in laws if self.sees_rates(law)}
        super().__init__(topology, laws)

    def sees_rates(self, law: TracedBranch) -> bool:
        """Whether a law sees the first motion."""
        return self.given and not law.states

    def velocity(self, joint: str) -> Node:
        """Unknown nodes begin at rest, driven ones as they are driven, and so what they carry."""
        known = self.known(joint, "velocity_new")
        return self.carrier(joint, "velocity_new") if known is None else known

    def motion(self, edge: Edge) -> Mapping[str, Node]:
        place = self.difference(edge, self.position) + self.offset(edge)
        return {"edge.new": place, **self._rest(place), **self._rates(edge)}

    def _rates(self, edge: Edge) -> dict[str, Node]:
        if edge.branch.name not in self.prompt:
            return {}
        speed = self.difference(edge, self.velocity)
        return {
            "edge.velocity_old": speed,
            "edge.velocity_new": speed,
            "edge.acceleration": self.difference(edge, self.acceleration),
        }

    def acceleration(self, joint: str) -> Node:
        """That of the driven nodes, and of what they carry."""
        known = self.known(joint, "acceleration")
        return self.carrier(joint, "acceleration") if known is None else known

    def _rest(self, place: Node) -> dict[str, Node]:
        memory = {name: ZERO for law in self.laws for name in law.states}
        return {"edge.old": place, **{f"edge.{rate}": ZERO for rate in RATES}, **memory}

    def tangent(self, force: Node) -> Node:
        return derive(replaced(force, self._rest(symbol("edge.new"))), "edge.new")

    def inertia(self, joint: str) -> tuple[Node, Node]:
        return ZERO, ZERO

    def start(self) -> dict[str, Node]:
        """Where the search for the equilibrium begins."""
        first = {row_of(joint, "next"): self.guess(joint) for joint in self.topology.unknown}
        return {**first, DONE: ZERO, DAMPING: ONE, DISTANCE: NEVER}

    def guess(self, joint: str) -> Node:
        """In the middle of the known nodes."""
        driven = [symbol(driven_symbol(name, "new")) for name in self.topology.held("driven")]
        carried = joint in self.topology.mounts.values()
        return ZERO if carried else sum(driven, ZERO) / float(max(len(driven), 1))

    def rest(self) -> dict[str, Node]:
        """At rest in equilibrium."""
        rows: dict[str, Node] = {name: ZERO for law in self.laws for name in law.states}
        for joint in self.topology.unknown:
            rows |= {row_of(joint, key): ZERO for key in KEPT}
            rows |= {row_of(joint, key): self._next(joint) for key in ("position", "position_before")}
        return {**rows, **self.outputs(), DONE: ZERO, LINES: ZERO}
