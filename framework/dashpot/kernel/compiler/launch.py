"""The first sample of a record: the places are those of the equilibrium, and the driven nodes are moving already.

Masses are still at rest, and a node without one has the velocity at which the laws balance that know rates but have no
memory. A memory begins empty, as in a network with two ends.
"""

from __future__ import annotations

from collections.abc import Mapping

from dashpot.expr.derive import derive
from dashpot.expr.node import Node, symbol, symbols_of, where
from dashpot.expr.rebuild import replaced
from dashpot.kernel.compiler.elimination import ZERO, Mount
from dashpot.kernel.compiler.equilibrium import Still
from dashpot.kernel.compiler.mechanics import DONE, GIVES_WAY, SLOPE, force_row, reached_row, row_of
from dashpot.kernel.compiler.trace import TracedBranch
from dashpot.model.topology import Topology

BOUNDLESS = 1e30  # m/N


class Launch(Still):
    """The balance of forces at the first sample; the unknowns are velocities, as ways of a step: v = slope way."""

    def __init__(self, topology: Topology, laws: list[TracedBranch]) -> None:
        self.memory = {name for law in laws for name in law.states}
        super().__init__(topology, laws)

    def sees_rates(self, law: TracedBranch) -> bool:
        return not law.states

    @property
    def unknown(self) -> tuple[str, ...]:
        # where all that gives way is a fixture, what it carries moves as the drive does
        return () if self.given else tuple(name for name in self.topology.unknown if not self._heavy(name))

    def _heavy(self, joint: str) -> bool:
        return bool(self.topology.joints[joint].masses)

    def position(self, joint: str) -> Node:
        known = self.known(joint, "new")
        return self.carrier(joint, "new") + symbol(row_of(joint, "position")) if known is None else known

    def velocity(self, joint: str) -> Node:
        own = SLOPE * self._next(joint) if joint in self.unknown else ZERO
        return super().velocity(joint) + own

    def tangent(self, force: Node) -> Node:
        if symbols_of(force) & self.memory:
            return ZERO
        return SLOPE * derive(replaced(force, {"edge.velocity_old": symbol("edge.velocity_new")}), "edge.velocity_new")

    def inertia(self, joint: str) -> tuple[Node, Node]:
        return self.acceleration(joint), ZERO

    def guess(self, joint: str) -> Node:
        """At rest."""
        return ZERO

    def reached(self, moves: Mapping[str, Node]) -> dict[str, Node]:
        """The measured forces at the end of the last move, by their tangents."""
        done = symbol(DONE) > 0.5
        return {
            reached_row(name): where(done, symbol(reached_row(name)), node)
            for name, node in self.outputs(self.moved_forces(moves)).items()
        }

    def missing(self) -> dict[str, Node]:
        # what the velocities add: that the places balance the rest is known, up to what Newton's method has left
        resting = {"edge.velocity_old": ZERO, "edge.velocity_new": ZERO}
        added = [
            force - self.along(edge, replaced(law.force, resting))
            for edge, law, force in zip(self.topology.edges, self.laws, self.forces, strict=True)
        ]
        return {joint: self.push(joint, added) for joint in self.unknown}

    def mount(self, inner: str) -> Mount:
        # a fixture keeps its force at first, one that does not give way its place
        return Mount(where(GIVES_WAY > 0.0, BOUNDLESS, 0.0), -self._next(inner))

    def set_off(self) -> dict[str, Node]:
        """The forces and the velocities with which the record begins."""
        if not self.unknown:
            return self.outputs()
        forces = {force_row(joint): symbol(reached_row(force_row(joint))) for joint in self.topology.held("driven")}
        return forces | {row_of(joint, "velocity"): SLOPE * self._next(joint) for joint in self.unknown}
