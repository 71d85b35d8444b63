"""Rebuilding a graph with some of its nodes replaced."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from dashpot.expr.node import Node, apply, table, walk


def rebuild(roots: Sequence[Node], change: Callable[[Node], Node]) -> list[Node]:
    """The roots with every node, once its arguments are rebuilt, passed through ``change``."""
    done: dict[int, Node] = {}
    for node in walk(roots):
        done[node.serial] = change(_with_arguments(node, [done[argument.serial] for argument in node.arguments]))
    return [done[root.serial] for root in roots]


def _with_arguments(node: Node, arguments: Sequence[Node]) -> Node:
    if node.operation == "table":
        return table(node.payload[0], arguments[0], node.payload[1])
    return apply(node.operation, *arguments) if arguments else node
