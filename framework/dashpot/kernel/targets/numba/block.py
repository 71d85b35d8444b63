"""Networks as numba runs them for the kernel: one lane after the other along the prepared columns of a whole record.

The arguments are those of the text that the fast target compiles, all arrays flat.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from dashpot.expr.node import Node, walk
from dashpot.kernel.ir.layout import Layout, Passes, score_row
from dashpot.kernel.ir.program import Program
from dashpot.kernel.ir.system import (
    MOST_CORRECTIONS,
    MOST_PLACES,
    MOST_STATIC_STEPS,
    MOST_STEPS,
    THIRD,
    UNBALANCED,
    UNSOLVED,
    SystemProgram,
)
from dashpot.kernel.targets.numba.code import PythonCode
from dashpot.kernel.targets.scalar.code import Arguments
from dashpot.kernel.targets.scalar.functions import write_functions
from dashpot.kernel.targets.scalar.graph import Writer, truth

PASS: Arguments = [
    ("array", "columns"),
    ("counts", "index"),
    *(("array", name) for name in ("local", "tables", "w")),
    ("count", "c"),
    ("count", "i"),
]
RUN: Arguments = [
    *(("array", name) for name in ("columns", "index", "local")),
    ("count", "samples"),
    *(("array", name) for name in ("turn_at", "turn_columns", "all_tables", "space", "measured", "weight", "out")),
    ("count", "asked"),
    ("count", "n"),
]
SYSTEM_PASS: Arguments = [
    *(("array", name) for name in ("columns", "w", "tables", "knots")),
    ("count", "c"),
    ("count", "o"),
]
NEWTON: Arguments = [*SYSTEM_PASS, ("array", "status"), ("count", "l")]
SYSTEM: Arguments = [
    *(("array", name) for name in ("still", "coarse", "fine")),
    ("count", "per"),
    ("count", "samples"),
    *(("array", name) for name in ("space", "status", "all_tables", "knots", "measured", "weight", "out", "miss")),
    ("count", "scoring"),
    ("count", "begins"),
    ("count", "course"),
    ("count", "asked"),
    ("count", "n"),
]


def print_network(program: Program) -> str:
    """The module of a network with two ends; ``n`` lanes lie side by side, the first ``asked`` are computed."""
    code, passes = PythonCode("run"), Passes.of(program)
    write_functions(code, _operations([*program.roots, *program.corrections.values()]))
    for name, layout in (("correct", passes.correct), ("turn", passes.turn), ("step", passes.step)):
        if layout:
            with code.function("number", f"{name}_", PASS, f"Pass '{name}'."):
                code.answer(_write_pass(code, layout, program))
    with _run(code, RUN):
        _write_lane(code, program, passes)
    return code.text


@contextmanager
def _run(code: PythonCode, arguments: Arguments) -> Iterator[None]:
    with code.function("nothing", "run", arguments, "All lanes."):
        code.borrow(*(name for kind, name in arguments if kind == "array"))
        with code.loop("l", 0, "asked"), _own_memory(code):
            yield


@contextmanager
def _own_memory(code: PythonCode) -> Iterator[None]:
    # the parameters of a lane side by side; a slice would take numba a second to compile
    pairs = (("own", "space", "w"), ("own_tables", "all_tables", "tables"))
    for own, array, name in pairs:
        code.let(own, f"np.empty({array}.size // n)", "array")
        code.let(name, f"borrowed({own})", "array")
        with code.loop("k", 0, f"{array}.size // n"):
            code.set(f"{name}[k]", f"{array}[k * n + l]")
    yield
    for own, array, _ in pairs:
        with code.loop("k", 0, f"{array}.size // n"):
            code.set(f"{array}[k * n + l]", f"{own}[k]")


def _operations(roots: list[Node]) -> set[str]:
    return {node.operation for node in walk(roots)}


def _write_pass(code: PythonCode, layout: Layout, program: Program) -> str:
    def leaf(node: Node) -> str | None:
        kind = layout.kind(node)
        if kind == "drive":
            return truth(node, f"columns[c + {layout.columns[node.serial]}]")
        if kind in ("lane", "state"):
            return truth(node, f"w[{layout.row(node)}]")
        return code.number(node.payload) if kind == "number" else None

    def look_up(node: Node, _: str) -> str:
        number = layout.lookups[node.payload[0], node.arguments[0].serial]
        place = code.new(f"4 * index[i + {number}]", "count")
        return _cubic("tables", place, f"local[i + {number}]", node.payload[1])

    roots = [*([layout.force] if layout.force is not None else []), *layout.updates.values()]
    # a table knows its place by its index: what is given to nothing else is written nowhere
    given = {node.arguments[0].serial for node in layout.results if node.operation == "table"}
    asked = (*roots, *(one for node in layout.results if node.operation != "table" for one in node.arguments))
    skipped = given - {node.serial for node in asked}
    writer = Writer(code, roots, lambda node: "0.0" if node.serial in skipped else leaf(node), look_up)
    if layout.force is not None:
        writer.compute_together()
    force = code.new(writer.number(layout.force)) if layout.force is not None else "0.0"
    writer.store({f"w[{layout.states[name]}]": node for name, node in layout.updates.items()})
    return force


def _cubic(array: str, c: str, u: str, order: int) -> str:
    c0, c1, c2, c3 = (f"{array}[{c} + {power}]" for power in range(4))
    return (
        f"({c0} + {u} * ({c1} + {u} * ({c2} + {u} * {c3})))",
        f"({c1} + {u} * (2.0 * {c2} + 3.0 * {u} * {c3}))",
        f"(2.0 * {c2} + 6.0 * {u} * {c3})",
    )[order]


def _write_lane(code: PythonCode, program: Program, passes: Passes) -> None:
    across, looked = len(program.columns), len(program.lookups)
    code.let("turn", "0", "count")
    with code.loop("k", 0, "samples"):
        if passes.turn:
            with code.repeat("turn_at[turn] == k"):
                _correct(code, program, passes, "turn_columns", f"turn * {across}")
                code.do(f"turn_(turn_columns, index, local, tables, w, turn * {across}, 0)")
                code.set("turn", "turn + 1")
        _correct(code, program, passes, "columns", f"k * {across}")
        code.let("force", f"step_(columns, index, local, tables, w, k * {across}, k * {looked})")
        with code.when("out.size > 0"):
            code.set("out[k * n + l]", "force")
        with code.otherwise():
            score = f"w[{score_row(program)}]"
            code.set(score, f"{score} + weight[k] * (force - measured[k]) ** 2")


def _correct(code: PythonCode, program: Program, passes: Passes, columns: str, first: str) -> None:
    if passes.correct is None:
        return
    places = [passes.correct.columns[event.serial] for event in program.events]
    due = " | ".join(f"({columns}[{first} + {place}] != 0.0)" for place in places)
    with code.when(due):
        code.do(f"correct_({columns}, index, local, tables, w, {first}, 0)")


def print_system(system: SystemProgram) -> str:
    """The module of a network with unknown nodes; as ``print_network``."""
    code = PythonCode("run")
    write_functions(code, _operations([node for layout in system.passes.values() for node in layout.updates.values()]))
    for name, layout in system.passes.items():
        with code.function("nothing", f"{name}_", SYSTEM_PASS, f"Pass '{name}'."):
            _write_system_pass(code, layout)
    _write_newton(code, system, "settle", MOST_STATIC_STEPS, UNBALANCED)
    _write_newton(code, system, "launch", MOST_PLACES)
    if system.kept:
        _write_newton(code, system, "correct", MOST_CORRECTIONS)
    _write_newton(code, system, "improve", MOST_STEPS)
    _write_newton(code, system, "search", MOST_PLACES, UNSOLVED)
    with _run(code, SYSTEM):
        _write_system_lane(code, system)
    return code.text


def _write_system_pass(code: PythonCode, layout: Layout) -> None:
    def leaf(node: Node) -> str | None:
        kind = layout.kind(node)
        if kind == "drive":
            return truth(node, f"columns[c + {layout.columns[node.serial]}]")
        if kind in ("lane", "state"):
            return truth(node, f"w[o + {layout.row(node)}]")
        return code.number(node.payload) if kind == "number" else None

    def look_up(node: Node, argument: str) -> str:
        shelf = layout.shelves[node.payload[0]]
        x, k = code.new(argument), code.new(str(shelf.base), "count")
        with code.loop("j", shelf.base + 1, shelf.base + 1 + shelf.count), code.when(f"{x} >= knots[j]"):
            code.set(k, f"{k} + 1")
        place = code.new(f"4 * {k}", "count")
        return _cubic("tables", place, f"({x} - knots[{k}])", node.payload[1])

    Writer(code, layout.updates.values(), leaf, look_up).store(
        {f"w[o + {layout.states[name]}]": node for name, node in layout.updates.items()}
    )


def _write_newton(code: PythonCode, system: SystemProgram, name: str, most: int, failure: int | None = None) -> None:
    done = f"w[o + {system.row(system.done)}]"
    undone = f"({done} == 0.0) & (status[l] != {UNSOLVED}.0)"
    with code.function("nothing", name, NEWTON, "Newton's steps until they are short, none once some failed."):
        code.let("left", str(most), "count")
        with code.repeat(f"(left > 0) & {undone}"):
            code.do(f"{name}_(columns, w, tables, knots, c, o)")
            code.set("left", "left - 1")
        if failure is not None:
            with code.when(undone):
                code.set("status[l]", f"{failure}.0")


def _write_system_lane(code: PythonCode, system: SystemProgram) -> None:
    across = len(system.program.columns)
    with code.when("begins != 0"):
        for o in (0, system.rows):
            place = f"w, tables, knots, 0, {code.index(o)}"
            code.do(f"start_(still, {place})")
            code.do(f"settle(still, {place}, status, l)")
            code.do(f"rest_(still, {place})")
            code.do(f"launch(still, {place}, status, l)")
            code.do(f"set_off_(still, {place})")
    with code.loop("k", 0, "samples"):
        with code.when("k >= begins"):
            long = "per * (course < 2)"
            for o, columns, count in ((0, "coarse", long), (system.rows, "fine", "2 * per")):
                with code.loop("j", f"(k - begins) * {count}", f"(k - begins + 1) * {count}"):
                    place = f"{columns}, w, tables, knots, j * {across}, {code.index(o)}"
                    code.do(f"predict_({place})")
                    if system.turns and system.kept:
                        with code.when(f"w[{o + system.row(system.turns)}] != 0.0"):
                            code.do(f"turn_({place})")
                        with code.when(f"w[{o + system.row(system.kept)}] != 0.0"):
                            code.do(f"correct({place}, status, l)")
                    code.do(f"improve({place}, status, l)")
                    code.do(f"search({place}, status, l)")
                    code.do(f"commit_({place})")
        with code.when("scoring == 0"):
            _each(code, system, [*system.forces, *system.places], _store)
        with code.otherwise():
            _each(code, system, [*system.forces], _score)


def _each(
    code: PythonCode, system: SystemProgram, names: list[str], write: Callable[[PythonCode, int, int], None]
) -> None:
    for number, name in enumerate(names):
        row = system.row(name)
        code.let("short", f"w[{system.rows + row}]")
        code.let("gap", f"short - w[{row}]")
        code.let("best", f"short + (course < 1) * {THIRD!r} * gap")
        write(code, number, len(names))
        if number < len(system.forces):
            code.set(f"miss[{number} * n + l]", f"miss[{number} * n + l] + gap * gap")


def _store(code: PythonCode, number: int, count: int) -> None:
    code.set(f"out[(k * {count} + {number}) * n + l]", "best")


def _score(code: PythonCode, number: int, count: int) -> None:
    place = f"k * {count} + {number}"
    code.let("away", f"best - measured[{place}]")
    code.set(f"out[{number} * n + l]", f"out[{number} * n + l] + weight[{place}] * away * away")
