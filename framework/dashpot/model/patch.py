"""Editing the text of a network: numbers filled in, branches added; comments and layout stay as they are."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from dashpot.model.network import Characteristic, NetworkSpec, Value
from dashpot.text.document import Document
from dashpot.text.node import Mapping as MappingNode
from dashpot.text.quantity import pretty

DIGITS = 8
INTERVAL_DIGITS = 4


@dataclass(frozen=True)
class Edit:
    """Replace ``text[start:end]`` by ``new``."""

    start: int
    end: int
    new: str


def apply_edits(text: str, edits: Iterable[Edit]) -> str:
    """The text after all edits, which must not overlap."""
    for edit in sorted(edits, key=lambda edit: edit.start, reverse=True):
        text = text[: edit.start] + edit.new + text[edit.end :]
    return text


def fill_numbers(spec: NetworkSpec, fitted: NetworkSpec, record: Mapping[str, str]) -> str:
    """The text of ``spec`` with the numbers of ``fitted``: ``start`` becomes ``value``, with its interval.

    ``fitted`` is the same network with other values; curves from data become tables. ``record`` is written at the end
    under ``identified:`` and says where the numbers came from.
    """
    document = spec.document
    before = {slot.path: slot.value for slot in spec.slots()}
    after = {slot.path: slot.value for slot in fitted.slots()}
    edits = [_curve_edit(document, curve, fitted, path) for path, curve in spec.data_curves().items()]
    written = {path for path in spec.data_curves()}
    shared: dict[int, list[tuple[Value, Value]]] = {}
    for path, value in before.items():
        if value.searched and path.partition("[")[0] not in written:
            shared.setdefault(id(value.node), []).append((value, after[path]))
    for pairs in shared.values():
        edits += _number_edits(document, [old for old, _ in pairs], [new for _, new in pairs])
    return _with_record(apply_edits(document.text, edits), document, record)


def add_branch(text: str, lines: str) -> str:
    """The text with a branch, given as unindented lines, added at the end of ``branches:``."""
    document = Document.parse(text)
    branches = document.root.entries["branches"]
    last = list(branches.entries.values())[-1]
    column = next(iter(branches.keys.values())).place.column - 1
    end = text.find("\n", last.end)
    end = len(text) if end < 0 else end
    block = "".join(f"\n{' ' * column}{line}".rstrip() for line in lines.strip("\n").split("\n"))
    return text[:end] + block + text[end:]


def add_to_branch(text: str, branch: str, lines: str) -> str:
    """The text with lines added to the mapping of a branch."""
    document = Document.parse(text)
    node = document.root.entries["branches"].entries[branch]
    if _is_flow(document, node):
        closing = node.end - 1
        inner = ", ".join(line.strip() for line in lines.strip("\n").split("\n"))
        return text[:closing].rstrip() + f", {inner}" + text[closing:]
    column = next(iter(node.keys.values())).place.column - 1
    end = text.find("\n", list(node.entries.values())[-1].end)
    end = len(text) if end < 0 else end
    block = "".join(f"\n{' ' * column}{line}".rstrip() for line in lines.strip("\n").split("\n"))
    return text[:end] + block + text[end:]


def add_measurement(text: str, key: str, entry: str) -> str:
    """The text with ``key: entry`` (of ``delay``, ``gain``, ``offset``) under ``measurement: force:``."""
    document = Document.parse(text)
    present = document.root.entries.get("measurement")
    if present is None:
        return text.rstrip("\n") + f"\nmeasurement:\n  force:\n    {key}: {entry}\n"
    force = present.entries["force"]
    if _is_flow(document, force):
        closing = force.end - 1
        return text[:closing].rstrip() + f", {key}: {entry}" + text[closing:]
    column = next(iter(force.keys.values())).place.column - 1
    last = list(force.entries.values())[-1].end
    return text[:last] + f"\n{' ' * column}{key}: {entry}" + text[last:]


def rename(text: str, name: str, comment: Iterable[str]) -> str:
    """The text with another ``name:`` and comment lines at its head."""
    node = Document.parse(text).root.entries["name"]
    head = "".join(f"# {line}\n" for line in comment)
    return head + text[: node.start] + name + text[node.end :]


def _number_edits(document: Document, old: list[Value], new: list[Value]) -> list[Edit]:
    node = old[0].node
    key = "value" if "value" in node.entries else "start"
    number = node.entries[key]
    edits = [Edit(number.start, number.end, _list([pretty(v.number, v.unit, DIGITS) for v in new]))]
    edits.append(Edit(node.keys[key].start, node.keys[key].end, "value"))
    if all(value.interval for value in new):
        text = _list([_pair(value) for value in new])
        if "interval" in node.entries:
            edits.append(Edit(node.entries["interval"].start, node.entries["interval"].end, text))
        elif _is_flow(document, node):
            edits.append(Edit(number.end, number.end, f", interval: {text}"))
        else:
            column = node.keys[key].place.column - 1
            edits.append(Edit(number.end, number.end, f"\n{' ' * column}interval: {text}"))
    return edits


def _curve_edit(document: Document, curve: Characteristic, fitted: NetworkSpec, path: str) -> Edit:
    name, _, key = path.rpartition(".")
    found = next(branch for branch in fitted.leaves() if branch.name == name).characteristics()[key]
    at = _list([pretty(x, curve.curve.over[1], DIGITS) for x in found.at])
    values = _list([pretty(value.number, curve.curve.value[1], DIGITS) for value in found.values])
    text = f"{{from: {curve.data}, {curve.curve.over[0]}: {at}, {curve.curve.value[0]}: {values}}}"
    return Edit(curve.node.start, curve.node.end, text)


def _with_record(text: str, document: Document, record: Mapping[str, str]) -> str:
    if "identified" in document.root.entries:
        node, key = document.root.entries["identified"], document.root.keys["identified"]
        cut = Document.parse(text).root
        node, key = cut.entries["identified"], cut.keys["identified"]
        text = text[: key.start].rstrip("\n") + "\n" + text[node.end :].lstrip("\n")
    lines = "".join(f"  {key}: {value}\n" for key, value in record.items())
    return text.rstrip("\n") + f"\nidentified:                         # where the numbers came from\n{lines}"


def _pair(value: Value) -> str:
    low, high = value.interval
    return f"[{pretty(low, value.unit, INTERVAL_DIGITS)}, {pretty(high, value.unit, INTERVAL_DIGITS)}]"


def _list(texts: list[str]) -> str:
    return texts[0] if len(texts) == 1 else f"[{', '.join(texts)}]"


def _is_flow(document: Document, node: MappingNode) -> bool:
    return document.text[node.start] == "{"
