"""Writing statements of a language with variables, loops and functions.

Expressions are text. What stands in them is common to all languages that derive from here: arithmetic, comparisons,
``&`` and ``|`` between them, elements of arrays, calls. What is not has a template in ``operations``.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager
from typing import ClassVar, Literal

Kind = Literal["number", "count", "truth", "array", "counts", "nothing"]
Block = AbstractContextManager[None]
Arguments = Sequence[tuple[Kind, str]]

MEMORY: Arguments = [("array", "s"), ("number", "dt"), ("array", "p")]  # of a network, the step, its numbers

COMMON = {
    "add": "({0} + {1})",
    "subtract": "({0} - {1})",
    "multiply": "({0} * {1})",
    "divide": "({0} / {1})",
    "negative": "(-{0})",
    "absolute": "fabs({0})",
    "less": "({0} < {1})",
    "less_equal": "({0} <= {1})",
    "greater": "({0} > {1})",
    "greater_equal": "({0} >= {1})",
    "equal": "({0} == {1})",
    "not_equal": "({0} != {1})",
    "logical_and": "({0} & {1})",
    "logical_or": "({0} | {1})",
    "power": "pow({0}, {1})",
    "minimum": "smaller({0}, {1})",
    "maximum": "larger({0}, {1})",
    "sign": "side({0})",
    "wrightomega": "omega({0})",
    **{name: f"{name}({{0}})" for name in ("sqrt", "exp", "expm1", "log", "log1p", "tanh", "sin", "cos")},
}


class Code(ABC):
    """A text while it is being written."""

    operations: ClassVar[Mapping[str, str]]
    """The expression of every operation of a graph."""
    lacking: ClassVar[frozenset[str]] = frozenset()
    """Functions of the C library that the language has not: they are written out."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.depth = 0
        self.count = 0

    @property
    def text(self) -> str:
        """All that is written."""
        return "\n".join(self.lines) + "\n"

    def write(self, line: str) -> None:
        """A line at the depth of now."""
        self.lines.append("    " * self.depth + line if line else "")

    def new(self, value: str, kind: Kind = "number") -> str:
        """The name of a new variable with this value."""
        self.count += 1
        self.let(f"v{self.count}", value, kind)
        return f"v{self.count}"

    @abstractmethod
    def let(self, name: str, value: str, kind: Kind = "number") -> None:
        """A variable that is not there yet."""

    @abstractmethod
    def set(self, place: str, value: str) -> None:
        """A new value of a variable or of an element of an array."""

    @abstractmethod
    def do(self, call: str) -> None:
        """A call for its effect."""

    @abstractmethod
    def answer(self, value: str) -> None:
        """The end of a function."""

    @abstractmethod
    def function(self, kind: Kind, name: str, arguments: Arguments, about: str) -> Block:
        """A function; what is written inside is its body."""

    @abstractmethod
    def when(self, condition: str) -> Block:
        """What is written inside is done where the condition holds."""

    @abstractmethod
    def otherwise(self) -> Block:
        """What is written inside is done where the last condition does not hold."""

    @abstractmethod
    def repeat(self, condition: str) -> Block:
        """What is written inside is done as long as the condition holds."""

    @abstractmethod
    def loop(self, name: str, first: str | int, end: str | int) -> Block:
        """What is written inside is done for an index from ``first`` on, as long as it is below ``end``."""

    @abstractmethod
    def numbers(self, name: str, values: Sequence[float]) -> None:
        """A constant array."""

    @abstractmethod
    def number(self, value: float | bool) -> str:
        """A number or a truth."""

    def index(self, value: int) -> str:
        """A count that a function is called with."""
        return str(value)

    def together(self, calls: Sequence[tuple[str, str]]) -> list[str]:
        """The names of functions, by operation, of arguments, computed side by side; none where a language cannot."""
        return []

    @contextmanager
    def indented(self, head: str, end: str = "") -> Iterator[None]:
        """Deeper lines under a head."""
        self.write(head)
        self.depth += 1
        yield
        self.depth -= 1
        if end:
            self.write(end)
