"""Statements of Python as numba compiles it: numbers are 64 bits wide, division by zero gives infinity."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import ClassVar

from dashpot.kernel.targets.scalar.code import COMMON, Arguments, Block, Code, Kind

FUTURE = """\
from __future__ import annotations

"""
LIBRARIES = """\
from math import cos, exp, expm1, fabs, inf, log, log1p, pow, sin, sqrt, tanh

import numpy as np
from numba import njit
"""
HELPERS = """
from dashpot.kernel.targets.numba.borrowed import borrowed, zeros_on_stack
from dashpot.kernel.targets.numba.native import native
from dashpot.kernel.targets.numba.packed import beyond_0, beyond_1, beyond_2, beyond_3, beyond_4
from dashpot.kernel.targets.numba.packed import packed_0, packed_1, packed_2, packed_3, packed_4

"""
SETTINGS = 'cache=True, nogil=True, error_model="numpy", fastmath={"contract"}'
INNER = "no_cpython_wrapper=True, no_cfunc_wrapper=True"
WIDTH = 4  # of a pack
OMEGA = "wrightomega"
PACK = """

@native
def apart_{omegas}(a: number, b: number, c: number, d: number) -> four:
    return {answers}


@native
def pack_{omegas}(a: number, b: number, c: number, d: number) -> four:
    if beyond_{omegas}(a, b, c, d):
        return apart_{omegas}(a, b, c, d)
    return packed_{omegas}(a, b, c, d)
"""
AT_EVERY_SAMPLE = frozenset({"advance", "step", "step_"})  # written into the loop that calls them


class PythonCode(Code):
    """A module of compiled functions."""

    head: ClassVar[str] = FUTURE + LIBRARIES + HELPERS
    operations = {**COMMON, "logical_not": "(not {0})", "where": "({1} if {0} else {2})"}

    def __init__(self, *called: str) -> None:
        """Functions whose names are ``called`` can be called from Python, too."""
        super().__init__()
        self.called = called
        self.packs: set[int] = set()
        self.lines += self.head.splitlines()

    @property
    def text(self) -> str:
        """All that is written, and the packs that it uses."""
        return super().text + "".join(
            PACK.format(
                omegas=omegas,
                answers=", ".join(f"omega({x})" if k < omegas else f"exp({x})" for k, x in enumerate("abcd")),
            )
            for omegas in sorted(self.packs)
        )

    def let(self, name: str, value: str, kind: Kind = "number") -> None:
        """An assignment."""
        self.set(name, value)

    def set(self, place: str, value: str) -> None:
        """An assignment."""
        self.write(f"{place} = {value}")

    def do(self, call: str) -> None:
        """A call."""
        self.write(call)

    def answer(self, value: str) -> None:
        """A return."""
        self.write(f"return {value}")

    @contextmanager
    def function(self, kind: Kind, name: str, arguments: Arguments, about: str) -> Iterator[None]:
        """A compiled function."""
        self.lines += ["", "", *self.declared(kind, name, arguments)]
        self.depth += 1
        before = len(self.lines)
        yield
        if len(self.lines) == before:  # a pass of a network that has nothing to do in it
            self.write("pass")
        self.depth -= 1

    def declared(self, kind: Kind, name: str, arguments: Arguments) -> list[str]:
        """The lines before the body of a function: numba compiles those alone that are called from Python, too."""
        if name in self.called:
            return compiled(name, arguments, SETTINGS)
        own = ", ".join(f"{argument}: {each}" for each, argument in arguments)
        return ["@native", f"def {name}({own}) -> {kind}:"]

    def when(self, condition: str) -> Block:
        """An if."""
        return self.indented(f"if {condition}:")

    def otherwise(self) -> Block:
        """An else."""
        return self.indented("else:")

    def repeat(self, condition: str) -> Block:
        """A while."""
        return self.indented(f"while {condition}:")

    def loop(self, name: str, first: str | int, end: str | int) -> Block:
        """A for."""
        return self.indented(f"for {name} in range({first}, {end}):")

    def numbers(self, name: str, values: Sequence[float]) -> None:
        """An array, which is a constant of the compiled functions."""
        self.write(f"{name} = np.array([{', '.join(map(self.number, values))}])")

    def index(self, value: int) -> str:
        """A count that is no literal: numba would compile a function anew for every literal."""
        return f"np.int64({value})"

    def together(self, calls: Sequence[tuple[str, str]]) -> list[str]:
        """The names of functions of arguments that do not need each other, four of them in a vector."""
        ordered = sorted(range(len(calls)), key=lambda k: calls[k][0] != OMEGA)
        names = [""] * len(calls)
        for first in range(0, len(calls), WIDTH):
            chosen = ordered[first : first + WIDTH]
            omegas = sum(calls[k][0] == OMEGA for k in chosen)
            self.packs.add(omegas)
            arguments = [*(calls[k][1] for k in chosen), *["0.0"] * (WIDTH - len(chosen))]
            self.count += 1
            found = [f"p{self.count}_{place}" for place in range(WIDTH)]
            self.write(f"{', '.join(found)} = pack_{omegas}({', '.join(arguments)})")
            for k, name in zip(chosen, found, strict=False):
                names[k] = name
        return names

    def borrow(self, *arrays: str) -> None:
        """Arrays that the caller keeps."""
        for array in arrays:
            self.set(array, f"borrowed({array})")

    def zeros(self, count: int) -> str:
        """An array for as long as the function runs."""
        return f"zeros_on_stack({count})"

    def number(self, value: float | bool) -> str:
        """A literal."""
        if isinstance(value, bool) or not math.isinf(value):
            return repr(value) if isinstance(value, bool) or value >= 0.0 else f"({value!r})"
        return "inf" if value > 0.0 else "(-inf)"


def compiled(name: str, arguments: Arguments, settings: str) -> list[str]:
    """The lines before the body of a function that numba compiles."""
    settings += ", forceinline=True" if name in AT_EVERY_SAMPLE else ""
    return [f"@njit({settings})", f"def {name}({', '.join(argument for _, argument in arguments)}):"]


class AloneCode(PythonCode):
    """The same for a module that needs numba and numpy alone."""

    head = LIBRARIES

    def declared(self, kind: Kind, name: str, arguments: Arguments) -> list[str]:
        """The lines before the body of a function."""
        return compiled(name, arguments, SETTINGS if name in self.called else f"{SETTINGS}, {INNER}")

    def together(self, calls: Sequence[tuple[str, str]]) -> list[str]:
        """One function after the other."""
        return []

    def borrow(self, *arrays: str) -> None:
        """Arrays as they are."""

    def zeros(self, count: int) -> str:
        """A new array."""
        return f"np.zeros({count})"
