"""What depends on the numbers and on the step alone: the constants of the workspaces, the tables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import groupby

from dashpot.expr.node import Node, symbols_of
from dashpot.kernel.ir.online import DT, Online
from dashpot.kernel.targets.scalar.code import MEMORY, Arguments, Code
from dashpot.kernel.targets.scalar.graph import Writer

SHARED = 12  # lines from which on the constants of a branch have a function, which branches of its make share


def write_prepare(code: Code, online: Online) -> None:
    """The function ``prepare`` and those that it calls."""
    if online.program.constants:
        _write_constants(code, online)
    with code.function("nothing", "prepare", MEMORY, "What depends on the numbers and on the step alone."):
        for course, start in enumerate(online.courses):
            step = f"dt / {2 ** (course + 1)}.0" if online.system else "dt"
            if online.program.constants:
                code.do(f"constants(s, {code.index(start)}, {step}, p)")
        for path, shelf in online.shelves.items():
            first = online.numbers.index(f"{path}[0]")
            place = ", ".join(map(code.index, (first, shelf.base, shelf.count)))
            outside = code.number(0.0 if shelf.level else 1.0)
            code.do(f"tabulate(s, {code.index(online.tables)}, p, {place}, {outside})")
        code.set(f"s[{DT}]", "dt")


def _write_constants(code: Code, online: Online) -> None:
    given = {"dt": "dt", "gravity": code.number(online.gravity)}
    known = given | {path: f"p[{number}]" for number, path in enumerate(online.numbers)}
    bodies: dict[str, str] = {}
    calls, rest = [], dict[int, Node]()
    for rows, paths in _of_branches(online):
        names = {path: f"n{number}" for number, path in enumerate(paths)}
        name = _shared(code, rows, given, names, bodies) if paths else ""
        if name:
            calls.append(f"{name}(s, w + {min(rows)}, dt, {', '.join(known[path] for path in paths)})")
        else:
            rest |= rows
    arguments: Arguments = [("array", "s"), ("count", "w"), ("number", "dt"), ("array", "p")]
    with code.function("nothing", "constants", arguments, "The first rows of the workspace that begins at w."):
        for call in calls:
            code.do(call)
        _set_rows(code, rest, known)


def _of_branches(online: Online) -> Iterator[tuple[dict[int, Node], list[str]]]:
    """Constants by their rows that are made of the same numbers and lie side by side, and these numbers."""
    numbers = {path: number for number, path in enumerate(online.numbers)}

    def made_of(row: tuple[int, Node]) -> list[str]:
        return sorted(symbols_of(row[1]) & set(numbers), key=numbers.__getitem__)

    for paths, rows in groupby(enumerate(online.program.constants), made_of):
        yield dict(rows), paths


def _shared(code: Code, rows: Mapping[int, Node], given: Mapping[str, str], names: Mapping[str, str],
            bodies: dict[str, str]) -> str:  # fmt: skip
    """The function that computes constants of some numbers; none where it would be short."""
    name, first, count = f"constants_{len(bodies)}", len(code.lines), code.count
    arguments: Arguments = [("array", "s"), ("count", "w"), ("number", "dt"),
                            *(("number", each) for each in names.values())]  # fmt: skip
    code.count = 0
    with code.function("nothing", name, arguments, "Constants of a branch, from w on."):
        _set_rows(code, {row - min(rows): node for row, node in rows.items()}, {**given, **names})
    text = "\n".join(code.lines[first:]).replace(name, "")
    if len(code.lines) - first < SHARED or text in bodies:
        del code.lines[first:]
        code.count = count
        return bodies.get(text, "")
    bodies[text] = name
    return name


def _set_rows(code: Code, rows: Mapping[int, Node], known: Mapping[str, str]) -> None:
    def leaf(node: Node) -> str | None:
        return code.number(node.payload) if node.operation == "constant" else known.get(node.payload)

    writer = Writer(code, rows.values(), leaf)
    for row, node in rows.items():
        code.set(f"s[w + {row}]", writer.number(node))
