"""Cutting a pass over the lanes into loops.

A long function such as the exponential runs best in a loop of its own, where its coefficients stay in registers. So a
pass is a chain of stages: a loop over lanes that computes arguments, then long functions on whole rows of lanes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from dashpot.expr.node import Node

LONG = frozenset({"exp", "log", "wrightomega", "lookup"})


@dataclass(frozen=True)
class Stage:
    """A loop that computes ``nodes`` from what it ``reads``, and the long functions called after it."""

    reads: tuple[Node, ...]
    nodes: tuple[Node, ...]
    calls: tuple[Node, ...]


def cut_stages(nodes: Sequence[Node], roots: Sequence[Node]) -> tuple[Stage, ...]:
    """The stages that compute ``nodes``, given arguments first, each once and as late as its users allow.

    The last stage reads whatever ``roots`` it does not compute.
    """
    depth = _depths(nodes)
    last = max(depth.values(), default=0)
    at = _latest(nodes, depth, last)
    stages = []
    for number in range(last + 1):
        own = tuple(node for node in nodes if node.operation not in LONG and at[node.serial] == number)
        calls = tuple(node for node in nodes if node.operation in LONG and depth[node.serial] == number + 1)
        stages.append(Stage(_reads(own, roots if number == last else ()), own, calls))
    return tuple(stages)


def kept_nodes(stages: Sequence[Stage]) -> dict[int, Node]:
    """By serial, what must outlive the stage that computes it."""
    computed = {node.serial for stage in stages for node in stage.nodes}
    kept = {node.serial: node for stage in stages for node in stage.calls}
    for stage in stages:
        wanted = [*stage.reads, *(argument for call in stage.calls for argument in call.arguments)]
        kept |= {node.serial: node for node in wanted if node.serial in computed}
    return kept


def moments(stages: Sequence[Stage]) -> tuple[Mapping[int, int], Mapping[int, int]]:
    """When every node is made and when it is read for the last time, by serial.

    Stage n reads at moment 3 n, writes at 3 n + 1 and calls its long functions at 3 n + 2.
    """
    made: dict[int, int] = {}
    read: dict[int, int] = {}
    for number, stage in enumerate(stages):
        made |= {node.serial: 3 * number + 1 for node in stage.nodes}
        made |= {node.serial: 3 * number + 2 for node in stage.calls}
        read |= {node.serial: 3 * number for node in stage.reads}
        read |= {argument.serial: 3 * number + 2 for call in stage.calls for argument in call.arguments}
    return made, read


def _reads(own: Sequence[Node], roots: Sequence[Node]) -> tuple[Node, ...]:
    computed = {node.serial for node in own}
    wanted = [argument for node in own if node.operation != "table" for argument in node.arguments]
    return tuple({node.serial: node for node in (*wanted, *roots) if node.serial not in computed}.values())


def _depths(nodes: Sequence[Node]) -> dict[int, int]:
    # how many long functions, one inside the other, a node holds
    depth: dict[int, int] = {}
    for node in nodes:
        inside = max((depth.get(argument.serial, 0) for argument in node.arguments), default=0)
        depth[node.serial] = inside + (node.operation in LONG)
    return depth


def _latest(nodes: Sequence[Node], depth: Mapping[int, int], last: int) -> dict[int, int]:
    at = dict.fromkeys(depth, last)
    for node in reversed(nodes):
        user = depth[node.serial] - 1 if node.operation in LONG else at[node.serial]
        for argument in node.arguments:
            if argument.serial in at:
                at[argument.serial] = min(at[argument.serial], user)
    return at
