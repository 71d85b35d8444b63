"""Printing a sorted network as a self-contained file of numba code.

Time is the outer loop, lanes the inner one. Everything a lane owns lies in one flat workspace, 64 lanes a row, so that
the compiler sees constant distances and vectorises. The first loop of a step runs only at turning points of the drive
and moves the states of rate-independent branches; the second one makes the step.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import Literal

from dashpot.expr.node import Node, is_logical
from dashpot.kernel.prelude import PRELUDE
from dashpot.kernel.tiers import Program

WIDTH = 64
SEGMENT = 4 * WIDTH  # a table segment: four coefficients of a cubic for each lane

_INFIX = {
    "add": "+", "subtract": "-", "multiply": "*", "divide": "/", "power": "**", "less": "<", "less_equal": "<=",
    "greater": ">", "greater_equal": ">=", "equal": "==", "not_equal": "!=", "logical_and": "&", "logical_or": "|",
}  # fmt: skip
_CALLS = {"exp": "exp", "log": "log", "wrightomega": "wrightomega", "minimum": "minimum", "maximum": "maximum",
          "sign": "sign", "absolute": "abs", "sqrt": "math.sqrt", "expm1": "math.expm1", "log1p": "math.log1p",
          "tanh": "math.tanh", "sin": "math.sin", "cos": "math.cos"}  # fmt: skip

_ARGUMENTS = "columns, index, local, turn_at, turn_columns, tables, w, lanes"
_TYPES = "float64[:,::1], int64[:,::1], float64[:,::1], int64[::1], float64[:,::1], float64[::1], float64[::1], int64"


def print_source(program: Program) -> str:
    """The source file of a network: the functions ``simulate`` and ``score``.

    Both take ``columns`` (samples, columns), ``index`` and ``local`` (samples, lookups), ``turn_at`` (turns,),
    ``turn_columns`` (turns, columns), ``tables``, the workspace ``w`` and the number of ``lanes`` in it.
    ``simulate`` fills ``out`` (samples, lanes); ``score`` adds weight * (force - measured)^2 to the last row of ``w``.
    """
    names = _Names(program)
    last = WIDTH * names.rows
    store = [f"out[k, l] = {names.of(program.force)}"]
    add = [f"miss = {names.of(program.force)} - target",
           f"w[{last} + l] = w[{last} + l] + weight[k] * (miss * miss)"]  # fmt: skip
    return "\n".join([
        f'"""Network kernel: {len(program.states)} states, {len(program.constants)} constants."""',
        PRELUDE,
        _function("simulate", ", out", ", float64[:,::1]", names, store, ""),
        _function("score", ", measured, weight", ", float64[::1], float64[::1]", names, add, "target = measured[k]"),
    ])  # fmt: skip


def rows(program: Program) -> int:
    """Rows of the workspace before the one of the score: constants, then states."""
    return len(program.constants) + len(program.states)


# where the loop finds a node: printed as it is, hoisted per lane, hoisted per sample, a memory, a table, or computed
_Kind = Literal["number", "lane", "drive", "state", "table", "result"]


class _Names:
    """Which name every node has in the printed loop."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self.constants = {node.serial: number for number, node in enumerate(program.constants)}
        self.columns = {node.serial: number for number, node in enumerate(program.columns)}
        self.states = {name: len(self.constants) + number for number, name in enumerate(program.states)}
        self.lookups = {(look.curve, look.argument.serial): number for number, look in enumerate(program.lookups)}
        self.rows = rows(program)

    def kind(self, node: Node) -> _Kind:
        if node.operation == "constant":
            return "number"
        if node.serial in self.constants:
            return "lane"
        if node.serial in self.columns:
            return "drive"
        if node.operation == "table":
            return "table"
        return "state" if node.operation == "symbol" else "result"

    def of(self, node: Node) -> str:
        kind = self.kind(node)
        if kind == "number":
            return _number(node.payload)
        if kind == "lane":
            return f"a{self.constants[node.serial]}"
        if kind == "drive":
            return f"c{self.columns[node.serial]}"
        return f"z{self.states[node.payload]}" if kind == "state" else f"t{node.serial}"

    def row(self, node: Node) -> int:
        """The row of the workspace that holds a constant or a state."""
        return self.constants[node.serial] if self.kind(node) == "lane" else self.states[node.payload]

    def inner(self, turning: bool) -> list[Node]:
        """The nodes that the loop has to compute or load, arguments first."""
        found: dict[int, Node] = {}
        stack = [(root, False) for root in reversed(self.program.roots(turning))]
        while stack:
            node, ready = stack.pop()
            if node.serial in found or self.kind(node) == "number":
                continue
            if ready or self.kind(node) != "result":
                found[node.serial] = node
            else:
                stack.append((node, True))
                stack.extend((argument, False) for argument in reversed(node.arguments))
        return list(found.values())


def _function(name: str, extra: str, types: str, names: _Names, ending: Sequence[str], beginning: str) -> str:
    lines = [f'@njit("void({_TYPES}{types})", cache=True, **LOOP)', f"def {name}({_ARGUMENTS}{extra}):"]
    if names.program.turning:
        lines += ["    m = 0"]
    lines += ["    for k in range(columns.shape[0]):"]
    if names.program.turning:
        lines += ["        while m < turn_at.shape[0] and turn_at[m] == k:",
                  *_indent(12, _loop(names, True, [])), "            m += 1"]  # fmt: skip
    if beginning:
        lines += [f"        {beginning}"]
    lines += _indent(8, _loop(names, False, ending))
    return _renumber("\n".join(lines)) + "\n"


def _loop(names: _Names, turning: bool, ending: Sequence[str]) -> list[str]:
    nodes = names.inner(turning)
    program = names.program
    row, place = ("turn_columns", "m") if turning else ("columns", "k")
    head = [_loaded(n, names, f"{row}[{place}, {names.columns[n.serial]}]") for n in nodes if names.kind(n) == "drive"]
    body = [_loaded(n, names, f"w[{WIDTH * names.row(n)} + l]") for n in nodes if names.kind(n) in ("lane", "state")]
    for node in nodes:
        if names.kind(node) == "table":
            number = names.lookups[node.payload[0], node.arguments[0].serial]
            head += [f"h{number} = tables[index[k, {number}] : index[k, {number}] + {SEGMENT}]",
                     f"u{number} = local[k, {number}]"]  # fmt: skip
            body += [f"{names.of(node)} = {_cubic(number)}"]
        elif names.kind(node) == "result":
            body += [f"{names.of(node)} = {_expression(node, names)}"]
    states = program.turning if turning else program.states
    body += [f"w[{WIDTH * names.states[s]} + l] = {names.of(program.updates[s])}" for s in states]
    return [*head, "for l in range(lanes):", *_indent(4, [*body, *ending])]


def _loaded(node: Node, names: _Names, home: str) -> str:
    # what is hoisted is kept as a number, also where it is true or false
    return f"{names.of(node)} = {home}" + (" != 0.0" if is_logical(node) else "")


def _number(value: float | bool) -> str:
    if isinstance(value, bool) or math.isfinite(value):
        return repr(value) if isinstance(value, bool) or value >= 0.0 else f"({value!r})"
    return "math.inf" if value > 0.0 else "(-math.inf)"


def _cubic(number: int) -> str:
    terms = [f"h{number}[{WIDTH * power} + l]" for power in range(4)]
    return f"{terms[0]} + u{number} * ({terms[1]} + u{number} * ({terms[2]} + u{number} * {terms[3]}))"


def _expression(node: Node, names: _Names) -> str:
    arguments = [names.of(argument) for argument in node.arguments]
    if node.operation == "where":
        return f"({arguments[1]} if {arguments[0]} else {arguments[2]})"
    if node.operation == "negative":
        return f"-{arguments[0]}"
    if node.operation == "logical_not":
        return f"(not {arguments[0]})"
    if node.operation in _INFIX:
        return f"{arguments[0]} {_INFIX[node.operation]} {arguments[1]}"
    return f"{_CALLS[node.operation]}({', '.join(arguments)})"


def _indent(width: int, lines: Sequence[str]) -> list[str]:
    return [" " * width + line for line in lines]


def _renumber(text: str) -> str:
    # the names of intermediate results carry serial numbers of this process; equal networks must print equal files
    order: dict[str, str] = {}
    return re.sub(r"\bt(\d+)\b", lambda found: order.setdefault(found[0], f"t{len(order)}"), text)
