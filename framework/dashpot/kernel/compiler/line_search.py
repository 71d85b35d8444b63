"""Newton's method with a line search, as a graph: for steps in which the forces bend sharply, as of stiff dry friction.

The forces of a step are the slope of a potential of the new positions, which is convex where no force falls. Newton's
way, by tangents that are nowhere negative, leads downhill; along it the pull, the slope of the potential, falls from
its first value through zero, and Newton's method in one variable between two bounds finds a place where little of it
is left. There the next line begins. So every line comes down, however sharp the bend; with a single unknown it is the
bracketed Newton method. Source: Nocedal and Wright, Numerical Optimization, 2006, chapter 3.

The search ends where the next step of Newton's method is short, or where the forces balance to rounding: where nothing
holds a node, as in a clearance, such a step has any length. Where a stiff force bends, the place of balance may lie
between two neighbouring numbers: either is right.

Every pass evaluates the forces once, at a share of the line: it either goes on along it or begins a new one. The first
pass of a step goes back to the first guess.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import reduce

import numpy as np

from dashpot.expr.node import Node, constant, maximum, minimum, symbol, where
from dashpot.kernel.compiler.elimination import ZERO
from dashpot.kernel.compiler.mechanics import (
    DONE,
    FARTHEST,
    LINES,
    NEVER,
    TOLERANCE,
    Balance,
    row_of,
)

LEFT = 0.1  # share of the first pull that may be left where the next line begins
FARTHER = 4.0  # times the share, where the pull has not turned yet
LONGEST = 1e6  # times the farthest way: where the pull has not turned there, nothing holds a node
FINEST = 1e-15  # of a share: closer bounds are one number; of the tolerance: a line that short is none
STIFFEST = 1e-18  # m/N, of a fixture that does not give way
SOFTEST = 1e-300  # of a way that has not begun: no target divides by zero
ROUNDING = 1e-14  # of the forces at a node, and of what its stiffnesses make of its place
LAST_DIGIT, BALANCED = 1e-15, 1e-9  # of the places; of the forces at a node, where no digit is left to balance them by
SHARE, BELOW, BEYOND, PULL = (f"line|{key}" for key in ("share", "below", "beyond", "pull"))


def search(balance: Balance) -> dict[str, Node]:
    """The rows of the pass ``search``; a lane that is done stays as it is."""
    unknown, missing = balance.unknown, balance.missing()
    if not unknown:
        return {DONE: constant(1.0)}
    done, fresh = symbol(DONE) > 0.5, symbol(LINES) < 0.5
    along = {joint: symbol(row_of(joint, "way")) for joint in unknown}
    pull = _pull(balance, missing, along)
    length = _longest(along)
    share, below, beyond, ended = _next_share(pull, _stiffness(balance, along), length)
    # where a force bends, the places of two sides are neighbours
    places = _longest({joint: symbol(row_of(joint, "next")) for joint in unknown})
    exact = ended & (beyond * length <= LAST_DIGIT * places)
    balanced = _balanced(balance, missing, where(exact, BALANCED, ROUNDING))
    newton = balance.newton(missing, [maximum(tangent, 0.0) for tangent in balance.tangents], FARTHEST)
    ways, ended = {joint: where(balanced, 0.0, way) for joint, way in newton.items()}, ended | balanced
    distance = _longest(ways)
    # as in Newton's steps alone, what is not a number is not far
    near = ended & np.logical_not(distance > TOLERANCE)
    first = minimum(1.0, FARTHEST / maximum(distance, FARTHEST))
    rows = {
        LINES: symbol(LINES) + 1.0,
        SHARE: where(ended, where(near, 1.0, first), share),
        BELOW: where(ended, 0.0, below),
        BEYOND: where(ended, NEVER, beyond),
        PULL: where(ended, _pull(balance, missing, ways), symbol(PULL)),
    }
    moved: dict[str, Node] = {}
    for joint in unknown:
        here, base = symbol(row_of(joint, "next")), symbol(row_of(joint, "base"))
        begin, way = where(ended, here, base), where(ended, ways[joint], along[joint])
        guess = balance.guess(joint)
        moved[row_of(joint, "base")] = where(fresh, guess, begin)
        moved[row_of(joint, "way")] = where(fresh, 0.0, way)
        moved[row_of(joint, "next")] = where(fresh, guess, begin + rows[SHARE] * way)
    begun: dict[str, Node | float] = {LINES: 1.0, SHARE: 0.0, BELOW: 0.0, BEYOND: NEVER, PULL: 0.0}
    rows = moved | {name: where(fresh, begun[name], row) for name, row in rows.items()}
    rows[DONE] = where(near & np.logical_not(fresh), 1.0, 0.0)
    kept = {name: where(done, symbol(name), row) for name, row in rows.items()}
    return kept | balance.reached(ways)


def _longest(ways: Mapping[str, Node]) -> Node:
    return reduce(maximum, (np.absolute(way) for way in ways.values()), ZERO)


def _next_share(pull: Node, stiffness: Node, length: Node) -> tuple[Node, Node, Node, Node]:
    """The next share of the line to look at, the bounds of where the pull ends, and whether the line has ended.

    A line may be far longer than the place that is looked for, as where nothing but rounding holds a node: its share is
    found to all digits. Where the bounds are one number the forces bend there: it ends on the far side, where they are
    stiff, so that the next line does not run into the same bend.
    """
    share, pulling = symbol(SHARE), pull > 0.0
    below, beyond = where(pulling, share, symbol(BELOW)), where(pulling, symbol(BEYOND), share)
    # where the bounds came together by less than half, Newton's method is slow
    slow = beyond - below > 0.5 * (symbol(BEYOND) - symbol(BELOW))
    newton = share + pull / maximum(stiffness, SOFTEST)
    farther = minimum(FARTHER * share, LONGEST * FARTHEST / maximum(length, SOFTEST))
    within = (newton > below) & (newton < beyond) & np.logical_not(slow)
    between = where(within, newton, 0.5 * (below + beyond))
    one = (beyond - below < FINEST * beyond) | (beyond * length < FINEST * TOLERANCE)
    ended = (pull >= 0.0) & (pull <= LEFT * symbol(PULL)) | one & np.logical_not(pulling)
    ahead = where((newton > share) & (newton < farther), newton, farther)
    return where(one, beyond, where(beyond < NEVER, between, ahead)), below, beyond, ended


def _balanced(balance: Balance, missing: Mapping[str, Node], share: Node) -> Node:
    """Whether no node lacks more than a share of its forces, or than the rounding of its place makes of them."""
    forces = {joint: _inertia(balance, joint) for joint in missing}
    rounded = dict(forces)
    for edge, force, tangent in zip(balance.topology.edges, balance.forces, balance.tangents, strict=True):
        places = np.absolute(balance.position(edge.lower)) + np.absolute(balance.position(edge.upper))
        for joint in (each for each in (edge.lower, edge.upper) if each in forces):
            forces[joint] = forces[joint] + np.absolute(force)
            rounded[joint] = rounded[joint] + np.absolute(force) + np.absolute(tangent) * places
    lacks = [
        np.absolute(force) <= maximum(share * forces[joint], ROUNDING * rounded[joint])
        for joint, force in missing.items()
    ]
    return reduce(lambda one, other: one & other, lacks)


def _inertia(balance: Balance, joint: str) -> Node:
    """The force that moves the mass of a node, and what a step makes of its place."""
    acceleration, bend = balance.inertia(joint)
    return balance.mass(joint) * (np.absolute(acceleration) + bend * np.absolute(balance.position(joint)))


def _pull(balance: Balance, missing: Mapping[str, Node], ways: Mapping[str, Node]) -> Node:
    """The force along the ways."""
    total = sum([missing[joint] * way for joint, way in ways.items()], ZERO)
    strains = [symbol(row_of(joint, "next")) / _give(balance, joint) * ways[joint] for joint in balance.mounted]
    return total - sum(strains, ZERO)


def _stiffness(balance: Balance, ways: Mapping[str, Node]) -> Node:
    """How fast the pull falls with the share."""
    total = sum([ways[joint] * ways[joint] / _give(balance, joint) for joint in balance.mounted], ZERO)
    for edge, tangent in zip(balance.topology.edges, balance.tangents, strict=True):
        way = balance.way(edge, ways)
        total = total + tangent * way * way
    for joint, way in ways.items():
        mass = balance.mass(joint)
        if mass is not ZERO:
            total = total + mass * balance.inertia(joint)[1] * way * way
    return total


def _give(balance: Balance, joint: str) -> Node:
    return maximum(balance.mount(joint).compliance, STIFFEST)
