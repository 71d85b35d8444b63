"""Writing the copies of a repeated branch out, each under its own name, so that one of them can be removed."""

from __future__ import annotations

from dashpot.text.document import Document
from dashpot.text.inserting import Edit, apply_edits, flow_text, is_flow
from dashpot.text.node import Mapping, Node, Scalar, Sequence

OF_A_COPY = ("start", "value", "fixed", "expression")  # may hold one number for each copy


def write_out_copies(text: str, name: str) -> str:
    """The text with ``name_1``, ``name_2`` ... in place of an outermost branch that is repeated, each on one line.

    As it is where no branch of that name is repeated; what holds for all copies, as a scaling, is written to each. For
    a branch with an element: a group is left to the one who wrote it.
    """
    document = Document.parse(text)
    assert isinstance(document.root, Mapping)
    branches = document.root.entries["branches"]
    entry = branches.entries.get(name) if isinstance(branches, Mapping) else None
    count = entry.entries.get("repeat") if isinstance(entry, Mapping) else None
    if not (isinstance(entry, Mapping) and isinstance(count, Scalar) and isinstance(count.value, int)):
        return text
    assert isinstance(branches, Mapping)
    key, each = branches.keys[name], [f"{name}_{k + 1}: {_copy(entry, k, text)}" for k in range(count.value)]
    between = ", " if is_flow(document, branches) else "\n" + " " * ((key.place.column or 1) - 1)
    return apply_edits(text, [Edit(key.start, entry.end, between.join(each))])


def _copy(entry: Mapping, number: int, text: str) -> str:
    """The entry of one copy, in braces."""
    parts = (f"{key}: {_own(node, number, text)}" for key, node in entry.entries.items() if key != "repeat")
    return f"{{{', '.join(parts)}}}"


def _own(node: Node, number: int, text: str) -> str:
    """What a copy has of a parameter: its item of a list of numbers; anything else is the same for all."""
    return _inner(node.items[number] if isinstance(node, Sequence) else node, number, text)


def _inner(node: Node, number: int, text: str) -> str:
    if isinstance(node, Mapping):
        entries = (f"{key}: {_inner(_picked(key, one, number), number, text)}" for key, one in node.entries.items())
        return f"{{{', '.join(entries)}}}"
    if isinstance(node, Sequence):
        items = (one.items[number] if isinstance(one, Sequence) else one for one in node.items)
        return f"[{', '.join(_inner(one, number, text) for one in items)}]"
    return flow_text(node, text)


def _picked(key: str, node: Node, number: int) -> Node:
    nested = isinstance(node, Sequence) and node.items and isinstance(node.items[0], Sequence)
    mine = isinstance(node, Sequence) and (key in OF_A_COPY or (key == "interval" and nested))
    return node.items[number] if isinstance(node, Sequence) and mine else node
