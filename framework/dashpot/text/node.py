"""The parts of a parsed text: scalars, sequences and mappings that know where they stand."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping as MappingType
from dataclasses import dataclass

from dashpot.text.problem import Place

Value = None | bool | int | float | str


@dataclass(frozen=True, eq=False)
class Node(ABC):
    """A part of a YAML text.

    `text[start:end]` is exactly what stands there: no comment, no blank line after it. An empty value has
    `start == end` right behind its colon.
    """

    place: Place
    start: int
    end: int

    @abstractmethod
    def describe(self) -> str:
        """What this is, in words for an error message."""

    @abstractmethod
    def plain(self) -> object:
        """The same as plain Python values: None, bool, int, float, str, list, dict."""


@dataclass(frozen=True, eq=False)
class Scalar(Node):
    """A single value; `written` is the text it was made from (without quotes)."""

    value: Value = None
    written: str = ""

    def describe(self) -> str:
        if self.value is None:
            return "nothing"
        kind = {bool: "the truth value", int: "the number", float: "the number"}.get(type(self.value), "the text")
        shown = self.written if len(self.written) <= 60 else self.written[:57] + "..."
        return f"{kind} '{shown}'"

    def plain(self) -> Value:
        return self.value


@dataclass(frozen=True, eq=False)
class Sequence(Node):
    """A list of nodes."""

    items: tuple[Node, ...] = ()

    def describe(self) -> str:
        return f"a list of {len(self.items)}"

    def plain(self) -> list[object]:
        return [item.plain() for item in self.items]


@dataclass(frozen=True, eq=False)
class Mapping(Node):
    """Named nodes, in the order of the text; `keys` holds the nodes of the names themselves."""

    entries: MappingType[str, Node]
    keys: MappingType[str, Node]

    def describe(self) -> str:
        return "a mapping with " + (", ".join(f"'{key}'" for key in list(self.entries)[:4]) or "nothing in it")

    def plain(self) -> dict[str, object]:
        return {key: node.plain() for key, node in self.entries.items()}
