"""The functions of an exported Modelica package, run statement by statement."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from typing import Any

import numpy as np

FUNCTION = re.compile(r"^    function (\w+) .*?\n(.*?)^    end \1;", flags=re.MULTILINE | re.DOTALL)
CONSTANT = re.compile(r"constant Real (\w+)\[:\] = \{(.*)\};")
HEADS = {"if": "if", "elseif": "elif", "while": "while"}


class Array:
    """Begins at 1; what a function stores into its copy nobody else sees."""

    def __init__(self, values: Any) -> None:
        self.values = np.array(values, dtype=float)

    def __getitem__(self, place: Any) -> Any:
        return Array(self.values[place.start - 1 :]) if isinstance(place, slice) else float(self.values[_index(place)])

    def __setitem__(self, place: int, value: float) -> None:
        self.values[_index(place)] = value


def _index(place: int) -> int:
    assert place >= 1
    return place - 1


def functions_of(text: str) -> dict[str, Any]:
    """The functions by name, as Python functions of numbers and arrays."""
    names: dict[str, Any] = {
        "Array": Array,
        **{key: getattr(math, key) for key in ("exp", "log", "sqrt", "sinh", "tanh", "sin", "cos")},
        "mod": math.fmod,
        "abs": abs,
        "max": max,
    }
    for name, row in CONSTANT.findall(text):
        names[name] = Array([float(each.strip(" ()")) for each in row.split(",")])
    for name, body in FUNCTION.findall(text):
        exec("\n".join(_translated(name, body)), names)
    return names


def _translated(name: str, body: str) -> Iterator[str]:
    declared, _, statements = body.partition("    algorithm\n")
    inputs = re.findall(r"input \w+ (\w+)(?:\[:\])?;", declared)
    outputs = re.findall(r"output \w+ (\w+)", declared)
    yield f"def {name}({', '.join(inputs)}):"
    if "s0" in inputs:
        yield "    s = Array(s0.values)" if "s" in outputs else "    s = s0"
    answer = f"return {', '.join(outputs)}"
    for line in statements.splitlines():
        space, words = line[: len(line) - len(line.lstrip())], line.strip()
        if words not in ("end if;", "end for;", "end while;"):
            yield space[4:] + _statement(words, answer)
    yield f"    {answer}"


def _statement(words: str, answer: str) -> str:
    if words == "return;":
        return answer
    if words == "else":
        return "else:"
    if found := re.fullmatch(r"for (\w+) in (.+?):(.+) loop", words):
        return f"for {found[1]} in range({found[2]}, {found[3]} + 1):"
    if found := re.fullmatch(r"(if|while) (.+) (?:then|loop)", words):
        return f"{HEADS[found[1]]} {_expression(found[2])}:"
    place, value = words.removesuffix(";").split(" := ")
    place = place.replace("(, ", "(_, ")  # an output that is not needed
    return f"{place} = {_expression(value)}"


def _expression(text: str) -> str:
    while (start := text.rfind("(if ")) >= 0:  # the last one that begins holds no other
        condition, _, rest = text[start + len("(if ") :].partition(" then ")
        value, _, other = rest.partition(" else ")
        text = f"{text[:start]}(({value}) IF ({condition}) ELSE {other}"
    text = text.replace(" IF ", " if ").replace(" ELSE ", " else ")
    return text.replace("<>", "!=").replace("^", "**").replace(":end]", ":]")
