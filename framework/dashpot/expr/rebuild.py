"""Rebuilding a graph with some of its nodes replaced."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from dashpot.expr.node import Node, walk, with_arguments


def rebuild(roots: Sequence[Node], change: Callable[[Node], Node]) -> list[Node]:
    """The roots with every node, once its arguments are rebuilt, passed through ``change``."""
    done: dict[int, Node] = {}
    for node in walk(roots):
        done[node.serial] = change(with_arguments(node, [done[argument.serial] for argument in node.arguments]))
    return [done[root.serial] for root in roots]


def replaced(root: Node, symbols: Mapping[str, Node]) -> Node:
    """The root with other nodes in the places of some symbols."""
    return rebuild([root], lambda node: symbols.get(node.payload, node) if node.operation == "symbol" else node)[0]
