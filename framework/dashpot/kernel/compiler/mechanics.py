"""The mechanics of a network with unknown nodes, as graphs: kinematics, balance of forces, Newton's step.

The unknowns are the new positions of the free nodes; that of a node on a fixture counts from the driven node that
carries it, so that a fixture that does not give way adds nothing to the motion. Every edge answers its force and its
new memory for a given motion of its two ends; the derivative of that force after the new position is the tangent that
Newton's method needs.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from functools import reduce
from typing import Protocol

import numpy as np

from dashpot.expr.derive import derive
from dashpot.expr.node import Node, constant, maximum, minimum, symbol, where
from dashpot.expr.rebuild import replaced
from dashpot.kernel.compiler.elimination import ZERO, Mount, solve_symmetric
from dashpot.kernel.compiler.trace import TracedBranch
from dashpot.model.topology import COMPLIANCE, Edge, Topology

SMALLEST_DAMPING, NEARER = 1.0 / 64.0, 0.1
ONE, NEVER = constant(1.0), constant(1e300)

# what drives the steps, the same for all lanes
SLOPE, NOW, BEFORE, SWING = (symbol(f"rule.{key}") for key in ("slope", "now", "before", "swing"))
TOLERANCE, FARTHEST = symbol("newton.tolerance"), symbol("newton.farthest")
GRAVITY, STEP, GIVES_WAY = symbol("gravity"), symbol("dt"), symbol(f"measurement.{COMPLIANCE}")
# rows that belong to the whole network
DONE, DAMPING, DISTANCE, LINES, NOTHING = (
    f"newton|{key}" for key in ("done", "damping", "distance", "lines", "nothing")
)
RULE = ("rule.slope", "rule.now", "rule.before", "rule.swing", "newton.tolerance", "newton.farthest")
MOVED = ("old", "new", "velocity_old", "velocity_new", "acceleration")

Rows = Mapping[str, Node]


def driven_symbol(joint: str, key: str) -> str:
    """The name of a known motion (``MOVED``) or ``load`` of a node."""
    return f"node:{joint}.{key}"


def row_of(joint: str, key: str) -> str:
    """The name of a row: position, velocity, acceleration, position_before, velocity_before, next ... of a node."""
    return f"node:{joint}|{key}"


def force_row(joint: str) -> str:
    """The row of the force that the outside exerts on a driven node, upwards, in N."""
    return row_of(joint, "force")


def reached_row(name: str) -> str:
    """The row in which a row is kept until the step is done."""
    return f"{name}|reached"


KEPT = ("position", "velocity", "acceleration", "position_before", "velocity_before")


class Meter(Protocol):
    """Rows of its own that are kept beside those of the network."""

    def rest(self, still: Balance) -> Rows:
        """Their values when the record begins."""

    def commit(self, moving: Moving) -> Rows:
        """Their values at the end of a step."""


class Balance(ABC):
    """The balance of forces at the unknown nodes."""

    def __init__(self, topology: Topology, laws: list[TracedBranch]) -> None:
        self.topology, self.laws = topology, laws
        pairs = list(zip(topology.edges, laws, strict=True))
        self.forces = [self.along(edge, law.force) for edge, law in pairs]
        self.tangents = [self.along(edge, self.tangent(law.force)) for edge, law in pairs]

    @abstractmethod
    def motion(self, edge: Edge) -> Mapping[str, Node]:
        """The motion of an edge: what stands for ``edge.old``, ``edge.new`` ..."""

    @abstractmethod
    def tangent(self, force: Node) -> Node:
        """The change of a force with the new deflection."""

    @abstractmethod
    def guess(self, joint: str) -> Node:
        """Where the search for an unknown node begins."""

    @abstractmethod
    def inertia(self, joint: str) -> tuple[Node, Node]:
        """The acceleration of a node and its change with the new position."""

    @property
    def unknown(self) -> tuple[str, ...]:
        """The nodes whose motion is solved for."""
        return self.topology.unknown

    def load(self, joint: str) -> Node:
        """The force that is known to act on a node."""
        return symbol(driven_symbol(joint, "load")) if self.topology.joints[joint].hold == "loaded" else ZERO

    def position(self, joint: str) -> Node:
        """Where a node is at the end of the step."""
        known = self.known(joint, "new")
        return self.carrier(joint, "new") + self._next(joint) if known is None else known

    @abstractmethod
    def velocity(self, joint: str) -> Node:
        """The velocity of a node at the end of the step."""

    def along(self, edge: Edge, law: Node) -> Node:
        """What a law says for the motion of its edge."""
        return replaced(law, self.motion(edge))

    def mass(self, joint: str) -> Node:
        """The mass of a node."""
        node = self.topology.joints[joint]
        return sum([symbol(f"{node.numbers}.{key}") for key in node.masses], ZERO)

    def push(self, joint: str, forces: Sequence[Node] | None = None) -> Node:
        """The sum of the forces of all edges on a node, upwards; ``forces`` may be given."""
        total = ZERO
        for edge, force in zip(self.topology.edges, forces or self.forces, strict=True):
            if joint == edge.upper:
                total = total + force
            elif joint == edge.lower:
                total = total - force
        return total

    def carried(self, joint: str, forces: Sequence[Node] | None = None) -> Node:
        """The force that the outside has to exert on a node to move it as it moves; ``forces`` as in ``push``."""
        mass = self.mass(joint)
        weight = ZERO if mass is ZERO else mass * (self.inertia(joint)[0] + GRAVITY)
        return weight - self.push(joint, forces)

    def improve(self) -> dict[str, Node]:
        """Newton's step of all unknowns, damped where the last one did not get nearer; finished lanes stay."""
        ways = self.newton(self.missing(), self.tangents)
        distance = reduce(maximum, (np.absolute(way) for way in ways.values()), ZERO)
        done, before, damping = symbol(DONE) > 0.5, symbol(DISTANCE), symbol(DAMPING)
        # the last step, short where it was damped or the way far, should have come nearer by a part of its own length
        stalled = distance > before - NEARER * minimum(damping * before, FARTHEST)
        damped = where(stalled, maximum(0.5 * damping, SMALLEST_DAMPING), minimum(2.0 * damping, 1.0))
        near = self.arrived(distance, ways)
        share = where(near, 1.0, minimum(damped, FARTHEST / maximum(distance, FARTHEST)))
        moves = {joint: where(done, 0.0, share * way) for joint, way in ways.items()}
        after = {row_of(joint, "next"): self._next(joint) + move for joint, move in moves.items()}
        return {
            **after,
            **self.reached(moves),
            DISTANCE: distance,
            DAMPING: damped,
            DONE: where(done | near, 1.0, 0.0),
        }

    @property
    def mounted(self) -> tuple[str, ...]:
        """Those of them that a fixture carries."""
        return tuple(inner for inner in self.topology.mounts.values() if inner in self.unknown)

    def missing(self) -> dict[str, Node]:
        """The force upwards that every unknown node still lacks to move as it does."""
        return {joint: self.load(joint) - self.carried(joint) for joint in self.unknown}

    def newton(
        self, missing: Mapping[str, Node], tangents: Sequence[Node], farthest: Node | None = None
    ) -> dict[str, Node]:
        """Newton's way of every unknown node, by the ``tangents`` of all edges; see ``solve_symmetric``."""
        mounts = {inner: self.mount(inner) for inner in self.mounted}
        return solve_symmetric(self._matrix(tangents), missing, mounts, farthest)

    def mount(self, inner: str) -> Mount:
        """How a fixture holds what it carries."""
        return Mount(GIVES_WAY, -self._next(inner))

    def arrived(self, distance: Node, ways: Mapping[str, Node]) -> Node:
        """Whether Newton's method ends with a step of this distance, the longest of the ``ways``.

        What is not a number is not far: such a lane is finished, and its forces tell.
        """
        return np.logical_not(distance > TOLERANCE)

    def reached(self, moves: Mapping[str, Node]) -> dict[str, Node]:
        """What else is known when the unknown nodes have made these moves."""
        return {}

    def way(self, edge: Edge, moves: Mapping[str, Node]) -> Node:
        """What moves of the unknown nodes add to the deflection of an edge."""
        return self.difference(edge, lambda joint: moves.get(joint, ZERO))

    def moved_forces(self, moves: Mapping[str, Node]) -> list[Node]:
        """The forces of all edges after moves of the unknown nodes, by their tangents."""
        return [
            force + tangent * self.way(edge, moves)
            for edge, force, tangent in zip(self.topology.edges, self.forces, self.tangents, strict=True)
        ]

    def _next(self, joint: str) -> Node:
        return symbol(row_of(joint, "next"))

    def _matrix(self, tangents: Sequence[Node]) -> dict[str, dict[str, Node]]:
        unknown = self.unknown
        rows: dict[str, dict[str, Node]] = {joint: {joint: ZERO} for joint in unknown}
        for joint in unknown:
            mass = self.mass(joint)
            rows[joint][joint] = ZERO if mass is ZERO else mass * self.inertia(joint)[1]
        for edge, tangent in zip(self.topology.edges, tangents, strict=True):
            join(rows, edge, tangent)
        return rows

    def difference(self, edge: Edge, of: Callable[[str], Node]) -> Node:
        """A kinematic quantity of an edge: that of its lower node less that of its upper one."""
        return of(edge.lower) - of(edge.upper)

    def known(self, joint: str, key: str) -> Node | None:
        """The motion of a node that the drive gives; None for an unknown one."""
        hold = self.topology.joints[joint].hold
        return {"ground": ZERO, "driven": symbol(driven_symbol(joint, key))}.get(hold)

    def carrier(self, joint: str, key: str) -> Node:
        """The motion that the position of an unknown node counts from."""
        mounted = self.topology.joints[joint].mounted
        return ZERO if mounted is None else symbol(driven_symbol(mounted, key))

    def outputs(self, forces: Sequence[Node] | None = None) -> dict[str, Node]:
        """The forces at the driven nodes; ``forces`` as in ``push``."""
        return {force_row(joint): self.driving(joint, forces) for joint in self.topology.held("driven")}

    def driving(self, joint: str, forces: Sequence[Node] | None = None) -> Node:
        """The force at a driven node, through its fixture if it has one; ``forces`` as in ``push``."""
        return self.carried(self.topology.mounts.get(joint, joint), forces)

    @staticmethod
    def offset(edge: Edge) -> Node:
        """The deflection of an edge whose nodes stand at zero."""
        return symbol(edge.offset) if edge.offset else ZERO


class Moving(Balance):
    """One step."""

    slope, pull = SLOPE, SLOPE  # the change of a velocity with the new position, of an acceleration with the velocity

    @property
    def bend(self) -> Node:
        """The change of an acceleration with the new position."""
        return self.pull * self.slope

    def velocity(self, joint: str) -> Node:
        known = self.known(joint, "velocity_new")
        return self.carrier(joint, "velocity_new") + self._own_velocity(joint) if known is None else known

    def _own_velocity(self, joint: str) -> Node:
        """That of an unknown node, against what carries it."""
        return self.slope * self._next(joint) + symbol(row_of(joint, "drift"))

    def _own_acceleration(self, joint: str) -> Node:
        return self.pull * self._own_velocity(joint) + symbol(row_of(joint, "swing"))

    def acceleration(self, joint: str) -> Node:
        """The acceleration of a node at the end of the step."""
        known = self.known(joint, "acceleration")
        return self.carrier(joint, "acceleration") + self._own_acceleration(joint) if known is None else known

    def before(self, joint: str, key: str, row: str) -> Node:
        """The motion of a node at the begin of the step."""
        known = self.known(joint, key)
        return self.carrier(joint, key) + symbol(row_of(joint, row)) if known is None else known

    def motion(self, edge: Edge) -> Mapping[str, Node]:
        offset = self.offset(edge)
        return {
            "edge.old": self.difference(edge, lambda joint: self.before(joint, "old", "position")) + offset,
            "edge.new": self.difference(edge, self.position) + offset,
            "edge.velocity_old": self.difference(edge, lambda joint: self.before(joint, "velocity_old", "velocity")),
            "edge.velocity_new": self.difference(edge, self.velocity),
            "edge.acceleration": self.difference(edge, self.acceleration),
        }

    def tangent(self, force: Node) -> Node:
        rates = self.slope * derive(force, "edge.velocity_new") + self.bend * derive(force, "edge.acceleration")
        return derive(force, "edge.new") + rates

    def inertia(self, joint: str) -> tuple[Node, Node]:
        return self.acceleration(joint), self.bend

    def rest(self) -> dict[str, Node]:
        """What else is known before the first step."""
        return {}

    def predict(self) -> dict[str, Node]:
        """What the rule adds to the new velocity and acceleration, and where the nodes go with what they have."""
        rows: dict[str, Node] = {DONE: ZERO, DAMPING: ONE, DISTANCE: NEVER, LINES: ZERO}
        for joint in self.topology.unknown:
            x, v, a, earlier, slower = (symbol(row_of(joint, key)) for key in KEPT)
            rows[row_of(joint, "drift")] = NOW * x + BEFORE * earlier + SWING * v
            rows[row_of(joint, "swing")] = NOW * v + BEFORE * slower + SWING * a
            rows[row_of(joint, "next")] = self.guess(joint)
        return rows

    def guess(self, joint: str) -> Node:
        """Where an unknown node goes with the velocity, and as a mass with the acceleration, that it has."""
        x, v, a = (symbol(row_of(joint, key)) for key in ("position", "velocity", "acceleration"))
        bend = 0.5 * STEP * a if self.topology.joints[joint].masses else ZERO
        return x + STEP * (v + bend)

    def arrived(self, distance: Node, ways: Mapping[str, Node]) -> Node:
        # a search begins anew where steps led to what is no number, unless the first guess was none
        return where(symbol(DISTANCE) >= NEVER, super().arrived(distance, ways), distance <= TOLERANCE)

    def reached(self, moves: Mapping[str, Node]) -> dict[str, Node]:
        """Memories and measured forces at the end of the last move, by their tangents: it is within the tolerance.

        A lane that is done stays as it is.
        """
        found = self.outputs(self.moved_forces(moves))
        for joint, inner in self.topology.mounts.items():
            mass = self.mass(inner)
            if mass is not ZERO:
                row = force_row(joint)
                found[row] = found[row] + mass * self.inertia(inner)[1] * moves[inner]
        for edge, law in zip(self.topology.edges, self.laws, strict=True):
            way = self.way(edge, moves)
            for name, node in law.states.items():
                found[name] = self.along(edge, node) + self.along(edge, self.tangent(node)) * way
        done = symbol(DONE) > 0.5
        return {reached_row(name): where(done, symbol(reached_row(name)), node) for name, node in found.items()}

    def commit(self) -> dict[str, Node]:
        """The end of the step becomes the begin of the next one."""
        names = [*(name for law in self.laws for name in law.states), *map(force_row, self.topology.held("driven"))]
        rows: dict[str, Node] = {name: symbol(reached_row(name)) for name in names}
        for joint in self.topology.unknown:
            rows |= {
                row_of(joint, "position"): self._next(joint),
                row_of(joint, "velocity"): self._own_velocity(joint),
                row_of(joint, "acceleration"): self._own_acceleration(joint),
                row_of(joint, "position_before"): symbol(row_of(joint, "position")),
                row_of(joint, "velocity_before"): symbol(row_of(joint, "velocity")),
            }
        return rows


def join(rows: dict[str, dict[str, Node]], edge: Edge, stiffness: Node) -> None:
    """Add the stiffness of an edge to a matrix of some nodes; the others are held."""
    ends = [joint for joint in (edge.lower, edge.upper) if joint in rows]
    for joint in ends:
        rows[joint][joint] = rows[joint][joint] + stiffness
    if len(ends) == 2:
        for one, other in (ends, ends[::-1]):
            rows[one][other] = rows[one].get(other, ZERO) - stiffness
