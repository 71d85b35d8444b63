"""Writing the networks that a network uses into its own text, so that their numbers can be changed there."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from dashpot.model.network import NetworkSpec
from dashpot.model.reading import build_network
from dashpot.model.shipped import SUFFIXES, find_used_network
from dashpot.text.document import Document
from dashpot.text.inserting import Edit, apply_edits, flow_text, indented, is_flow, plain_or_quoted
from dashpot.text.node import Mapping, Node, Scalar

GROUPS = ("branches", "series", "parallel")


def write_out_uses(spec: NetworkSpec) -> tuple[Document, NetworkSpec]:
    """The same network, and its text, with ``parallel:`` and all branches instead of ``use:``.

    A network whose free parameters and curves from data all stand in its own text stays as it is, and so does a
    network that is used with ``fixed: true``. ValueError for one that was not read from a text.
    """
    document = Document.parse(spec.text, spec.file)
    curves = [curve.node for curve in spec.data_curves().values()]
    nodes = [*(slot.value.node for slot in spec.slots() if slot.value.searched), *curves]
    if all(node is None or node.place.file == document.file for node in nodes):
        return document, spec
    elements = {branch.element.word: branch.element for branch in spec.leaves()}
    home = _folder(document)
    document = Document.parse(_written_out(document, home), document.file)
    return document, build_network(document, elements)


def _folder(document: Document) -> Path:
    return Path(document.file).resolve().parent if document.file else Path.cwd()


def _written_out(document: Document, home: Path) -> str:
    return apply_edits(document.text, _edits(document, document.root, home))


def _edits(document: Document, node: Node, home: Path) -> Iterator[Edit]:
    members = [node.entries[key] for key in GROUPS if key in node.entries] if isinstance(node, Mapping) else []
    for branch in members[0].entries.values() if members and isinstance(members[0], Mapping) else ():
        if isinstance(branch, Mapping) and "use" in branch.entries:
            fixed = branch.entries.get("fixed")
            stays = isinstance(fixed, Scalar) and fixed.value is True
            yield from _moved(document, branch, home) if stays else [_edit(document, branch, home)]
        else:
            yield from _edits(document, branch, home)


def _moved(document: Document, branch: Mapping, home: Path) -> Iterator[Edit]:
    word = branch.entries["use"]
    assert isinstance(word, Scalar)
    if Path(word.written).suffix in SUFFIXES and _folder(document) != home:
        file = find_used_network(word.written, _folder(document)).resolve()
        yield Edit(word.start, word.end, plain_or_quoted(file.relative_to(home).as_posix()))


def _edit(document: Document, branch: Mapping, home: Path) -> Edit:
    key, word = branch.keys["use"], branch.entries["use"]
    assert isinstance(word, Scalar)
    used = Document.read(find_used_network(word.written, _folder(document)))
    inner = Document.parse(_written_out(used, home), used.file)
    assert isinstance(inner.root, Mapping)
    branches = inner.root.entries["branches"]
    assert isinstance(branches, Mapping)
    if is_flow(document, branch) or is_flow(inner, branches):
        return Edit(key.start, word.end, f"parallel: {flow_text(branches, inner.text)}")
    lines = _unindented(inner.text[branches.start : branches.end], branches.place.column or 1)
    return Edit(key.start, word.end, "parallel:\n" + indented(lines, (key.place.column or 1) + 2))


def _unindented(lines: str, column: int) -> str:
    first, *others = lines.split("\n")
    return "\n".join([first, *(line[column - 1 :] if not line[: column - 1].strip() else line for line in others)])
