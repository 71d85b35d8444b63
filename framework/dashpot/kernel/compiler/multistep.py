"""A step of a network whose unknown nodes all have masses: the rule of Adams and Moulton, where the numbers allow it.

Where nothing is quick for the step, the column ``rule.adams`` asks for a rule of fourth order: the new acceleration and
the three before it give velocity and position, as integrals of the cubic through them (Hairer, Norsett, Wanner, Solving
Ordinary Differential Equations I, 1993, chapter III.1 and III.10). Where it is 0, the step is that of ``Moving``.

The tangents of the laws hardly matter then, and are renewed now and then, in the pass ``improve``; the pass ``correct``
is Newton's step with those of before.

Between the ends of a step the nodes follow cubics. Laws without rates move to the point where their edge turns on that
of the first guess, in the pass ``turn``, and from there to the end.
"""

from __future__ import annotations

from functools import reduce

import numpy as np

from dashpot.expr.derive import derive
from dashpot.expr.node import Node, constant, maximum, symbol, where
from dashpot.expr.rebuild import replaced
from dashpot.kernel.compiler.elimination import ZERO
from dashpot.kernel.compiler.mechanics import DISTANCE, DONE, SLOPE, STEP, TOLERANCE, Moving, reached_row, row_of
from dashpot.kernel.compiler.trace import TracedBranch, rate_independent
from dashpot.kernel.scheme import FASTEST, FIRMEST, PLACE, PLACE_AHEAD, SPEED
from dashpot.model.topology import Edge, Topology

ADAMS, PULL, RENEWED = (symbol(f"rule.{key}") for key in ("adams", "pull", "renewed"))
QUICK_RULE = ("rule.adams", "rule.pull", "rule.renewed")
PACE, TURNS, KEPT_TANGENTS = "adams|pace", "adams|turns", "adams|kept"
EARLIER = ("acceleration", "acceleration_before", "acceleration_earlier")  # of a node, the latest first


def multistep_fits(topology: Topology) -> bool:
    """Whether every unknown node has a mass and none stands on a fixture."""
    joints = [topology.joints[name] for name in topology.unknown]
    return bool(joints) and all(joint.masses and joint.mounted is None for joint in joints)


class Multistep(Moving):
    """One step by either rule."""

    pull = PULL

    def __init__(self, topology: Topology, laws: list[TracedBranch]) -> None:
        self.turning = {law.name for law in laws if law.states and rate_independent(law)}
        super().__init__(topology, laws)

    def along(self, edge: Edge, law: Node) -> Node:
        since = {"edge.old": symbol(_since(edge)) + self.offset(edge)} if edge.branch.name in self.turning else {}
        return replaced(law, {**self.motion(edge), **since})

    def predict(self) -> dict[str, Node]:
        rows = super().predict()
        for joint in self.unknown:
            drift, swing = (rows[row_of(joint, key)] for key in ("drift", "swing"))
            far, fast = self._reached(joint, PLACE[1:]), self._fast(joint)
            rows[row_of(joint, "drift")] = where(ADAMS > 0.5, fast - SLOPE * far, drift)
            rows[row_of(joint, "swing")] = where(ADAMS > 0.5, -(PULL * fast), swing)
        rows[KEPT_TANGENTS] = where(RENEWED > 0.5, 0.0, 1.0)
        turns = [where(self._turned(edge), 1.0, 0.0) for edge in self._ends().values()]
        rows |= {_since(edge): self._old(edge) for edge in self._ends().values()}
        return rows | {TURNS: where(ADAMS > 0.5, reduce(maximum, turns, ZERO), 0.0)}

    def guess(self, joint: str) -> Node:
        return where(ADAMS > 0.5, self._reached(joint, PLACE_AHEAD), super().guess(joint))

    def turn(self) -> dict[str, Node]:
        """The laws without rates at the point where their edge turns."""
        rows: dict[str, Node] = {}
        for edge, law in zip(self.topology.edges, self.laws, strict=True):
            if law.name in self.turning:
                turned, place = self._turned(edge), self._turning_point(edge)
                to = {"edge.old": self._old(edge) + self.offset(edge), "edge.new": place + self.offset(edge)}
                rows[_since(edge)] = where(turned, place, self._old(edge))
                rows |= {name: where(turned, replaced(node, to), symbol(name)) for name, node in law.states.items()}
        return rows

    def improve(self) -> dict[str, Node]:
        """The tangents are kept; a lane that is done stays as it is."""
        kept = {**self._summed(), PACE: where(ADAMS > 0.5, maximum(symbol(PACE), self._pace()), symbol(PACE))}
        done = symbol(DONE) > 0.5
        return super().improve() | {name: where(done, symbol(name), node) for name, node in kept.items()}

    def correct(self) -> dict[str, Node]:
        """Newton's step with the tangents that are kept, and what is measured where it leads to."""
        kept = self._kept_tangents()
        ways = self.newton(self.missing(), kept)
        distance = reduce(maximum, (np.absolute(way) for way in ways.values()), ZERO)
        forces = [
            force + tangent * self.way(edge, ways)
            for edge, force, tangent in zip(self.topology.edges, self.forces, kept, strict=True)
        ]
        found = self.outputs(forces)
        for edge, law in zip(self.topology.edges, self.laws, strict=True):
            found |= {name: self.along(edge, node) for name, node in law.states.items()}
        rows = {row_of(joint, "next"): self._next(joint) + way for joint, way in ways.items()}
        rows |= {reached_row(name): node for name, node in found.items()}
        rows |= {DISTANCE: distance, DONE: where(distance <= TOLERANCE, 1.0, 0.0)}
        done = symbol(DONE) > 0.5
        return {name: where(done, symbol(name), node) for name, node in rows.items()}

    def rest(self) -> dict[str, Node]:
        """Before the first step: no node is accelerated, and nothing was quick yet."""
        earlier = {row_of(joint, key): ZERO for joint in self.unknown for key in EARLIER[1:]}
        return {**earlier, PACE: ZERO}

    def commit(self) -> dict[str, Node]:
        rows = super().commit()
        for joint in self.unknown:
            for new, old in zip(EARLIER, EARLIER[1:], strict=False):
                rows[row_of(joint, old)] = symbol(row_of(joint, new))
        return rows

    def _summed(self) -> dict[str, Node]:
        """The tangents of all edges between the same two nodes, summed up."""
        rows: dict[str, Node] = {}
        for edge, tangent in zip(self.topology.edges, self.tangents, strict=True):
            rows[_kept(edge)] = rows.get(_kept(edge), ZERO) + tangent
        return rows

    def _kept_tangents(self) -> list[Node]:
        """One for every edge: the kept sum for the first one between its nodes, nothing for the others."""
        names = [_kept(edge) for edge in self.topology.edges]
        return [ZERO if name in names[:number] else symbol(name) for number, name in enumerate(names)]

    def _reached(self, joint: str, weights: tuple[float, ...]) -> Node:
        """Where a node gets to with the accelerations that it had."""
        x, v = symbol(row_of(joint, "position")), symbol(row_of(joint, "velocity"))
        return x + STEP * (v + STEP * self._weighed(joint, weights))

    def _fast(self, joint: str) -> Node:
        return symbol(row_of(joint, "velocity")) + STEP * self._weighed(joint, SPEED[1:])

    @staticmethod
    def _weighed(joint: str, weights: tuple[float, ...]) -> Node:
        terms = [weight * symbol(row_of(joint, key)) for weight, key in zip(weights, EARLIER, strict=True)]
        return sum(terms, ZERO)

    def _pace(self) -> Node:
        """How quick the quickest node is for the step, as a share of what the rule of Adams and Moulton allows."""
        shares = [ZERO]
        for joint in self.unknown:
            firm, fast = ZERO, ZERO
            for edge, law in zip(self.topology.edges, self.laws, strict=True):
                if joint in (edge.lower, edge.upper):
                    both = 2.0 if {edge.lower, edge.upper} <= set(self.unknown) else 1.0
                    firm = firm + both * np.absolute(self.along(edge, derive(law.force, "edge.new")))
                    fast = fast + both * np.absolute(self.along(edge, derive(law.force, "edge.velocity_new")))
            per_mass = STEP / self.mass(joint)
            shares.append(per_mass * (constant(1.0 / FIRMEST) * STEP * firm + constant(1.0 / FASTEST) * fast))
        return reduce(maximum, shares)

    def _ends(self) -> dict[str, Edge]:
        """An edge of a law without rates between every two nodes that have one."""
        return {_since(edge): edge for edge in self.topology.edges if edge.branch.name in self.turning}

    def _old(self, edge: Edge) -> Node:
        return self.difference(edge, lambda joint: self.before(joint, "old", "position"))

    def _speeds(self, edge: Edge) -> tuple[Node, Node]:
        before = self.difference(edge, lambda joint: self.before(joint, "velocity_old", "velocity"))
        return before, self.difference(edge, self._guessed_velocity)

    def _guessed_velocity(self, joint: str) -> Node:
        known = self.known(joint, "velocity_new")
        if known is not None:
            return known
        return self._fast(joint) + SLOPE * (self._guessed(joint) - self._reached(joint, PLACE[1:]))

    def _guessed(self, joint: str) -> Node:
        known = self.known(joint, "new")
        return self._reached(joint, PLACE_AHEAD) if known is None else known

    def _turned(self, edge: Edge) -> Node:
        before, after = self._speeds(edge)
        return before * after < 0.0

    def _turning_point(self, edge: Edge) -> Node:
        """Where the cubic turns whose velocity, a parabola, changes its sign once: the root between 0 and 1."""
        (before, after), old = self._speeds(edge), self._old(edge)
        c = 3.0 * (before + after) - 6.0 * (self.difference(edge, self._guessed) - old) / STEP
        b = after - before - c
        root = np.sqrt(maximum(b * b - 4.0 * before * c, 0.0))
        q = -0.5 * (b + where(b < 0.0, -root, root))
        first, second = before / q, q / c
        share = where((first > 0.0) & (first < 1.0), first, second)
        return old + STEP * share * (before + share * (0.5 * b + share * c / 3.0))


def _kept(edge: Edge) -> str:
    """The row of the tangents, summed up, of all edges between the same nodes."""
    return f"adams:{edge.lower}:{edge.upper}|tangent"


def _since(edge: Edge) -> str:
    """The row of the deflection, without its offset, from which laws without rates between the same nodes move on."""
    return f"adams:{edge.lower}:{edge.upper}|since"
