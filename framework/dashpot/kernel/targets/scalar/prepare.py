"""What depends on the parameters and on the step alone: the constants of the workspaces, the tables."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
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
    with code.function("nothing", "prepare", MEMORY, "What depends on the parameters and on the step alone."):
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
    groups = [(rows, paths, _text(code, rows, paths, given)) for rows, paths in _of_branches(online)]
    often = Counter(text for _, _, text in groups)
    names, calls, rest = dict[str, str](), [], dict[int, Node]()
    for rows, paths, text in groups:
        if not paths or often[text] == 1 or text.count("\n") < SHARED:
            rest |= rows
            continue
        if text not in names:
            names[text] = f"constants_{len(names)}"
            _write_function(code, names[text], rows, paths, given)
        calls.append(f"{names[text]}(s, w + {min(rows)}, dt, {', '.join(known[path] for path in paths)})")
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


def _text(code: Code, rows: Mapping[int, Node], paths: Sequence[str], given: Mapping[str, str]) -> str:
    """The text of a function for constants shared by branches of one structure; nothing is written."""
    first = len(code.lines)
    _write_function(code, "constants_of", rows, paths, given)
    text = "\n".join(code.lines[first:])
    del code.lines[first:]
    return text


def _write_function(
    code: Code, name: str, rows: Mapping[int, Node], paths: Sequence[str], given: Mapping[str, str]
) -> None:
    names = {path: f"n{number}" for number, path in enumerate(paths)}
    arguments: Arguments = [
        ("array", "s"),
        ("count", "w"),
        ("number", "dt"),
        *(("number", each) for each in names.values()),
    ]
    code.count = 0
    with code.function("nothing", name, arguments, "Constants of a branch, from w on."):
        _set_rows(code, {row - min(rows): node for row, node in rows.items()}, {**given, **names})


def _set_rows(code: Code, rows: Mapping[int, Node], known: Mapping[str, str]) -> None:
    def leaf(node: Node) -> str | None:
        return code.number(node.payload) if node.operation == "constant" else known.get(node.payload)

    writer = Writer(code, rows.values(), leaf)
    for row, node in rows.items():
        code.set(f"s[w + {row}]", writer.number(node))
