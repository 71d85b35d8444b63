"""Nodes of the scalar graph, and the operations they may carry.

Nodes are hash-consed: equal expressions are one object, so sharing is free and identity is equality. A node that meets
numpy records the call instead of computing: ``np.exp(node)`` is a new node.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Container, Iterable, Sequence
from typing import Any

import numpy as np

_interned: dict[tuple[Any, ...], Node] = {}
_applied: dict[tuple[Any, ...], Node] = {}
_serial = itertools.count()
_symbols: dict[int, frozenset[str]] = {}

# numpy's name of a ufunc -> our name; the two differ only where numpy has aliases
UFUNCS = {
    "add": "add",
    "subtract": "subtract",
    "multiply": "multiply",
    "divide": "divide",
    "true_divide": "divide",
    "negative": "negative",
    "absolute": "absolute",
    "fabs": "absolute",
    "sqrt": "sqrt",
    "exp": "exp",
    "expm1": "expm1",
    "log": "log",
    "log1p": "log1p",
    "tanh": "tanh",
    "sin": "sin",
    "cos": "cos",
    "minimum": "minimum",
    "maximum": "maximum",
    "power": "power",
    "sign": "sign",
    "less": "less",
    "less_equal": "less_equal",
    "greater": "greater",
    "greater_equal": "greater_equal",
    "equal": "equal",
    "not_equal": "not_equal",
    "logical_and": "logical_and",
    "logical_or": "logical_or",
    "bitwise_and": "logical_and",
    "bitwise_or": "logical_or",
    "logical_not": "logical_not",
    "invert": "logical_not",
    "wrightomega": "wrightomega",
}


# operations that answer true or false
LOGICAL = frozenset("less less_equal greater greater_equal equal not_equal logical_and logical_or logical_not".split())


class TraceError(TypeError):
    """A law used something that cannot be traced; the message says what to use instead."""


class Node(np.lib.mixins.NDArrayOperatorsMixin):
    """One operation of the graph: ``operation`` on ``arguments``, or a ``constant``, ``symbol`` or ``table``.

    ``payload`` is the value of a constant, the name of a symbol, or the curve of a table with the order of its
    derivative. ``serial`` identifies the node.
    """

    __slots__ = ("arguments", "operation", "payload", "serial")

    def __init__(self, operation: str, arguments: tuple[Node, ...], payload: Any) -> None:
        self.operation, self.arguments, self.payload = operation, arguments, payload
        self.serial = next(_serial)

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **kwargs: Any) -> Node:
        operation = UFUNCS.get(ufunc.__name__)
        if operation is None:
            raise TraceError(f"a law may not use numpy.{ufunc.__name__}; usable are {', '.join(sorted(UFUNCS))}")
        if method != "__call__" or kwargs:
            raise TraceError(
                f"a law may call numpy.{ufunc.__name__} with its arguments only; "
                "instead of changing a value in place (a += b) write a = a + b"
            )
        return apply(operation, *(as_node(value) for value in inputs))

    def __array_function__(self, function: Callable[..., Any], types: Any, args: Any, kwargs: Any) -> Node:
        if function is np.where and len(args) == 3:
            return apply("where", *(as_node(value) for value in args))
        if function is np.clip and len(args) == 3:
            return np.minimum(np.maximum(args[0], args[1]), args[2])
        raise TraceError(
            f"a law may not use numpy.{function.__name__}; traced are where, clip and the ufuncs "
            f"{', '.join(sorted(UFUNCS))}"
        )

    def __bool__(self) -> bool:
        raise TraceError("a law may not branch on a traced value; use np.where(condition, yes, no)")

    def __float__(self) -> float:
        raise TraceError("a law may not turn a traced value into a float; use numpy functions throughout")

    def __hash__(self) -> int:
        return self.serial

    def __repr__(self) -> str:
        if self.operation in ("constant", "symbol"):
            return str(self.payload)
        name = self.operation if self.payload is None else f"{self.operation}:{self.payload}"
        return f"{name}({', '.join(map(repr, self.arguments))})"


def constant(value: float | bool) -> Node:
    """The node of a number. NaN is refused: it would never compare equal to itself."""
    if isinstance(value, float) and math.isnan(value):
        raise TraceError("a law holds the constant NaN")
    plain = bool(value) if isinstance(value, (bool, np.bool_)) else float(value)
    return interned("constant", (), plain)


def symbol(name: str) -> Node:
    """The node of a named input."""
    return interned("symbol", (), name)


def table(curve: str, argument: Node, order: int = 0) -> Node:
    """The value (or ``order``-th derivative) of a tabulated curve at ``argument``."""
    return interned("table", (argument,), (curve, order))


def lookup(curve: str, argument: Node, order: int = 0) -> Node:
    """The same as ``table`` where the argument moves with the lanes: every lane finds its own segment."""
    return interned("lookup", (argument,), (curve, order))


def with_arguments(node: Node, arguments: Sequence[Node]) -> Node:
    """The same operation on other arguments."""
    if node.operation in ("table", "lookup"):
        return interned(node.operation, tuple(arguments), node.payload)
    return apply(node.operation, *arguments) if arguments else node


def interned(operation: str, arguments: tuple[Node, ...], payload: Any) -> Node:
    """The one node of an operation on arguments, as it stands: nothing is folded."""
    # the type keeps 1.0 and True apart; the sign keeps 0.0 and -0.0 apart
    mark = (type(payload), math.copysign(1.0, payload)) if isinstance(payload, (float, bool)) else type(payload)
    key = (operation, tuple(argument.serial for argument in arguments), payload, mark)
    if key not in _interned:
        _interned[key] = Node(operation, arguments, payload)
    return _interned[key]


def as_node(value: Any) -> Node:
    """A node as it is, a number as a constant."""
    return value if isinstance(value, Node) else constant(value)


def apply(operation: str, *arguments: Node) -> Node:
    """The node of an operation, folded where the arguments allow it."""
    key = (operation, *[argument.serial for argument in arguments])
    found = _applied.get(key)
    if found is None:
        found = _applied[key] = _apply(operation, arguments)
    return found


def _apply(operation: str, arguments: tuple[Node, ...]) -> Node:
    if all(argument.operation == "constant" for argument in arguments):
        return constant(_fold(operation, arguments))
    simple = _simplify(operation, arguments)
    return interned(operation, arguments, None) if simple is None else simple


def minimum(first: Node | float, second: Node | float) -> Node:
    """The smaller one, as numpy's, which is not declared to take nodes."""
    return apply("minimum", as_node(first), as_node(second))


def maximum(first: Node | float, second: Node | float) -> Node:
    """The larger one, likewise."""
    return apply("maximum", as_node(first), as_node(second))


def where(condition: Node, yes: Node | float, no: Node | float) -> Node:
    """One of two, by a condition, likewise."""
    return apply("where", condition, as_node(yes), as_node(no))


def compute(operation: str) -> Callable[..., Any]:
    """The numpy function that computes an operation."""
    if operation == "wrightomega":
        from dashpot.expr.omega import wrightomega

        return wrightomega
    return np.where if operation == "where" else getattr(np, operation)


def walk(roots: Iterable[Node], known: Container[int] = ()) -> list[Node]:
    """Every node that the roots need, arguments first; none that is an argument and has one of the ``known`` serials.

    The order follows from the form of the graph alone, not from when its nodes were made: equal networks give equal
    lists, whatever was traced before.
    """
    done: dict[int, Node] = {}
    stack = list(roots)[::-1]
    while stack:
        node = stack[-1]
        waiting = [each for each in node.arguments if each.serial not in done and each.serial not in known]
        if waiting and node.serial not in done:
            stack.extend(waiting[::-1])
        else:
            done[node.serial] = stack.pop()
    return list(done.values())


def is_logical(node: Node) -> bool:
    """Whether a node is true or false rather than a number."""
    if node.operation == "where":
        return all(is_logical(choice) for choice in node.arguments[1:])
    return node.operation in LOGICAL or isinstance(node.payload, bool)


def symbols_of(node: Node) -> frozenset[str]:
    """The names of all symbols that a node needs."""
    if node.serial not in _symbols:
        for inner in walk([node], _symbols):
            own = [inner.payload] if inner.operation == "symbol" else []
            _symbols[inner.serial] = frozenset(own).union(*(_symbols[arg.serial] for arg in inner.arguments))
    return _symbols[node.serial]


def _fold(operation: str, arguments: tuple[Node, ...]) -> Any:
    with np.errstate(all="ignore"):
        return compute(operation)(*(argument.payload for argument in arguments)).item()


def _simplify(operation: str, arguments: tuple[Node, ...]) -> Node | None:
    first, *rest = arguments
    second = rest[0] if rest else None
    if operation == "where":
        if first.operation == "constant":
            return arguments[1] if first.payload else arguments[2]
        return arguments[1] if arguments[1] is arguments[2] else None
    if operation == "multiply":
        return second if _is(first, 1.0) else first if _is(second, 1.0) else None
    if operation == "add":
        return second if _is(first, 0.0) else first if _is(second, 0.0) else None
    if operation == "subtract" and _is(second, 0.0):
        return first
    if operation == "negative" and first.operation == "negative":
        return first.arguments[0]
    if operation in ("divide", "power") and _is(second, 1.0):
        return first
    if operation == "power" and _is(second, 2.0):
        return apply("multiply", first, first)
    return None


def _is(node: Node | None, value: float) -> bool:
    return node is not None and node.operation == "constant" and node.payload == value
