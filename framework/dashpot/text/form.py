"""Reading a mapping key by key, collecting all mistakes instead of stopping at the first."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection
from typing import Any, Final, Literal, TypeVar

from dashpot.text.name import RULE, is_name, shown
from dashpot.text.node import Mapping, Node, Scalar, Sequence
from dashpot.text.problem import Place, Problem, nearest
from dashpot.text.quantity import si

T = TypeVar("T")


class _Required:
    """The default of a key that must be there."""


REQUIRED: Final = _Required()
LARGEST = 1e30  # in SI units: no specimen or rig has more, and products of such numbers are still finite


class Form:
    """One mapping of a YAML text, read key by key.

    Every reading method takes the key, notes a Problem when the value is not what it should be, and then returns the
    default (None for a required key): after the whole form is read the caller looks at `problems`. `close()` tells of
    the keys nobody asked for. `what` names the form in messages ("the run 'qs'").
    """

    def __init__(self, node: Node, problems: list[Problem], what: str):
        self.origin = node
        self.problems = problems
        self.what = what
        self._is_mapping = isinstance(node, Mapping)
        self._entries = dict(node.entries) if isinstance(node, Mapping) else {}
        self._keys = dict(node.keys) if isinstance(node, Mapping) else {}
        self._asked: dict[str, None] = {}
        if not self._is_mapping:
            empty = isinstance(node, Scalar) and node.value is None
            hint = "write its keys" if empty else "indent its keys"
            self.complain(None, f"expected {what} as 'key: value' lines, got {node.describe()}", hint)

    @property
    def place(self) -> Place:
        return self.origin.place

    @property
    def keys(self) -> tuple[str, ...]:
        """All keys, in the order of the text."""
        return tuple(self._entries)

    @property
    def rest(self) -> tuple[str, ...]:
        """The keys that were not asked for so far, in the order of the text."""
        return tuple(key for key in self._entries if key not in self._asked)

    def __contains__(self, key: str) -> bool:
        return key in self._entries

    def place_of(self, key: str | None) -> Place:
        """Where the value of a key stands; the form itself when there is none."""
        return self.origin.place if key is None else self._entries.get(key, self.origin).place

    def key_place(self, key: str) -> Place:
        """Where the key itself stands."""
        return self._keys.get(key, self.origin).place

    def complain(
        self, key: str | None, message: str, hint: str = "", severity: Literal["error", "warning"] = "error"
    ) -> None:
        """Note a problem at the value of `key` (None: at the form itself)."""
        self.problems.append(Problem(self.place_of(key), message, hint, severity))

    def take(self, key: str, read: Callable[[Node], T], default: Any = REQUIRED) -> T | Any:
        """What `read` makes of the value of `key`; `read` raises ValueError with a message for a wrong value."""
        node = self.node(key, None if default is REQUIRED else default)
        if not isinstance(node, Node):
            self._miss(key, default)
            return None if default is REQUIRED else default
        try:
            return read(node)
        except ValueError as error:
            self.problems.append(Problem(node.place, f"{self.what}, '{key}': {error}"))
            return None if default is REQUIRED else default

    def node(self, key: str, default: Any = None) -> Node | Any:
        """The node of a key as it is."""
        self._asked[key] = None
        return self._entries.get(key, default)

    def text(self, key: str, default: Any = REQUIRED) -> str | Any:
        """A text; a number is taken as it is written."""
        return self.take(key, read_text, default)

    def name(self, key: str, default: Any = REQUIRED) -> str | Any:
        """A text that can be the name of a file."""
        return self.take(key, read_name, default)

    def texts(self, key: str, default: Any = REQUIRED) -> list[str] | Any:
        """A list of texts."""
        return self.take(key, lambda node: [read_text(item) for item in read_items(node)], default)

    def number(self, key: str, default: Any = REQUIRED) -> float | Any:
        """A finite number without a unit."""
        return self.take(key, read_number, default)

    def integer(self, key: str, default: Any = REQUIRED) -> int | Any:
        """A whole number."""
        return self.take(key, read_integer, default)

    def flag(self, key: str, default: Any = REQUIRED) -> bool | Any:
        """true or false."""
        return self.take(key, read_flag, default)

    def quantity(self, key: str, unit: str, default: Any = REQUIRED) -> float | Any:
        """A quantity, in SI: a text with a unit of the kind of `unit`, or a bare number."""
        return self.take(key, lambda node: read_quantity(node, unit), default)

    def quantities(self, key: str, unit: str, default: Any = REQUIRED) -> list[float] | Any:
        """A list of quantities, in SI."""
        return self.take(key, lambda node: [read_quantity(item, unit) for item in read_items(node)], default)

    def choice(
        self, key: str, known: Collection[str], default: Any = REQUIRED, meant: dict[str, str] | None = None
    ) -> str | Any:
        """One of the known words; for others the message tells what may be ``meant`` by them."""
        return self.take(key, lambda node: read_choice(node, known, meant), default)

    def form(self, key: str, what: str = "", default: Any = REQUIRED) -> Form | Any:
        """The mapping below a key, as a form that notes into the same list; closing it is up to the caller."""
        return self.take(key, lambda node: self._nested(node, what or f"{self.what}, '{key}'"), default)

    def forms(self, key: str, default: Any = REQUIRED) -> list[Form] | Any:
        """The list of mappings below a key."""
        return self.take(key, lambda node: self._listed(node, key), default)

    def named(self, key: str, default: Any = REQUIRED) -> dict[str, Form] | Any:
        """The named mappings below a key: `a: {...}`, `b: {...}`."""
        return self.take(key, lambda node: self._by_name(node, key), default)

    def close(self) -> None:
        """Note every key that nobody asked for, with the nearest known word."""
        for key in self.rest:
            hint = nearest(key, self._asked) or "known here: " + ", ".join(self._asked)
            self.problems.append(Problem(self._keys[key].place, f"{self.what} has no key '{key}'", hint))

    def _miss(self, key: str, default: object) -> None:
        if default is REQUIRED and self._is_mapping:
            self.complain(None, f"{self.what} lacks '{key}'", f"add a line '{key}: ...'")

    def _nested(self, node: Node, what: str) -> Form:
        return Form(node, self.problems, what)

    def _listed(self, node: Node, key: str) -> list[Form]:
        items = enumerate(read_items(node), 1)
        return [self._nested(item, f"{self.what}, '{key}' number {number}") for number, item in items]

    def _by_name(self, node: Node, key: str) -> dict[str, Form]:
        if not isinstance(node, Mapping):
            raise ValueError(f"expected named entries 'name: {{...}}', got {node.describe()}")
        return {name: self._nested(entry, f"'{name}' of {key}") for name, entry in node.entries.items()}


def read_text(node: Node) -> str:
    """The text of a scalar. ValueError for anything else, for an empty one and for one with control characters."""
    if not isinstance(node, Scalar) or node.value is None or not node.written.strip():
        raise ValueError(f"expected a text, got {node.describe()}")
    if any(ord(character) < 32 and character not in "\n\t" for character in node.written):
        raise ValueError(f"expected a text without control characters, got {node.written!r}")
    return node.written


def read_name(node: Node) -> str:
    """A text that can be the name of a file."""
    text = read_text(node)
    if not is_name(text):
        raise ValueError(f"{shown(text)} cannot be a name: {RULE}")
    return text


def read_number(node: Node) -> float:
    """A finite number. ValueError for anything else."""
    value = node.value if isinstance(node, Scalar) else None
    if isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value):
        return float(value)
    raise ValueError(f"expected a finite number, got {node.describe()}")


def read_integer(node: Node) -> int:
    """A whole number. ValueError for anything else."""
    value = node.value if isinstance(node, Scalar) else None
    if isinstance(value, int) and not isinstance(value, bool):
        return value
    raise ValueError(f"expected a whole number, got {node.describe()}")


def read_flag(node: Node) -> bool:
    """A truth value. ValueError for anything else."""
    if isinstance(node, Scalar) and isinstance(node.value, bool):
        return node.value
    raise ValueError(f"expected true or false, got {node.describe()}")


def read_quantity(node: Node, unit: str) -> float:
    """A quantity in SI. ValueError for a wrong unit, for one that nothing has, and for anything that is no quantity."""
    if not isinstance(node, Scalar) or node.value is None:
        raise ValueError(f"expected a quantity in {unit}, got {node.describe()}")
    number = si(node.value, unit)
    if abs(number) > LARGEST:
        raise ValueError(f"expected a quantity of up to {LARGEST:g} {unit}, got {number:g}; check the number")
    return number


def read_choice(node: Node, known: Collection[str], meant: dict[str, str] | None = None) -> str:
    """One of the known words. ValueError with the nearest one, or what may be ``meant``, for anything else."""
    word = read_text(node)
    if word in known:
        return word
    wanted = f"one of {', '.join(known)}" if known else "nothing, as there is nothing to choose from"
    also = meant or {}
    hint = f"did you mean '{also[word.lower()]}'?" if word.lower() in also else nearest(word, known)
    raise ValueError(f"expected {wanted}, got '{word}'; {hint}".rstrip("; "))


def read_items(node: Node) -> tuple[Node, ...]:
    """The items of a list. ValueError for anything else."""
    if isinstance(node, Sequence):
        return node.items
    raise ValueError(f"expected a list [..., ...], got {node.describe()}")
