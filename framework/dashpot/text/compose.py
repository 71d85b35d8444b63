"""From the parser's events to nodes with positions, under caps that hold before anything is walked."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from contextlib import suppress

import yaml

from dashpot.text.core_schema import resolve
from dashpot.text.node import Mapping, Node, Scalar, Sequence
from dashpot.text.problem import InputError, Place, Problem

MAX_NODES = 100_000
MAX_DEPTH = 64
MAX_ALIASES = 16

# what the parser complains about -> what the writer should do
_HINTS = {
    "'\\t'": "indent with spaces, not with tabs",
    "mapping values are not allowed": "check the indentation and the colon; quote a text that contains ': '",
    "<block end>": "the lines of one block start in the same column",
    "<document start>": "the lines of one block start in the same column",
    "',' or '": "close the bracket, or set a comma between the parts",
    "could not find expected ':'": "write 'key: value'",
    "unexpected end of stream": "close the quote or bracket that is opened here",
}


def compose(text: str, file: str | None, ours: bool = False) -> Node:
    """The root node of a YAML text. Raises InputError with everything that is wrong with its form.

    A text that is ``ours``, of a shipped file or of no file, as the framework writes them, is read by libyaml where it
    is there, five times as fast; of a user's file it would accept tabs and commas that YAML does not allow.
    """
    if (ours or file is None) and not text.startswith("\ufeff"):
        with suppress(yaml.YAMLError):
            composer = _Composer(text, file, getattr(yaml, "CSafeLoader", yaml.SafeLoader))
            root = composer.document()
            if not composer.problems:
                return root
    composer = _Composer(text, file, yaml.SafeLoader)
    try:
        root = composer.document()
    except yaml.MarkedYAMLError as error:
        composer.problems.append(_syntax_problem(error, file))
    except yaml.reader.ReaderError as error:
        composer.problems.append(_character_problem(error, text, file))
    if composer.problems:
        raise InputError(composer.problems)
    return root


def place_at(text: str, offset: int, file: str | None) -> Place:
    """The place of a character offset."""
    before = text[:offset]
    return Place(file, before.count("\n") + 1, offset - (before.rfind("\n") + 1) + 1)


def _syntax_problem(error: yaml.MarkedYAMLError, file: str | None) -> Problem:
    mark = error.problem_mark or error.context_mark
    hints = [hint for sign, hint in _HINTS.items() if sign in str(error.problem)]
    hint = (hints or ["check the indentation, the colons and the quotes around here"])[0]
    context = f" ({error.context})" if error.context else ""
    return Problem(Place(file, mark.line + 1, mark.column + 1), f"this is not YAML: {error.problem}{context}", hint)


def _character_problem(error: yaml.reader.ReaderError, text: str, file: str | None) -> Problem:
    message = f"the character U+{ord(text[error.position]):04X} is not allowed in YAML"
    return Problem(place_at(text, error.position, file), message, "remove it")


class _Composer:
    """Walks the events once; keeps the problems, the anchors and the counts that are capped."""

    def __init__(self, text: str, file: str | None, loader: type[yaml.SafeLoader]):
        self.text = text
        self.file = file
        self.problems: list[Problem] = []
        self._events: Iterator[yaml.Event] = yaml.parse(text, Loader=loader)
        self._anchors: dict[str, tuple[Node, int]] = {}
        self._nodes = 0
        self._aliases = 0

    def document(self) -> Node:
        next(self._events)
        event = next(self._events)
        if isinstance(event, yaml.StreamEndEvent):
            return Scalar(Place(self.file, 1, 1), 0, 0)
        root = self._node(next(self._events), 0)
        next(self._events)
        event = next(self._events)
        if not isinstance(event, yaml.StreamEndEvent):
            self._complain(event, "a second document begins here, expected one", "put it into a file of its own")
        return root

    def _node(self, event: yaml.Event, depth: int) -> Node:
        self._count(event, depth)
        if isinstance(event, yaml.AliasEvent):
            return self._alias(event)
        before = self._nodes
        if event.tag is not None:
            self._complain(event, f"the tag '{event.tag}' is not allowed here", "remove it; quote a text instead")
        node = self._content(event, depth)
        if event.anchor:
            self._anchors[event.anchor] = (node, self._nodes - before + 1)
        return node

    def _content(self, event: yaml.Event, depth: int) -> Node:
        if isinstance(event, yaml.ScalarEvent):
            return self._scalar(event)
        if isinstance(event, yaml.SequenceStartEvent):
            return self._sequence(event, depth)
        return self._mapping(event, depth)

    def _scalar(self, event: yaml.ScalarEvent) -> Scalar:
        start, end = event.start_mark.index, event.end_mark.index
        # the end of a block text is found only at the next line that is not blank
        end = start + len(self.text[start:end].rstrip())
        value = event.value if event.style else resolve(event.value)  # plain: None, or "" of libyaml
        return Scalar(self._place(event), start, end, value, event.value)

    def _sequence(self, event: yaml.Event, depth: int) -> Sequence:
        items: list[Node] = []
        while not isinstance(inner := next(self._events), yaml.SequenceEndEvent):
            items.append(self._node(inner, depth + 1))
        end = inner.end_mark.index if event.flow_style else items[-1].end
        return Sequence(self._place(event), event.start_mark.index, end, tuple(items))

    def _mapping(self, event: yaml.Event, depth: int) -> Mapping:
        entries: dict[str, Node] = {}
        keys: dict[str, Node] = {}
        end = event.end_mark.index
        while not isinstance(inner := next(self._events), yaml.MappingEndEvent):
            key = self._node(inner, depth + 1)
            value = self._node(next(self._events), depth + 1)
            name = self._new_name(key, keys)
            if name:
                keys[name], entries[name] = key, value
            end = value.end
        end = inner.end_mark.index if event.flow_style else end
        return Mapping(self._place(event), event.start_mark.index, end, entries, keys)

    def _new_name(self, key: Node, keys: dict[str, Node]) -> str | None:
        """The text of a key, None when it is no name or stands there already."""
        if not isinstance(key, Scalar) or not key.written:
            self.problems.append(Problem(key.place, f"expected a name before ':', got {key.describe()}", "name it"))
            return None
        if key.written in keys:
            message = f"'{key.written}' stands twice, first in line {keys[key.written].place.line}"
            self.problems.append(Problem(key.place, message, "remove or rename one of them"))
            return None
        return key.written

    def _alias(self, event: yaml.AliasEvent) -> Node:
        self._aliases += 1
        node, size = self._anchors.get(event.anchor, (None, 0))
        if node is None:
            self._complain(event, f"'*{event.anchor}' refers to nothing above", f"write '&{event.anchor}' first")
            node = Scalar(self._place(event), event.start_mark.index, event.end_mark.index)
        if self._aliases > MAX_ALIASES:
            self._give_up(event, f"more than {MAX_ALIASES} aliases", "write the values out")
        self._nodes += size
        return dataclasses.replace(
            node, place=self._place(event), start=event.start_mark.index, end=event.end_mark.index
        )

    def _count(self, event: yaml.Event, depth: int) -> None:
        self._nodes += 1
        if self._nodes > MAX_NODES:
            self._give_up(event, f"more than {MAX_NODES} values", "put long tables into a file of their own")
        if depth > MAX_DEPTH:
            self._give_up(event, f"nested more than {MAX_DEPTH} levels deep", "write it flatter")

    def _place(self, event: yaml.Event) -> Place:
        return Place(self.file, event.start_mark.line + 1, event.start_mark.column + 1)

    def _complain(self, event: yaml.Event, message: str, hint: str) -> None:
        self.problems.append(Problem(self._place(event), message, hint))

    def _give_up(self, event: yaml.Event, message: str, hint: str) -> None:
        self._complain(event, message, hint)
        raise InputError(self.problems)
