"""Algorithmic tangents: the derivative of a node after a symbol, as a graph again."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from dashpot.expr.node import LOGICAL, Node, apply, as_node, constant, table, walk

ZERO = constant(0.0)
STEPWISE = LOGICAL | {"sign"}


def derive(root: Node, name: str) -> Node:
    """The derivative of ``root`` after the symbol ``name``, at a kink of absolute, minimum or maximum to the right.

    ``where`` keeps its condition: each of its choices is derived by itself.
    """
    slopes: dict[int, Node] = {}
    for node in walk([root]):
        slopes[node.serial] = _slope(node, slopes, name)
    return slopes[root.serial]


def _slope(node: Node, slopes: dict[int, Node], name: str) -> Node:
    if node.operation == "symbol":
        return constant(1.0) if node.payload == name else ZERO
    inner = [slopes[argument.serial] for argument in node.arguments]
    if node.operation in STEPWISE or all(slope is ZERO for slope in inner):
        return ZERO
    if node.operation == "where":
        return apply("where", node.arguments[0], inner[1], inner[2])
    if node.operation == "table":
        curve, order = node.payload
        return table(curve, node.arguments[0], order + 1) * inner[0]
    if node.operation == "absolute":
        return _nearer(node.arguments[0], ZERO, -inner[0], inner[0], apply("absolute", inner[0]))
    if node.operation in ("minimum", "maximum"):
        (first, second), (below, above) = node.arguments, inner if node.operation == "minimum" else inner[::-1]
        return _nearer(first, second, below, above, apply(node.operation, *inner))
    return _chained(node, inner)


def _nearer(first: Node, second: Node, below: Node, above: Node, equal: Node) -> Node:
    """One of three slopes, as ``first`` is below, above or equal to ``second``; for NaN the last one."""
    kink = apply("where", apply("greater", first, second), above, equal)
    return apply("where", apply("less", first, second), below, kink)


def _chained(node: Node, inner: list[Node]) -> Node:
    total = ZERO
    for partial, slope in zip(_PARTIALS[node.operation], inner, strict=True):
        if slope is not ZERO:
            total = total + as_node(partial(node, *node.arguments)) * slope
    return total


# operation -> the partial derivative after each argument, from the node itself and its arguments
_PARTIALS: dict[str, tuple[Callable[..., Node | float], ...]] = {
    "add": (lambda f, a, b: 1.0, lambda f, a, b: 1.0),
    "subtract": (lambda f, a, b: 1.0, lambda f, a, b: -1.0),
    "multiply": (lambda f, a, b: b, lambda f, a, b: a),
    "divide": (lambda f, a, b: 1.0 / b, lambda f, a, b: -f / b),
    "power": (lambda f, a, b: b * a ** (b - 1.0), lambda f, a, b: f * np.log(a)),
    "negative": (lambda f, a: -1.0,),
    "sqrt": (lambda f, a: 0.5 / f,),
    "exp": (lambda f, a: f,),
    "expm1": (lambda f, a: f + 1.0,),
    "log": (lambda f, a: 1.0 / a,),
    "log1p": (lambda f, a: 1.0 / (1.0 + a),),
    "tanh": (lambda f, a: 1.0 - f * f,),
    "sin": (lambda f, a: np.cos(a),),
    "cos": (lambda f, a: -np.sin(a),),
    "wrightomega": (lambda f, a: f / (1.0 + f),),
}
