"""Changing a YAML text in place: entries replaced and added in the style, block or flow, of their surroundings."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass

from dashpot.text.document import Document
from dashpot.text.node import Mapping, Node, Scalar, Sequence
from dashpot.text.problem import InputError


@dataclass(frozen=True)
class Edit:
    """Replace ``text[start:end]`` by ``new``."""

    start: int
    end: int
    new: str


def apply_edits(text: str, edits: Iterable[Edit]) -> str:
    """The text after all edits. ValueError where two of them overlap."""
    last = len(text)
    for edit in sorted(edits, key=lambda edit: (edit.start, edit.end), reverse=True):
        if edit.end > last:
            raise ValueError(f"two edits want to change the text before character {edit.end}")
        text = text[: edit.start] + edit.new + text[edit.end :]
        last = edit.start
    return text


def replace_entry(mapping: Mapping, key: str, new: str) -> Edit:
    """The edit that gives a key another value, written on one line."""
    node = mapping.entries[key]
    return Edit(node.start, node.end, new)


def add_entry(document: Document, mapping: Node, lines: str) -> str:
    """The text of a document with an entry, unindented lines ``key: ...``, added at the end of one of its mappings.

    ValueError when the key is taken, InputError when the mapping stands elsewhere, behind an alias.
    """
    if not isinstance(mapping, Mapping) or document.text[mapping.start] == "*":
        raise InputError.at(mapping.place, "there is nothing here that an entry could be added to", "write it out")
    added = Document.parse(lines).root
    if not isinstance(added, Mapping):
        raise ValueError(f"expected an entry 'key: ...', got {added.describe()}")
    taken = set(added.entries) & set(mapping.entries)
    if taken:
        raise ValueError(f"'{', '.join(taken)}' stands there already, in line {mapping.place.line} and below")
    edit = _flow_edit if is_flow(document, mapping) else _block_edit
    return apply_edits(document.text, [edit(document.text, mapping, lines)])


def remove_entry(document: Document, mapping: Mapping, key: str) -> str:
    """The text of a document without an entry of one of its mappings, and without the comments inside it."""
    text, start, end = document.text, mapping.keys[key].start, mapping.entries[key].end
    if is_flow(document, mapping):
        names = list(mapping.entries)
        place = names.index(key)
        if place + 1 < len(names):
            return apply_edits(text, [Edit(start, mapping.keys[names[place + 1]].start, "")])
        return apply_edits(text, [Edit(mapping.entries[names[place - 1]].end if place else start, end, "")])
    column = mapping.keys[key].place.column or 1
    end = _end_of_entry(text, end, column)
    return apply_edits(text, [Edit(start - column + 1, min(end + 1, len(text)), "")])


def is_flow(document: Document, mapping: Mapping) -> bool:
    """Whether a mapping is written in braces."""
    first = next(iter(mapping.keys.values()), None)
    return first is None or "{" in document.text[mapping.start : first.start]


def flow_text(node: Node, text: str) -> str:
    """A part of a text on one line, in brackets and braces; its comments are left out."""
    if isinstance(node, Mapping):
        entries = (f"{key}: {flow_text(inner, text)}" for key, inner in node.entries.items())
        return f"{{{', '.join(entries)}}}"
    if isinstance(node, Sequence):
        return f"[{', '.join(flow_text(item, text) for item in node.items)}]"
    assert isinstance(node, Scalar)
    return plain_or_quoted(node.written) if isinstance(node.value, str) else text[node.start : node.end]


def plain_or_quoted(text: str) -> str:
    """A text as it may stand anywhere in YAML: plain where it reads back as itself, else in quotes."""
    try:
        found = Document.parse(f"{{key: {text}}}").root
    except InputError:
        return json.dumps(text, ensure_ascii=False)
    node = found.entries.get("key") if isinstance(found, Mapping) and len(found.entries) == 1 else None
    same = isinstance(node, Scalar) and node.written == text and node.value is not None
    return text if same else json.dumps(text, ensure_ascii=False)


def indented(lines: str, column: int) -> str:
    """Lines moved to a column, counted from 1."""
    return "\n".join(f"{' ' * (column - 1)}{line}".rstrip() for line in lines.strip("\n").split("\n"))


def _flow_edit(text: str, mapping: Mapping, lines: str) -> Edit:
    entry = flow_text(Document.parse(lines).root, lines)[1:-1]
    if not mapping.entries:
        start = text.index("{", mapping.start) + 1
        return Edit(start, start, entry)
    end = list(mapping.entries.values())[-1].end
    return Edit(end, end, f", {entry}")


def _block_edit(text: str, mapping: Mapping, lines: str) -> Edit:
    column = next(iter(mapping.keys.values())).place.column or 1
    end = _end_of_entry(text, list(mapping.entries.values())[-1].end, column)
    return Edit(end, end, "\n" + indented(lines, column))


def _end_of_entry(text: str, end: int, column: int) -> int:
    # comments that stand deeper than the keys belong to the entry above them
    end = end_of_line(text, end)
    while text[end + 1 :].startswith(" " * column) and text[end + 1 : end_of_line(text, end + 1)].lstrip()[:1] == "#":
        end = end_of_line(text, end + 1)
    return end


def end_of_line(text: str, start: int) -> int:
    """Where the line that a character stands in ends, before its line feed."""
    found = text.find("\n", start)
    return len(text) if found < 0 else found
