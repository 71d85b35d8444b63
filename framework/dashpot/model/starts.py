"""Starts that were computed, moved to where elements admit them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress

from dashpot.model.element import Element
from dashpot.text.document import Document
from dashpot.text.form import read_items, read_quantity
from dashpot.text.inserting import Edit, apply_edits
from dashpot.text.node import Mapping as MappingNode
from dashpot.text.node import Node, Scalar

GROUPS = ("branches", "series", "parallel")


def starts_within_bounds(document: Document, elements: Mapping[str, type[Element]]) -> str:
    """The text of a network in which every ``start`` of a number of an element is within its bounds.

    One outside begins at the nearer end: of the bounds that the text gives, else of those of the element. What cannot
    be read stays as it is.
    """
    edits = [edit for branch in _elements_of(document.root) for edit in _moved(branch, elements)]
    return apply_edits(document.text, edits) if edits else document.text


def _elements_of(node: Node) -> Iterator[MappingNode]:
    """All branches of one element below a node."""
    if not isinstance(node, MappingNode):
        return
    if "element" in node.entries:
        yield node
    for members in (node.entries.get(key) for key in GROUPS):
        if isinstance(members, MappingNode):
            for member in members.entries.values():
                yield from _elements_of(member)


def _moved(branch: MappingNode, elements: Mapping[str, type[Element]]) -> Iterator[Edit]:
    word = branch.entries["element"]
    law = elements.get(str(word.value)) if isinstance(word, Scalar) else None
    if law is None:
        return
    kinds = {key: (one.unit, one.bounds) for key, one in law.declares.parameters.items()}
    kinds |= {key: (one.slope_unit, one.bounds) for key, one in law.declares.curves.items()}
    for key, node in branch.entries.items():
        if key in kinds and isinstance(node, MappingNode):
            with suppress(ValueError):
                yield from _moved_start(node, *kinds[key])


def _moved_start(node: MappingNode, unit: str, bounds: tuple[float, float]) -> Iterator[Edit]:
    start, (low, high) = node.entries.get("start"), bounds
    if start is None:
        return
    if "bounds" in node.entries:
        low, high = (read_quantity(end, unit) for end in read_items(node.entries["bounds"]))
    number = read_quantity(start, unit)
    inside = min(max(number, low), high)
    if inside != number:
        yield Edit(start.start, start.end, f"{inside:.17g}" if unit == "1" else f"{inside:.17g} {unit}")
