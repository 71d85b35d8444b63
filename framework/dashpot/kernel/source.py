"""Printing a sorted network as a self-contained file of numba code.

Time is the outer loop, lanes the inner one. Everything a lane owns lies in one flat workspace, 64 lanes a row, so that
the compiler sees constant distances and vectorises. At turning points of the drive only the states of rate-independent
branches move; then comes the step itself. Where an event is due, states are corrected before.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

from dashpot.expr.node import Node, is_logical
from dashpot.kernel.layout import Layout, Passes, score_row
from dashpot.kernel.prelude import PRELUDE
from dashpot.kernel.stages import Stage
from dashpot.kernel.tiers import Program

WIDTH = 64
SEGMENT = 4 * WIDTH  # a table segment: four coefficients of a cubic for each lane

_INFIX = {
    "add": "+", "subtract": "-", "multiply": "*", "divide": "/", "power": "**", "less": "<", "less_equal": "<=",
    "greater": ">", "greater_equal": ">=", "equal": "==", "not_equal": "!=", "logical_and": "&", "logical_or": "|",
}  # fmt: skip
_CALLS = {"minimum": "minimum", "maximum": "maximum", "sign": "sign", "absolute": "abs", "sqrt": "math.sqrt",
          "expm1": "math.expm1", "log1p": "math.log1p", "tanh": "math.tanh", "sin": "math.sin",
          "cos": "math.cos"}  # fmt: skip

_ARGUMENTS = "columns, index, local, turn_at, turn_columns, tables, w, lanes"
_TYPES = "float64[:,::1], int64[:,::1], float64[:,::1], int64[::1], float64[:,::1], float64[::1], float64[::1], int64"


def print_source(program: Program) -> str:
    """The source file of a network: the functions ``simulate`` and ``score``.

    Both take ``columns`` (samples, columns), ``index`` and ``local`` (samples, lookups), ``turn_at`` (turns,),
    ``turn_columns`` (turns, columns), ``tables``, the workspace ``w`` and the number of ``lanes`` in it, in eights.
    ``simulate`` fills ``out`` (samples, lanes); ``score`` adds weight * (force - measured)^2 to its row of ``w``.
    """
    passes, gather = Passes.of(program), f"w[{WIDTH * score_row(program)} + l]"
    store = ["out[k, l] = {force}"]
    add = ["miss = {force} - target", f"{gather} = {gather} + weigh * (miss * miss)"]
    begin = ["target = measured[k]", "weigh = weight[k]"]
    return "\n".join([
        f'"""Network kernel: {len(program.states)} states, {len(program.constants)} constants."""',
        PRELUDE,
        _function("simulate", ", out", ", float64[:,::1]", [], _run(program, passes, store)),
        _function("score", ", measured, weight", ", float64[::1], float64[::1]", begin, _run(program, passes, add)),
    ])  # fmt: skip


def _function(name: str, extra: str, types: str, begin: Sequence[str], body: Sequence[str]) -> str:
    # the mask tells the compiler that no lane is left over when vectors are full
    lines = [f'@njit("void({_TYPES}{types})", cache=True, **LOOP)', f"def {name}({_ARGUMENTS}{extra}):",
             "    use_full_vectors()", "    lanes = lanes & -8", "    m = 0",
             "    for k in range(columns.shape[0]):"]  # fmt: skip
    return renumbered("\n".join([*lines, *indented(8, [*begin, *body])])) + "\n"


def _run(program: Program, passes: Passes, ending: Sequence[str]) -> list[str]:
    lines: list[str] = []
    if passes.turn:
        turn = [
            *_correction(program, passes, "turn_columns[m"),
            *print_pass(passes.turn, "turn_columns[m", []),
            "m += 1",
        ]
        lines += ["while m < turn_at.shape[0] and turn_at[m] == k:", *indented(4, turn)]
    return [*lines, *_correction(program, passes, "columns[k"), *print_pass(passes.step, "columns[k", ending)]


def _correction(program: Program, passes: Passes, column: str) -> list[str]:
    if not passes.correct:
        return []
    due = [f"{column}, {passes.correct.columns[event.serial]}] != 0.0" for event in program.events]
    return [f"if {' or '.join(due)}:", *indented(4, print_pass(passes.correct, column, []))]


def print_pass(layout: Layout, column: str, ending: Sequence[str]) -> list[str]:
    """The lines of a pass over the lanes, with the drive's columns in ``column``; ``ending`` closes the last loop."""
    *early, last = layout.stages
    lines = []
    for stage in early:
        lines += _loop(layout, stage, column, [])
        lines += _calls(layout, stage)
    moved = [f"w[{WIDTH * row} + l] = {_name(layout, node)}" for row, node in layout.moved()]
    force = _name(layout, layout.force) if layout.force is not None else ""
    return lines + _loop(layout, last, column, [*moved, *(line.format(force=force) for line in ending)])


def _loop(layout: Layout, stage: Stage, column: str, ending: Sequence[str]) -> list[str]:
    head: list[str] = []
    body: list[str] = []
    for node in stage.reads:
        if layout.kind(node) == "drive":
            head += [f"{_name(layout, node)} = {column}, {layout.columns[node.serial]}]{_truth(node)}"]
        elif layout.kind(node) != "number":
            body += [f"{_name(layout, node)} = w[{WIDTH * layout.row(node)} + l]{_truth(node)}"]
    for node in stage.nodes:
        if node.operation == "table":
            number = layout.lookups[node.payload[0], node.arguments[0].serial]
            head += [f"h{number} = tables[index[k, {number}] : index[k, {number}] + {SEGMENT}]",
                     f"u{number} = local[k, {number}]"]  # fmt: skip
            body += [f"{_name(layout, node)} = {_cubic(number)}"]
        else:
            body += [f"{_name(layout, node)} = {_expression(layout, node)}"]
    body += [f"w[{WIDTH * layout.row(node)} + l] = {_name(layout, node)}" for node in stage.nodes
             if node.serial in layout.kept]  # fmt: skip
    return [*head, "for l in range(lanes):", *indented(4, [*body, *ending])] if stage.nodes or ending else []


def _calls(layout: Layout, stage: Stage) -> list[str]:
    # calls of the same function, whose rows follow one another at equal distances, are one call
    runs: list[tuple[str, list[tuple[int, int]]]] = []
    lines = []
    for node in stage.calls:
        rows = layout.row(node.arguments[0]), layout.row(node)
        if node.operation == "lookup":
            lines.append(_lookup(layout, node, rows))
            continue
        if runs and runs[-1][0] == node.operation and _continues(runs[-1][1], rows):
            runs[-1][1].append(rows)
        else:
            runs.append((node.operation, [rows]))
    return [*lines, *(f"{operation}_rows(w, {_places(run)}, {len(run)}, lanes)" for operation, run in runs)]


def _lookup(layout: Layout, node: Node, rows: tuple[int, int]) -> str:
    (curve, order), (source, target) = node.payload, rows
    shelf = layout.shelves[curve]
    place = f"tables, {shelf.base}, knots, {shelf.first}, {shelf.count}"
    return f"lookup_rows(w, {WIDTH * source}, {WIDTH * target}, {place}, {order}, lanes)"


def _continues(run: Sequence[tuple[int, int]], rows: tuple[int, int]) -> bool:
    return len(run) == 1 or all(2 * run[-1][k] - run[-2][k] == rows[k] for k in (0, 1))


def _places(run: Sequence[tuple[int, int]]) -> str:
    ends = run[1] if len(run) > 1 else run[0]
    return ", ".join(f"{WIDTH * first}, {WIDTH * (second - first)}" for first, second in zip(run[0], ends, strict=True))


def _name(layout: Layout, node: Node) -> str:
    kind = layout.kind(node)
    if kind == "number":
        return _number(node.payload)
    if kind == "lane":
        return f"a{layout.constants[node.serial]}"
    if kind == "drive":
        return f"c{layout.columns[node.serial]}"
    return f"z{layout.states[node.payload]}" if kind == "state" else f"t{node.serial}"


def _truth(node: Node) -> str:
    # the workspace and the columns hold numbers, also for what is true or false
    return " != 0.0" if is_logical(node) else ""


def _number(value: float | bool) -> str:
    if isinstance(value, bool) or math.isfinite(value):
        return repr(value) if isinstance(value, bool) or value >= 0.0 else f"({value!r})"
    return "math.inf" if value > 0.0 else "(-math.inf)"


def _cubic(number: int) -> str:
    terms = [f"h{number}[{WIDTH * power} + l]" for power in range(4)]
    return f"{terms[0]} + u{number} * ({terms[1]} + u{number} * ({terms[2]} + u{number} * {terms[3]}))"


def _expression(layout: Layout, node: Node) -> str:
    arguments = [_name(layout, argument) for argument in node.arguments]
    if node.operation == "where":
        return f"({arguments[1]} if {arguments[0]} else {arguments[2]})"
    if node.operation == "negative":
        return f"-{arguments[0]}"
    if node.operation == "logical_not":
        return f"(not {arguments[0]})"
    if node.operation in _INFIX:
        return f"{arguments[0]} {_INFIX[node.operation]} {arguments[1]}"
    return f"{_CALLS[node.operation]}({', '.join(arguments)})"


def indented(width: int, lines: Sequence[str]) -> list[str]:
    """Lines moved to the right."""
    return [" " * width + line for line in lines]


def renumbered(text: str) -> str:
    """The text with its intermediate results numbered from 0 on."""
    # the names of intermediate results carry serial numbers of this process; equal networks must print equal files
    order: dict[str, str] = {}
    return re.sub(r"\bt(\d+)\b", lambda found: order.setdefault(found[0], f"t{len(order)}"), text)
