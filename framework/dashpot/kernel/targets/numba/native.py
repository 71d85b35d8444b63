"""Functions of a printed module as machine code, without numba's inference.

numba takes milliseconds for every operation: it infers types and resolves overloads, of which printed functions need
none, as the kinds of all arguments are written. So their text goes straight to LLVM, and numba compiles no more than
what others call. Every function that numba's code needs comes with all that it calls, in one piece.
"""

from __future__ import annotations

import ast
import inspect
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
from llvmlite import ir
from numba import types
from numba.core.errors import TypingError
from numba.extending import intrinsic

from dashpot.kernel.targets.numba.statements import COUNT, NUMBER, Statements

KINDS: dict[str, ir.Type] = {
    "number": NUMBER,
    "count": COUNT,
    "nothing": ir.VoidType(),
    "four": ir.LiteralStructType([NUMBER] * 4),
    "array": ir.PointerType(NUMBER),
    "counts": ir.PointerType(COUNT),
}
SCALARS = {"number": types.float64, "count": types.int64, "nothing": types.none}
ELEMENTS = {"array": types.float64, "counts": types.int64}
RARE = ("prepare", "begin", "try_high_order", "search", "settle", "launch", "apart_")  # kept out of what calls them
AT_EVERY_SAMPLE = ("advance", "step_")


def native(function: Callable[..., Any]) -> Any:
    """The function for code that numba compiles; its annotations are the kinds of its arguments and of its answer."""
    config: Any = numba.config
    if config.DISABLE_JIT:
        return function
    *kinds, answer = function.__annotations__.values()

    def declared(typing: Any, *arguments: Any) -> Any:
        given = [_accepted(kind, argument) for kind, argument in zip(kinds, arguments, strict=True)]

        def generate(context: Any, builder: Any, signature: Any, values: Any) -> Any:
            code = _Unit.of(function).function(context, builder.module, function.__name__)
            passed = [_data(context, builder, *each) for each in zip(signature.args, values, strict=True)]
            found = builder.call(code, passed)
            return context.get_dummy_value() if answer == "nothing" else found

        return SCALARS[answer](*given), generate

    first = inspect.Parameter("typing", inspect.Parameter.POSITIONAL_OR_KEYWORD)
    own = inspect.signature(function)
    setattr(declared, "__signature__", own.replace(parameters=[first, *own.parameters.values()]))  # noqa: B010
    declared.__name__ = function.__name__
    return intrinsic(declared)


def _accepted(kind: str, given: Any) -> Any:
    if kind not in ELEMENTS:
        return SCALARS[kind]
    fits = isinstance(given, types.Array) and given.ndim == 1 and given.layout in ("C", "F")
    if not fits or given.dtype != ELEMENTS[kind]:
        raise TypingError(f"expected a contiguous one-dimensional array of {ELEMENTS[kind]}, got {given}")
    return given


def _data(context: Any, builder: Any, kind: Any, value: Any) -> Any:
    """A number as it is, of an array the address of its first element."""
    return context.make_array(kind)(context, builder, value).data if isinstance(kind, types.Array) else value


class _Unit:
    """The functions of a module, each compiled where it is needed."""

    known: dict[str, _Unit] = {}  # noqa: RUF012

    def __init__(self, name: str) -> None:
        module = sys.modules[name]
        assert module.__file__ is not None
        text = Path(module.__file__).read_text(encoding="utf-8")
        self.name, self.names = name, vars(module)
        self.written = {each.name: each for each in ast.parse(text).body if isinstance(each, ast.FunctionDef)}

    @classmethod
    def of(cls, function: Callable[..., Any]) -> _Unit:
        name = function.__module__
        if name not in cls.known:
            cls.known[name] = cls(name)
        return cls.known[name]

    def function(self, context: Any, module: ir.Module, name: str) -> Any:
        """The function in an LLVM module, with those that it calls."""
        full = f"{self.name}.{name}"
        if full in module.globals:
            return module.globals[full]
        written = self.written[name]
        kinds = [ast.unparse(each.annotation) for each in written.args.args if each.annotation]
        assert written.returns is not None
        kind = ir.FunctionType(KINDS[ast.unparse(written.returns)], [KINDS[each] for each in kinds])
        found = ir.Function(module, kind, full)
        found.linkage = "internal"
        if name.startswith(RARE):
            found.attributes.add("noinline")
            found.attributes.add("cold")
        elif name in AT_EVERY_SAMPLE:
            found.attributes.add("alwaysinline")
        for argument, own in zip(found.args, written.args.args, strict=True):
            argument.name = own.arg
        Statements(self, context, found).write(written.body)
        return found
