"""The order of a pass: long functions side by side, and beside them whatever does not need them.

The chain of operations of a long function such as the exponential leaves most of the processor idle; several of them
together fill it. So a pass is a chain of stages: what is needed for arguments, then long functions, each kind at once.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from dashpot.expr.node import Node

LONG = frozenset({"exp", "expm1", "log", "log1p", "power", "tanh", "wrightomega"})


@dataclass(frozen=True)
class Stage:
    """``nodes``, arguments first, then the long functions ``calls``, and ``beside`` them what does not need them."""

    nodes: tuple[Node, ...]
    calls: tuple[Node, ...]
    beside: tuple[Node, ...]


def cut_stages(nodes: Sequence[Node]) -> tuple[Stage, ...]:
    """The stages that compute ``nodes``, given arguments first, each once and as late as its users allow."""
    depth = _depths(nodes)
    last = max(depth.values(), default=0)
    at = _latest(nodes, depth, last)
    short = [node for node in nodes if node.operation not in LONG]
    return tuple(
        Stage(
            tuple(node for node in short if at[node.serial] == number == depth[node.serial]),
            tuple(node for node in nodes if node.operation in LONG and depth[node.serial] == number + 1),
            tuple(node for node in short if at[node.serial] == number + 1 > depth[node.serial]),
        )
        for number in range(last + 1)
    )


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
