"""Running a graph in plain numpy: the reference, and the evaluator of everything outside the inner loop."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from dashpot.expr.node import Node, compute, walk

Tables = Mapping[str, Callable[[Any, int], Any]]


def interpret(roots: Sequence[Node], values: Mapping[str, Any], tables: Tables | None = None,
              nodes: Sequence[Node] | None = None) -> list[Any]:  # fmt: skip
    """The values of the roots for the given symbols; arrays broadcast as in numpy.

    ``tables`` maps the name of a curve to a function of (argument, derivative order). ``nodes`` is ``walk(roots)``,
    for who interprets the same roots again and again. Raises KeyError for a symbol or curve without a value.
    """
    results: dict[int, Any] = {}
    with np.errstate(all="ignore"):
        for node in walk(roots) if nodes is None else nodes:
            results[node.serial] = _evaluate(node, results, values, tables or {})
    return [results[root.serial] for root in roots]


def _evaluate(node: Node, results: dict[int, Any], values: Mapping[str, Any], tables: Tables) -> Any:
    if node.operation == "constant":
        return node.payload
    if node.operation == "symbol":
        return values[node.payload]
    arguments = [results[argument.serial] for argument in node.arguments]
    if node.operation == "table":
        curve, order = node.payload
        return tables[curve](arguments[0], order)
    return compute(node.operation)(*arguments)
