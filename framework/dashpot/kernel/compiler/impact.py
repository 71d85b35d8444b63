"""A step of a network in which masses hit rigid stops: inelastic impacts, without rebound.

A mass that a rigid stop catches within a step is there from the begin of the step on, with the velocity that the impact
leaves it: that of the stop, or the common one by which two masses keep their momentum. What comes after the impact is
smooth, and so is the force at the end of the step; the impulse is no force and in none. The centre of the masses moves
as if the impact had its own instant. Source: Moreau, Unilateral contact and dry friction in finite freedom dynamics
(1988), with a restitution of zero.

The step of an impact looks back at no acceleration: its own is constant, the velocity that laws see is way over time.
The impulses are those of least kinetic energy lost for velocities that the stops allow; a stop that was closed before
and is pulled open by an impact gives way.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import reduce

import numpy as np

from dashpot.expr.derive import derive
from dashpot.expr.node import Node, maximum, minimum, symbol, where
from dashpot.kernel.compiler.elimination import ZERO, solve_symmetric
from dashpot.kernel.compiler.mechanics import KEPT, SLOPE, STEP, TOLERANCE, Moving, join, row_of
from dashpot.kernel.compiler.trace import TracedBranch
from dashpot.model.topology import Edge, Topology

HIT = "impact|hit"  # row: 1.0 in a step with an impact
SLOWEST = 1e-300  # m/s: no distance is divided by zero
SHORTEST = 1e-9  # of the tolerance: a way that is rounding
RIGIDITY = 1e7  # of a stop in an impact, over the masses of the network
PLACE, SPEED = "place_after_impact", "velocity_after_impact"  # rows of a node, at the begin of a step

Stop = tuple[Edge, tuple[Node, Node]]


def struck(topology: Topology, laws: Sequence[TracedBranch]) -> list[Stop]:
    """The rigid stops, with the deflections at which they close, that catch a mass.

    Both of their ends are masses or known to move; a node without a mass gives way to any impulse.
    """
    pairs = zip(topology.edges, laws, strict=True)
    return [(edge, law.stops) for edge, law in pairs if law.stops is not None and _caught(topology, edge)]


def _caught(topology: Topology, edge: Edge) -> bool:
    ends = [topology.joints[name] for name in (edge.lower, edge.upper)]
    solved = [joint for joint in ends if joint.name in topology.unknown]
    return bool(solved) and all(joint.masses for joint in solved)


class Impacting(Moving):
    """One step, with the impacts at its begin."""

    slope = where(symbol(HIT) > 0.5, 1.0 / STEP, SLOPE)
    pull = where(symbol(HIT) > 0.5, 2.0 / STEP, SLOPE)

    def __init__(self, topology: Topology, laws: list[TracedBranch]) -> None:
        super().__init__(topology, laws)
        self.stops = struck(topology, laws)
        self.free = [name for name in self.unknown if self._heavy(name) and topology.joints[name].mounted is None]

    def rest(self) -> dict[str, Node]:
        """No stop has caught anything yet."""
        return {HIT: ZERO} | {_side(edge): ZERO for edge, _ in self.stops}

    def predict(self) -> dict[str, Node]:
        rows = super().predict()
        closing = self._closing({}, {})
        for _ in self.stops[1:]:
            # what an impact sets in motion may hit the next one
            after = self._closing(*self._impact(closing))
            closing = [where(side == 0.0, then, side) for side, then in zip(closing, after, strict=True)]
        ways, jumps = self._impact(closing)
        hit = reduce(maximum, (np.absolute(side) for side in closing))
        for joint in self.unknown:
            x, v, _, _, _ = (symbol(row_of(joint, key)) for key in KEPT)
            begin = x + where(hit > 0.5, ways.get(joint, ZERO), 0.0)
            left_with = v + where(hit > 0.5, jumps.get(joint, ZERO), 0.0)
            for key, hitting in (
                ("drift", -begin / STEP),
                ("swing", -2.0 / STEP * left_with),
                ("next", begin + STEP * left_with),
            ):
                rows[row_of(joint, key)] = where(hit > 0.5, hitting, rows[row_of(joint, key)])
            rows |= {row_of(joint, PLACE): begin, row_of(joint, SPEED): left_with}
        sides = zip(self.stops, self._sides(closing), strict=True)
        return rows | {_side(edge): side for (edge, _), side in sides} | {HIT: hit}

    def arrived(self, distance: Node, ways: Mapping[str, Node]) -> Node:
        # the forces at the end of the last step are told by tangents, which a stop that opens or closes changes
        opened = [self._beyond(edge, ends, ways) != self._beyond(edge, ends, {}) for edge, ends in self.stops]
        exact = np.logical_not(reduce(np.logical_or, opened)) | (distance <= SHORTEST * TOLERANCE)
        return super().arrived(distance, ways) & exact

    def commit(self) -> dict[str, Node]:
        rows = super().commit()
        for joint in self.unknown:
            rows[row_of(joint, "position_before")] = symbol(row_of(joint, PLACE))
            rows[row_of(joint, "velocity_before")] = symbol(row_of(joint, SPEED))
            if self._heavy(joint):
                own = rows[row_of(joint, "velocity")]
                after = 2.0 * own - symbol(row_of(joint, SPEED))
                rows[row_of(joint, "velocity")] = where(symbol(HIT) > 0.5, after, own)
        for edge, ends in self.stops:
            side = symbol(_side(edge))
            rows[_side(edge)] = where(self._beyond(edge, ends, {}) == side, side, 0.0)
        return rows

    def _heavy(self, joint: str) -> bool:
        return bool(self.topology.joints[joint].masses)

    def _closing(self, ways: Mapping[str, Node], jumps: Mapping[str, Node]) -> list[Node]:
        """1.0 for stops that are about to catch a mass in compression, -1.0 in rebound, 0.0 for the others.

        Impacts may have moved the nodes by ``ways`` and changed their velocities by ``jumps``.
        """
        found = []
        for edge, (rebound, compression) in self.stops:
            old, caught = self._old(edge), symbol(_side(edge))
            guessed = self.difference(edge, self._guessed) + self.offset(edge)
            guessed = guessed + self.way(edge, ways) + STEP * self.way(edge, jumps)
            up = (maximum(old, guessed) > compression) & np.logical_not(caught > 0.5)
            down = (minimum(old, guessed) < rebound) & np.logical_not(caught < -0.5)
            found.append(where(up, 1.0, where(down, -1.0, 0.0)))
        return found

    def _sides(self, closing: Sequence[Node]) -> list[Node]:
        """The sides on which stops hold: those that are closing, or have caught something before."""
        pairs = zip(self.stops, closing, strict=True)
        return [where(side == 0.0, symbol(_side(edge)), side) for (edge, _), side in pairs]

    def _beyond(self, edge: Edge, ends: tuple[Node, Node], ways: Mapping[str, Node]) -> Node:
        """On which side a stop is closed after some ways of the nodes; 0.0 where it is open."""
        place = self.motion(edge)["edge.new"] + self.way(edge, ways)
        return where(place > ends[1], 1.0, where(place < ends[0], -1.0, 0.0))

    def _guessed(self, joint: str) -> Node:
        own = self.guess(joint) if joint in self.unknown else ZERO
        return self._given(joint, "new") + own

    def _old(self, edge: Edge) -> Node:
        return self.difference(edge, lambda joint: self.before(joint, "old", "position")) + self.offset(edge)

    def _speed(self, edge: Edge) -> Node:
        return self.difference(edge, lambda joint: self.before(joint, "velocity_old", "velocity"))

    def _bend(self, edge: Edge) -> Node:
        return self.difference(edge, self._acceleration)

    def _acceleration(self, joint: str) -> Node:
        """That of a node at the begin of the step, if nothing catches it; of a driven one, in the step."""
        new, old = (self._given(joint, key) for key in ("velocity_new", "velocity_old"))
        own = symbol(row_of(joint, "acceleration")) if joint in self.unknown else ZERO
        return own + (new - old) / STEP

    def _given(self, joint: str, key: str) -> Node:
        """The part of the motion of a node that the drive gives."""
        known = self.known(joint, key)
        return self.carrier(joint, key) if known is None else known

    @staticmethod
    def _until(distance: Node, speed: Node) -> Node:
        """The time until a stop is reached, at most that of the step."""
        return minimum(STEP, maximum(distance, 0.0) / maximum(speed, SLOWEST))

    def _impact(self, closing: Sequence[Node]) -> tuple[dict[str, Node], dict[str, Node]]:
        """How far the impacts move the masses to the stops, and by how much they change their velocities."""
        edges, sides = [edge for edge, _ in self.stops], self._sides(closing)
        beyond, speeds = [], []
        for (edge, (rebound, compression)), side in zip(self.stops, sides, strict=True):
            way, speed = self._old(edge) - where(side > 0.0, compression, rebound), self._speed(edge)
            until, back = self._until(-side * way, side * speed), side * minimum(side * self._bend(edge), 0.0)
            beyond.append(way - 0.5 * until * until * back)
            speeds.append(speed + until * back)
        held = [where(side == 0.0, 0.0, 1.0) for side in closing]
        if len(edges) > 1:
            first = self._allowed(held, speeds)
            pressed = [
                (side != 0.0) & (side * (speed + self.way(edge, first)) >= 0.0)
                for edge, side, speed in zip(edges, sides, speeds, strict=True)
            ]
            held = [maximum(own, where(pressing, 1.0, 0.0)) for own, pressing in zip(held, pressed, strict=True)]
        return self._allowed(held, beyond), self._allowed(held, speeds)

    def _allowed(self, held: Sequence[Node], beyond: Sequence[Node]) -> dict[str, Node]:
        """The least changes, weighed by the masses, that bring what is ``beyond`` at the ``held`` stops to zero."""
        rows = {joint: {joint: SLOPE * SLOPE * self.mass(joint)} for joint in self.free}
        sides = dict.fromkeys(self.free, ZERO)
        whole = sum((self.mass(joint) for joint in self.free), ZERO)
        for edge, law in zip(self.topology.edges, self.laws, strict=True):
            join(rows, edge, SLOPE * SLOPE * self.along(edge, derive(law.force, "edge.acceleration")))
        for (edge, _), own, gap in zip(self.stops, held, beyond, strict=True):
            rigidity = RIGIDITY * SLOPE * SLOPE * whole * own
            join(rows, edge, rigidity)
            for joint, sign in ((edge.lower, -1.0), (edge.upper, 1.0)):
                if joint in sides:
                    sides[joint] = sides[joint] + sign * rigidity * gap
        return solve_symmetric(rows, sides)


def _side(edge: Edge) -> str:
    """The row of the side on which a stop has caught a mass."""
    return f"stop:{edge.branch.name}|side"
