"""Statements of Modelica functions.

A Modelica function cannot change its arguments: one that stores into the memory ``s`` gets it as ``s0`` and answers a
changed copy. Arrays begin at 1.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from dashpot.kernel.targets.scalar.code import COMMON, Arguments, Block, Code, Kind

TYPES: dict[Kind, str] = {"number": "Real", "count": "Integer", "truth": "Boolean"}
MEMORY, RETURN = "s", "return;"


class ModelicaCode(Code):
    """Functions of a package."""

    operations = {
        **COMMON,
        "absolute": "abs({0})",
        "power": "({0} ^ {1})",
        "logical_not": "(not {0})",
        "where": "(if {0} then {1} else {2})",
    }
    lacking = frozenset({"expm1", "log1p"})

    def __init__(self) -> None:
        super().__init__()
        self.locals: dict[str, str] = {}
        self.changing: dict[str, Kind] = {}  # what answers a changed memory, and what else

    def let(self, name: str, value: str, kind: Kind = "number") -> None:
        """A variable of the function, and an assignment."""
        self.locals[name] = TYPES[kind]
        self.set(name, value)

    def set(self, place: str, value: str) -> None:
        """An assignment; a function that changes the memory answers that, too."""
        if value.partition("(")[0] in self.changing:
            self.write(f"({place}, {MEMORY}) := {_words(value)};")
        else:
            self.write(f"{_words(place)} := {_words(value)};")

    def do(self, call: str) -> None:
        """A call that changes the memory; one that does not is left out."""
        if answer := self.changing.get(call.partition("(")[0]):
            self.write(f"{MEMORY if answer == 'nothing' else f'(, {MEMORY})'} := {_words(call)};")

    def answer(self, value: str) -> None:
        """A return."""
        self.write(f"answer := {_words(value)};")
        self.write(RETURN)

    @contextmanager
    def function(self, kind: Kind, name: str, arguments: Arguments, about: str) -> Iterator[None]:
        """A function with its variables declared first."""
        self.locals, head, self.depth = {}, len(self.lines), 2
        yield
        body = self.lines[head:]
        if body and body[-1].strip() == RETURN:  # a function ends there anyway
            del body[-1]
        changes = any(re.match(rf"\s*(\(.*, )?{MEMORY}(\[.*\])?\)? := ", line) for line in body)
        if changes:
            self.changing[name] = kind
        self.lines[head:] = [*self._declared(kind, name, arguments, about, changes), *body, f"    end {name};", ""]

    def _declared(self, kind: Kind, name: str, arguments: Arguments, about: str, changes: bool) -> list[str]:
        lines = [f'    function {name} "{about}"', "      extends Modelica.Icons.Function;"]
        for each, argument in arguments:
            given = f"{argument}0" if changes and argument == MEMORY else argument
            lines.append(
                f"      input {'Real' if each == 'array' else TYPES[each]} {given}{'[:]' * (each == 'array')};"
            )
        if kind != "nothing":
            lines.append(f"      output {TYPES[kind]} answer;")
        if changes:
            lines.append(f"      output Real {MEMORY}[size({MEMORY}0, 1)] = {MEMORY}0;")
        if self.locals:
            lines += ["    protected", *(f"      {type_} {local};" for local, type_ in self.locals.items())]
        return [*lines, "    algorithm"]

    def when(self, condition: str) -> Block:
        """An if."""
        return self.indented(f"if {_words(condition)} then", "end if;")

    def otherwise(self) -> Block:
        """An else of the if before."""
        self.lines.pop()
        return self.indented("else", "end if;")

    def repeat(self, condition: str) -> Block:
        """A while."""
        return self.indented(f"while {_words(condition)} loop", "end while;")

    def loop(self, name: str, first: str | int, end: str | int) -> Block:
        """A for."""
        return self.indented(f"for {name} in {first}:({end}) - 1 loop", "end for;")

    def numbers(self, name: str, values: Sequence[float]) -> None:
        """A constant array."""
        self.lines += [f"    constant Real {name}[:] = {{{', '.join(map(self.number, values))}}};", ""]

    def number(self, value: float | bool) -> str:
        """A literal."""
        if isinstance(value, bool):
            return str(value).lower()
        text = "Modelica.Constants.inf" if math.isinf(value) else repr(abs(value))
        return text if math.copysign(1.0, value) > 0.0 else f"(-{text})"


def _words(text: str) -> str:
    """An expression in the words of Modelica."""
    for common, own in ((" & ", " and "), (" | ", " or "), (" != ", " <> "), ("fabs(", "abs(")):
        text = text.replace(common, own)
    text = re.sub(r"(\w+) % (\w+)", r"mod(\1, \2)", text)
    return re.sub(r"(\w+)\[([^\]:]+)\]", _from_one, text)


def _from_one(found: re.Match[str]) -> str:
    array, index = found.groups()
    return f"{array}[{int(index) + 1}]" if index.isdigit() else f"{array}[{index} + 1]"
