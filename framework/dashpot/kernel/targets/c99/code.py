"""Statements of C99 with doubles and ints."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from dashpot.kernel.targets.scalar.code import COMMON, Arguments, Block, Code, Kind

TYPES: dict[Kind, str] = {"number": "double", "count": "int", "truth": "int", "nothing": "void"}


class CCode(Code):
    """Functions of a source file, which nobody else sees."""

    operations = {
        **COMMON,
        "logical_and": "({0} && {1})",
        "logical_or": "({0} || {1})",
        "logical_not": "(!{0})",
        "where": "({0} ? {1} : {2})",
    }

    def let(self, name: str, value: str, kind: Kind = "number") -> None:
        """A definition."""
        self.write(f"{TYPES[kind]} {name} = {value};")

    def set(self, place: str, value: str) -> None:
        """An assignment."""
        self.write(f"{place} = {value};")

    def do(self, call: str) -> None:
        """A call."""
        self.write(f"{call};")

    def answer(self, value: str) -> None:
        """A return."""
        self.write(f"return {value};")

    def function(self, kind: Kind, name: str, arguments: Arguments, about: str) -> Block:
        """A static function."""
        self.lines += ["", f"/* {about} */"]
        names = [f"double *{name}" if each == "array" else f"{TYPES[each]} {name}" for each, name in arguments]
        return self._body(f"static inline {TYPES[kind]} {name}({', '.join(names)})", [name for _, name in arguments])

    @contextmanager
    def _body(self, head: str, arguments: Sequence[str]) -> Iterator[None]:
        self.lines += [head, "{"]
        first = len(self.lines)
        self.depth += 1
        yield
        body = "\n".join(self.lines[first:])
        idle = [f"    (void){name};" for name in arguments if not re.search(rf"\b{name}\b", body)]
        self.lines[first:first] = idle
        self.depth -= 1
        self.lines.append("}")

    def when(self, condition: str) -> Block:
        """An if."""
        return self.indented(f"if ({condition}) {{", "}")

    def otherwise(self) -> Block:
        """An else."""
        return self.indented("else {", "}")

    def repeat(self, condition: str) -> Block:
        """A while."""
        return self.indented(f"while ({condition}) {{", "}")

    def loop(self, name: str, first: str | int, end: str | int) -> Block:
        """A for."""
        return self.indented(f"for (int {name} = {first}; {name} < {end}; ++{name}) {{", "}")

    def numbers(self, name: str, values: Sequence[float]) -> None:
        """A constant array."""
        self.write(f"static const double {name}[{len(values)}] = {{{', '.join(map(self.number, values))}}};")

    def number(self, value: float | bool) -> str:
        """A literal."""
        if isinstance(value, bool):
            return str(int(value))
        text = "INFINITY" if math.isinf(value) else repr(abs(value))
        return text if value >= 0.0 and math.copysign(1.0, value) > 0.0 else f"(-{text})"
