"""Running a graph in plain numpy: the reference, and the evaluator of everything outside the inner loop."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from dashpot.expr.node import Node, compute, walk

Tables = Mapping[str, Callable[[Any, int], Any]]

_recipes: dict[tuple[int, ...], Recipe] = {}


def interpret(roots: Sequence[Node], values: Mapping[str, Any], tables: Tables | None = None) -> list[Any]:
    """The values of the roots for the given symbols; arrays broadcast as in numpy.

    ``tables`` maps the name of a curve to a function of (argument, derivative order). Raises KeyError for a symbol or
    curve without a value.
    """
    marks = tuple(root.serial for root in roots)
    if marks not in _recipes:
        _recipes[marks] = Recipe(roots)
    return _recipes[marks](values, tables)


class Recipe:
    """The order in which to compute roots, for who interprets the same ones again and again; see ``interpret``."""

    def __init__(self, roots: Sequence[Node]) -> None:
        nodes = walk(roots)
        place = {node.serial: number for number, node in enumerate(nodes)}
        self._roots = [place[root.serial] for root in roots]
        self._begin = [node.payload if node.operation == "constant" else None for node in nodes]
        self._symbols = [(place[node.serial], node.payload) for node in nodes if node.operation == "symbol"]
        self._steps = [
            (place[node.serial], _function(node), [place[argument.serial] for argument in node.arguments])
            for node in nodes
            if node.arguments
        ]

    def __call__(self, values: Mapping[str, Any], tables: Tables | None = None) -> list[Any]:
        """The values of the roots."""
        found = self._begin.copy()
        for place, name in self._symbols:
            found[place] = values[name]
        with np.errstate(all="ignore"):
            for place, function, arguments in self._steps:
                given = [found[argument] for argument in arguments]
                if callable(function):
                    found[place] = function(*given)
                else:
                    curve, order = function
                    found[place] = (tables or {})[curve](given[0], order)
        return [found[place] for place in self._roots]


def _function(node: Node) -> Callable[..., Any] | tuple[str, int]:
    # a curve is known by name only, with the order of its derivative
    return node.payload if node.operation == "table" else compute(node.operation)
