"""Tables that each lane looks up by itself, since the nodes of a network move differently in each."""

from __future__ import annotations

from collections.abc import Mapping

from dashpot.expr.node import Node, lookup, symbol, symbols_of
from dashpot.expr.rebuild import rebuild


def with_own_tables(rows: Mapping[str, Node], nothing: str) -> dict[str, Node]:
    """The rows with every table as one that each lane looks up by itself; ``nothing`` names a row of zeros."""

    def look_up(node: Node) -> Node:
        if node.operation != "table":
            return node
        argument = node.arguments[0]
        # an argument that is the same for all lanes has no row of its own yet
        moves = any("|" in name for name in symbols_of(argument))
        return lookup(node.payload[0], argument if moves else argument + symbol(nothing), node.payload[1])

    return dict(zip(rows, rebuild(list(rows.values()), look_up), strict=True))
