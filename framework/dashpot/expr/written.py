"""Graphs as text, to be kept in files.

A text is JSON: every node once, arguments first, then what stands for the graphs, with numbers of nodes in their
places. What is read is made of the same nodes as what was written.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from dashpot.expr.node import Node, interned, walk


def write_graphs(graphs: Any) -> str:
    """The text of nodes, in tuples and in mappings of names, nested as they may be."""
    nodes = walk(_nodes(graphs))
    numbers = {node.serial: number for number, node in enumerate(nodes)}
    table = [[node.operation, node.payload, [numbers[inner.serial] for inner in node.arguments]] for node in nodes]
    return json.dumps({"nodes": table, "graphs": _numbered(graphs, numbers)}, separators=(",", ":"))


def read_graphs(text: str) -> Any:
    """What was written."""
    content = json.loads(text)
    nodes: list[Node] = []
    for operation, payload, arguments in content["nodes"]:
        known = tuple(payload) if isinstance(payload, list) else payload
        nodes.append(interned(operation, tuple(nodes[number] for number in arguments), known))
    return _filled(content["graphs"], nodes)


def _nodes(graphs: Any) -> Iterator[Node]:
    if isinstance(graphs, Node):
        yield graphs
    else:
        for inner in graphs.values() if isinstance(graphs, dict) else graphs:
            yield from _nodes(inner)


def _numbered(graphs: Any, numbers: dict[int, int]) -> Any:
    if isinstance(graphs, Node):
        return numbers[graphs.serial]
    if isinstance(graphs, dict):
        return {name: _numbered(inner, numbers) for name, inner in graphs.items()}
    return [_numbered(inner, numbers) for inner in graphs]


def _filled(graphs: Any, nodes: list[Node]) -> Any:
    if isinstance(graphs, int):
        return nodes[graphs]
    if isinstance(graphs, dict):
        return {name: _filled(inner, nodes) for name, inner in graphs.items()}
    return tuple(_filled(inner, nodes) for inner in graphs)
