"""Short functions, one idea a file."""

from __future__ import annotations

import ast
import statistics

from architecture.source import FRAMEWORK, PLUGINS, at, modules, tree

SOURCES = modules(FRAMEWORK) + modules(PLUGINS)
CATCH_ALL = {"utils.py", "util.py", "helpers.py", "misc.py", "common.py"}


def lengths() -> list[tuple[int, str]]:
    """Lines of every function, without its docstring, with its place."""
    functions = (
        (path, node)
        for path in SOURCES
        for node in ast.walk(tree(path))
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
    )
    return [(_length(node), f"{at(path, node.lineno)} {node.name}") for path, node in functions]


def _length(node: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    whole = node.end_lineno - node.lineno + 1
    first = node.body[0]
    return whole - (first.end_lineno - first.lineno + 1) * (ast.get_docstring(node) is not None)


def test_functions_are_short():
    found = sorted(lengths())
    sizes = [size for size, _ in found]
    assert statistics.median(sizes) <= 11
    assert statistics.quantiles(sizes, n=10)[-1] <= 50
    assert sizes[-1] <= 60, found[-1]


def test_no_file_collects_what_belongs_nowhere():
    assert not [path for path in SOURCES if path.name in CATCH_ALL]


def test_a_file_can_be_read_in_one_sitting():
    long = {str(path): n for path in SOURCES if (n := len(path.read_text(encoding="utf-8").splitlines())) > 400}
    assert not long
