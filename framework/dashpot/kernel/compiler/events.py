"""What depends on the drive alone although it stands in a law with memory: followers and events.

A state whose law reads the drive only, such as the direction of the last step, follows the drive: it is known for the
whole record before any lane is computed. A choice ``np.where(condition, dear, state)`` whose condition is known in the
same way is an event: it corrects the state before the few steps that need it, so that all others are spared the work.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive
from dashpot.expr.interpret import interpret
from dashpot.expr.node import Node, constant, symbol, symbols_of, walk
from dashpot.expr.rebuild import rebuild
from dashpot.kernel.compiler.trace import RATES, STATE_MARK
from dashpot.kernel.ir.stages import LONG

Array = NDArray[np.float64]
Seen = Mapping[str, Array | float]

DRIVE_SYMBOLS = frozenset(f"{sight}.{key}" for sight in ("still", "path", "monotone") for key in ("old", "new", *RATES))
ZERO = constant(0.0)


def find_followers(laws: Mapping[str, Node]) -> dict[str, Node]:
    """The states, with their laws, that follow the drive."""
    return {name: law for name, law in laws.items() if is_drive(law, DRIVE_SYMBOLS)}


def is_drive(node: Node, known: Iterable[str]) -> bool:
    """Whether a node needs no more than the symbols of the drive, ``known``."""
    return symbols_of(node) <= {*known, "dt"} and all(inner.operation != "table" for inner in walk([node]))


def merge_followers(roots: Sequence[Node], followers: Mapping[str, Node]) -> list[Node]:
    """The roots with one symbol for all followers of the same law: they always have the same value."""
    first: dict[int, str] = {}
    names = {name: first.setdefault(law.serial, name) for name, law in followers.items()}

    def merged(node: Node) -> Node:
        return symbol(names[node.payload]) if node.operation == "symbol" and node.payload in names else node

    return rebuild(roots, merged)


@dataclass(frozen=True)
class Correction:
    """At an event, ``state`` gets the value ``then`` before the step."""

    state: str
    condition: Node
    then: Node


def split_events(roots: Sequence[Node], known: Iterable[str]) -> tuple[list[Node], list[Correction]]:
    """The roots without their events, and what these correct."""
    found = {}
    for node in walk(roots):
        correction = _event(node, known)
        if correction and correction.state not in _read_elsewhere(roots, node):
            found[node.serial] = correction
    spared = rebuild(roots, lambda node: symbol(found[node.serial].state) if node.serial in found else node)
    return spared, list(found.values())


def _event(node: Node, known: Iterable[str]) -> Correction | None:
    if node.operation != "where":
        return None
    condition, then, state = node.arguments
    dear = any(inner.operation in LONG for inner in walk([then]))
    own = state.operation == "symbol" and STATE_MARK in state.payload and state.payload not in known
    return Correction(state.payload, condition, then) if dear and own and is_drive(condition, known) else None


def _read_elsewhere(roots: Sequence[Node], event: Node) -> set[str]:
    return {name for root in rebuild(roots, lambda node: ZERO if node is event else node) for name in symbols_of(root)}


def follow(followers: Mapping[str, Node], drive: Drive, samples: Seen, turns: Seen) -> tuple[dict[str, Array], ...]:
    """What every follower was before each sample and before each turning point; at rest it is zero."""
    before_samples, before_turns = {}, {}
    for name, law in followers.items():
        at_samples = _values(law, samples, drive.samples)
        before = np.concatenate([[0.0], at_samples[:-1]])
        if symbols_of(law) <= set(turns):
            at_turns = _values(law, turns, drive.turn_step.size)
            before_turns[name] = after_the_one_before(drive.turn_step, at_samples, at_turns)
            before[drive.turn_step] = at_turns
        before_samples[name] = before
    return before_samples, before_turns


def after_the_one_before(turn_step: NDArray[np.int64], at_samples: Array, at_turns: Array) -> Array:
    """What holds when a turning point begins: the sample before it, or a turning point before it in the same step."""
    before = at_samples[turn_step - 1]
    second = np.flatnonzero(turn_step[1:] == turn_step[:-1]) + 1
    before[second] = at_turns[second - 1]
    return before


def _values(law: Node, seen: Seen, count: int) -> Array:
    return np.array(np.broadcast_to(interpret([law], seen)[0], (count,)), dtype=float)
