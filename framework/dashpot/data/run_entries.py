"""Editing the text of a dataset: entries of single runs and of its head; comments and layout stay as they are."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from dashpot.data.declaration import stem_of
from dashpot.text.document import Document
from dashpot.text.inserting import Edit, add_entry, apply_edits, end_of_line, flow_text, is_flow, plain_or_quoted
from dashpot.text.node import Mapping, Node, Scalar
from dashpot.text.node import Sequence as SequenceNode


def list_runs(document: Document, name: str, file: str | None) -> str:
    """The text with its runs under `runs:`, each with its file, and with its `name`; aliases are written out.

    `file` is the measured file that the text stands beside, where it is such a one. A text that is the only run itself
    is written anew, without its comments.
    """
    root = document.root
    assert isinstance(root, Mapping)
    if "runs" in root.entries:
        text = _without_aliases(document)
    else:
        assert file is not None
        text = _single_run(document, root, file)
    items = _items(Document.parse(text)) if file else ()
    for order, item in enumerate(items):
        if isinstance(item, Mapping) and "file" not in item.entries:
            text = with_entry(text, order, ("file",), plain_or_quoted(file or ""))
    return text if "name" in root.entries else with_head(text, "name", name)


def with_head(text: str, key: str, value: str) -> str:
    """The text with an entry at its top, behind the first one; one of that key is replaced."""
    document = Document.parse(text)
    root, written = document.root, plain_or_quoted(value)
    assert isinstance(root, Mapping)
    if key in root.entries:
        node = root.entries[key]
        return apply_edits(text, [Edit(node.start, node.end, written)])
    if is_flow(document, root):
        return add_entry(document, root, f"{key}: {written}")
    first = next(iter(root.keys.values()))
    end = end_of_line(text, root.entries["format"].end)
    return apply_edits(text, [Edit(end, end, f"\n{' ' * ((first.place.column or 1) - 1)}{key}: {written}")])


def with_entry(text: str, order: int, keys: Sequence[str], value: str, column: str | int | None = None) -> str:
    """The text whose run number `order` has `value` under nested `keys`, as its own and not by the defaults.

    `column` is given for a key of a channel, which may be written as its column alone, at the run or in the defaults.
    """
    document = Document.parse(text)
    node = _items(document)[order]
    for depth, key in enumerate(keys):
        if not isinstance(node, Mapping):
            assert column is not None
            return apply_edits(text, [Edit(node.start, node.end, _nested(keys[depth:], value, column))])
        if key not in node.entries:
            below = _nested(keys[depth + 1 :], value, _short(document, keys[:-1], column))
            return add_entry(document, node, f"{plain_or_quoted(key)}: {below}")
        node = node.entries[key]
    return apply_edits(text, [Edit(node.start, node.end, value)])


def _nested(keys: Sequence[str], value: str, column: str | int | None) -> str:
    for depth, key in enumerate(reversed(keys)):
        # the innermost mapping is the channel
        first = f"column: {_column(column)}, " if column is not None and depth == 0 else ""
        value = f"{{{first}{plain_or_quoted(key)}: {value}}}"
    return value


def _column(column: str | int) -> str:
    return str(column) if isinstance(column, int) else plain_or_quoted(column)


def _short(document: Document, keys: Sequence[str], column: str | int | None) -> str | int | None:
    """The column of a channel that stands as nothing else in the defaults; what is added to it has to repeat it."""
    assert isinstance(document.root, Mapping)
    node: Node | None = document.root.entries.get("defaults")
    for key in keys:
        node = node.entries.get(key) if isinstance(node, Mapping) else None
    return None if node is None or isinstance(node, Mapping) else column


def _items(document: Document) -> tuple[Node, ...]:
    assert isinstance(document.root, Mapping)
    runs = document.root.entries["runs"]
    assert isinstance(runs, SequenceNode)
    return runs.items


def _single_run(document: Document, root: Mapping, file: str) -> str:
    head = [key for key in ("format", "folder") if key in root.entries]
    own = [key for key in root.entries if key not in ("format", "folder", "name", "file")]
    stated = root.entries.get("file")
    file = stated.written if isinstance(stated, Scalar) else file
    name = flow_text(root.entries["name"], document.text) if "name" in root.entries else plain_or_quoted(stem_of(file))
    lines = [f"{key}: {flow_text(root.entries[key], document.text)}" for key in head]
    lines += [f"name: {name}", "runs:", f"  - name: {name}", f"    file: {plain_or_quoted(file)}"]
    lines += [f"    {plain_or_quoted(key)}: {flow_text(root.entries[key], document.text)}" for key in own]
    return "\n".join(lines) + "\n"


def _without_aliases(document: Document) -> str:
    """An anchor may be edited when nothing refers to it any more."""
    return apply_edits(
        document.text,
        [Edit(node.start, node.end, flow_text(node, document.text)) for node in _aliases(document.root, document.text)],
    )


def _aliases(node: Node, text: str) -> Iterator[Node]:
    if text[node.start : node.start + 1] == "*":
        yield node
    elif isinstance(node, Mapping):
        for inner in node.entries.values():
            yield from _aliases(inner, text)
    elif isinstance(node, SequenceNode):
        for inner in node.items:
            yield from _aliases(inner, text)
