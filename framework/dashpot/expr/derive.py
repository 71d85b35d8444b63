"""Algorithmic tangents: the derivative of a node after a symbol, as a graph again."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from dashpot.expr.node import Node, apply, as_node, constant, table, walk

ZERO = constant(0.0)


def derive(root: Node, name: str) -> Node:
    """d root / d symbol ``name``; piecewise laws are derived piece by piece (``where`` keeps its condition)."""
    slopes: dict[int, Node] = {}
    for node in walk([root]):
        slopes[node.serial] = _slope(node, slopes, name)
    return slopes[root.serial]


def _slope(node: Node, slopes: dict[int, Node], name: str) -> Node:
    if node.operation == "symbol":
        return constant(1.0) if node.payload == name else ZERO
    inner = [slopes[argument.serial] for argument in node.arguments]
    if node.operation == "where":
        return apply("where", node.arguments[0], inner[1], inner[2])
    if all(slope is ZERO for slope in inner):
        return ZERO
    if node.operation == "table":
        curve, order = node.payload
        return table(curve, node.arguments[0], order + 1) * inner[0]
    if node.operation in ("minimum", "maximum"):
        return _chosen(node, inner)
    partials = _PARTIALS[node.operation](node, *node.arguments)
    terms = [_product(partial, slope) for partial, slope in zip(partials, inner, strict=True) if slope is not ZERO]
    total = terms[0]
    for term in terms[1:]:
        total = total + term
    return total


def _product(partial: Node | float, slope: Node) -> Node:
    return apply("multiply", as_node(partial), slope)


def _chosen(node: Node, inner: list[Node]) -> Node:
    first, second = node.arguments
    compare = "less" if node.operation == "minimum" else "greater"
    return apply("where", apply(compare, first, second), *inner)


# operation -> partial derivatives after each argument, given the node itself and its arguments
_PARTIALS: dict[str, Callable[..., tuple[Node | float, ...]]] = {
    "add": lambda f, a, b: (1.0, 1.0),
    "subtract": lambda f, a, b: (1.0, -1.0),
    "multiply": lambda f, a, b: (b, a),
    "divide": lambda f, a, b: (1.0 / b, -f / b),
    "negative": lambda f, a: (-1.0,),
    "absolute": lambda f, a: (np.sign(a),),
    "sign": lambda f, a: (0.0,),
    "sqrt": lambda f, a: (0.5 / f,),
    "exp": lambda f, a: (f,),
    "expm1": lambda f, a: (f + 1.0,),
    "log": lambda f, a: (1.0 / a,),
    "log1p": lambda f, a: (1.0 / (1.0 + a),),
    "tanh": lambda f, a: (1.0 - f * f,),
    "sin": lambda f, a: (np.cos(a),),
    "cos": lambda f, a: (-np.sin(a),),
    "power": lambda f, a, b: (b * a ** (b - 1.0), f * np.log(a)),
    "wrightomega": lambda f, a: (f / (1.0 + f),),
}
