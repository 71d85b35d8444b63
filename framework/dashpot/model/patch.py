"""Editing the text of a network: numbers filled in, branches added; comments and layout stay as they are."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from dashpot.model.copies import write_out_copies
from dashpot.model.identified import Range, range_text
from dashpot.model.network import Characteristic, NetworkSpec, Value
from dashpot.model.written_out import write_out_uses
from dashpot.text.document import Document
from dashpot.text.inserting import (
    Edit,
    add_entry,
    apply_edits,
    end_of_line,
    indented,
    is_flow,
    plain_or_quoted,
    remove_entry,
    replace_entry,
)
from dashpot.text.node import Mapping as MappingNode
from dashpot.text.node import Node, Scalar
from dashpot.text.problem import InputError, Place, nearest
from dashpot.text.quantity import pretty, pretty_all, pretty_in, shown_unit

DIGITS = 8
INTERVAL_DIGITS = (4, 8, 17)  # as many as tell its two ends apart


def fill_numbers(spec: NetworkSpec, fitted: NetworkSpec, record: Mapping[str, str], seen: Range | None = None) -> str:
    """The text of ``spec`` with the parameters of ``fitted``: ``start`` becomes ``value``, with its interval.

    ``fitted`` is the same network with other values; curves from data become tables, and a network that is used and
    has free parameters is written out. ``record`` is written at the end under ``identified:`` and says where the
    numbers came from, and with it the range of the motions that were ``seen``. ValueError for a network that was not
    read from a text.
    """
    document, spec = write_out_uses(spec)
    edits = [_curve_edit(curve, fitted.curves()[path]) for path, curve in spec.data_curves().items()]
    for old, new in _pair_up(spec, fitted):
        edits += _number_edits(document, old, new)
    entries = [f"{key}: {plain_or_quoted(value)}" for key, value in record.items()]
    entries += [f"range: {range_text(seen)}"] if seen else []
    return _with_record(apply_edits(document.text, edits), entries, document.file)


def add_branch(text: str, lines: str) -> str:
    """The text with a branch, given as unindented lines ``name:`` ..., at the end of ``branches:``.

    ValueError when there is a branch of that name.
    """
    document = Document.parse(text)
    home = _mapping(document.root).entries.get("branches")
    if isinstance(home, Scalar) and home.value is None:
        return apply_edits(text, [Edit(home.end, home.end, "\n" + indented(lines, 3))])
    return add_entry(document, _mapping(document.root, "branches"), lines)


def remove_branch(text: str, branch: str) -> str:
    """The text without a branch; ``group.branch`` is one inside a group. Raises InputError when there is none.

    Without ``name_2``, the second copy of an outermost branch that is repeated, the others are written out.
    """
    family, _, copy = branch.rpartition("_")
    if copy.isdecimal() and branch not in branch_names(text):
        text = write_out_copies(text, family)
    document = Document.parse(text)
    home, _, name = branch.rpartition(".")
    _branch_node(document, branch)
    members = _members(_branch_node(document, home) if home else document.root)
    assert members is not None
    return remove_entry(document, members, name)


def set_entry(text: str, part: str, key: str, entry: str) -> str:
    """The text with ``key: entry`` at a branch, ``group.branch`` inside a group, or at a node; it may be there already.

    Raises InputError when there is no such branch or node, or where it is written as one word.
    """
    document = Document.parse(text)
    nodes = _mapping(document.root, "nodes").entries if _has(document.root, "nodes") else {}
    home = nodes.get(part) or _branch_node(document, part)
    if _has(home, key):
        return apply_edits(text, [replace_entry(_mapping(home), key, entry)])
    return add_entry(document, home, f"{key}: {entry}")


def branch_names(text: str) -> tuple[str, ...]:
    """The names of the outermost branches, in the order of the text."""
    return tuple(_mapping(Document.parse(text).root, "branches").entries)


def add_to_branch(text: str, branch: str, lines: str) -> str:
    """The text with an entry, given as unindented lines, added to a branch; ``group.branch`` is one inside a group.

    Raises InputError when there is no such branch, ValueError when it has that entry already.
    """
    document = Document.parse(text)
    return add_entry(document, _branch_node(document, branch), lines)


def make_dependent(text: str, branch: str, key: str, over: str) -> str:
    """The text in which the number ``key`` of a branch depends on a setting: ``{over}`` is written with it.

    A plain number becomes ``{fixed: ..., over: {...}}``. Raises InputError when there is no such number, and for one
    that depends on a setting already or is given in another way.
    """
    document = Document.parse(text)
    home = _branch_node(document, branch)
    if not _has(home, key):
        raise InputError.at(home.place, f"the branch '{branch}' has no '{key}'", "`dashpot check` tells more")
    node = _mapping(home).entries[key]
    if isinstance(node, Scalar):
        plain = document.text[node.start : node.end]
        return apply_edits(text, [Edit(node.start, node.end, f"{{fixed: {plain}, over: {{{over}}}}}")])
    if not (_has(node, "start") or _has(node, "value")) or _has(node, "over"):
        raise InputError.at(node.place, f"expected a number of '{branch}' without 'over', got {node.describe()}")
    return add_entry(document, node, f"over: {{{over}}}")


def replace_branch(text: str, branch: str, entry: str) -> str:
    """The text with another branch, ``{element: ...}`` on one line, under the name of one that is there.

    Raises InputError when there is no such branch.
    """
    document = Document.parse(text)
    node = _branch_node(document, branch)
    return apply_edits(text, [Edit(node.start, node.end, entry)])


def _branch_node(document: Document, branch: str) -> Node:
    node: Node = document.root
    for name in branch.split("."):
        members = _members(node)
        if members is None or name not in members.entries:
            hint = nearest(name, members.entries) if members else ""
            raise InputError.at(Place(document.file), f"the network has no branch '{branch}'", hint)
        node = members.entries[name]
    return node


def _members(node: Node) -> MappingNode | None:
    return next((_mapping(node, key) for key in ("branches", "series", "parallel") if _has(node, key)), None)


def use_in_branch(text: str, branch: str, word: str) -> str:
    """The text with another network used by a branch. Raises InputError where the branch uses none."""
    document = Document.parse(text)
    branches = _mapping(document.root, "branches")
    node = branches.entries.get(branch)
    if node is None or not _has(node, "use"):
        users = [name for name, entry in branches.entries.items() if _has(entry, "use")]
        raise InputError.at(
            Place(document.file),
            f"no branch '{branch}' uses another network",
            nearest(branch, users) or f"those that do: {', '.join(users) or 'none'}",
        )
    return apply_edits(text, [replace_entry(_mapping(node), "use", plain_or_quoted(word))])


def add_measurement(text: str, key: str, entry: str) -> str:
    """The text with ``key: entry`` under ``measurement: force:``; an entry of that key is replaced.

    The key is one of ``gain``, ``offset``, ``delay``, ``lag``, ``least``, ``largest``, ``compliance`` and ``hum``; the
    entry of the last one is a mapping, ``{frequency: 50 Hz, cosine: {start: 1 N}, sine: {start: 0 N}}``.
    """
    document = Document.parse(text)
    if not _has(document.root, "measurement"):
        return add_entry(document, document.root, f"measurement:\n  force:\n    {key}: {entry}")
    measurement = _mapping(document.root, "measurement")
    if "force" not in measurement.entries:
        return add_entry(document, measurement, f"force:\n  {key}: {entry}")
    force = _mapping(measurement, "force")
    if key in force.entries:
        return apply_edits(text, [replace_entry(force, key, entry)])
    return add_entry(document, force, f"{key}: {entry}")


def remove_measurement(text: str, key: str) -> str:
    """The text without an entry of that key under ``measurement: force:``, and without what is empty then.

    As it is where there is none.
    """
    document = Document.parse(text)
    if not (_has(document.root, "measurement") and _has(_mapping(document.root, "measurement"), "force")):
        return text
    root, measurement = _mapping(document.root), _mapping(document.root, "measurement")
    force = _mapping(measurement, "force")
    if key not in force.entries:
        return text
    if len(force.entries) > 1:
        return remove_entry(document, force, key)
    if len(measurement.entries) > 1:
        return remove_entry(document, measurement, "force")
    return remove_entry(document, root, "measurement")


def rename(text: str, name: str, comment: Iterable[str]) -> str:
    """The text with another ``name:`` and comment lines at its head."""
    head = "".join(f"# {line}".rstrip() + "\n" for line in comment)
    edit = replace_entry(_mapping(Document.parse(text).root), "name", plain_or_quoted(name))
    return head + apply_edits(text, [edit])


def _pair_up(spec: NetworkSpec, fitted: NetworkSpec) -> Iterable[tuple[list[Value], list[Value]]]:
    # several numbers stand in one place: the copies of a repeated branch, the knots of a table in one entry
    after = {slot.path: slot.value for slot in fitted.slots()}
    tables = set(spec.data_curves())
    shared: dict[int, tuple[list[Value], list[Value]]] = {}
    for slot in spec.slots():
        if slot.value.searched and slot.path.partition("[")[0] not in tables:
            old, new = shared.setdefault(id(slot.value.node), ([], []))
            old.append(slot.value)
            new.append(after[slot.path])
    return shared.values()


def _number_edits(document: Document, old: Sequence[Value], new: Sequence[Value]) -> list[Edit]:
    node = old[0].node
    assert isinstance(node, MappingNode)
    key = "value" if "value" in node.entries else "start"
    number = node.entries[key]
    edits = [
        Edit(node.keys[key].start, node.keys[key].end, "value"),
        Edit(number.start, number.end, _list([pretty(value.number, value.unit, DIGITS) for value in new])),
    ]
    intervals = [value.interval for value in new]
    if None not in intervals:
        text = _list([_pair(value) for value in new])
        edits.append(_interval_edit(document, node, number, text))
    return edits


def _interval_edit(document: Document, node: MappingNode, number: Node, text: str) -> Edit:
    if "interval" in node.entries:
        return replace_entry(node, "interval", text)
    if is_flow(document, node):
        return Edit(number.end, number.end, f", interval: {text}")
    column = next(iter(node.keys.values())).place.column or 1
    return Edit(number.end, number.end, f"\n{' ' * (column - 1)}interval: {text}")


def _curve_edit(curve: Characteristic, found: Characteristic) -> Edit:
    assert curve.node is not None
    (value, unit), (over, over_unit) = curve.curve.value, curve.curve.over
    at = ", ".join(pretty_all(found.at, over_unit, DIGITS))
    values = ", ".join(pretty_all([knot.number for knot in found.values], unit, DIGITS))
    refine = "refine: true, " if found.refine else ""
    text = f"{{from: {curve.data}, {refine}{over}: [{at}], {value}: [{values}]}}"
    return Edit(curve.node.start, curve.node.end, text)


def _with_record(text: str, entries: Sequence[str], file: str | None) -> str:
    document = Document.parse(text, file)
    root = _mapping(document.root)
    known = "identified" in root.entries
    if is_flow(document, root):
        flow = f"{{{', '.join(entries)}}}"
        if known:
            return apply_edits(text, [replace_entry(root, "identified", flow)])
        return add_entry(document, root, f"identified: {flow}")
    if known:
        start, end = root.keys["identified"].start, end_of_line(text, root.entries["identified"].end)
        text = text[:start].rstrip("\n") + "\n" + text[end:].lstrip("\n")
    lines = "".join(f"  {entry}\n" for entry in entries)
    return text.rstrip("\n") + f"\nidentified:                         # where the parameters came from\n{lines}"


def _pair(value: Value) -> str:
    assert value.interval is not None
    shown = shown_unit(value.number, value.unit)
    for digits in INTERVAL_DIGITS:
        low, high = (pretty_in(side, value.unit, shown, digits) for side in value.interval)
        if low != high:
            break
    return f"[{low}, {high}]"


def _list(texts: Sequence[str]) -> str:
    return texts[0] if len(texts) == 1 else f"[{', '.join(texts)}]"


def _has(node: Node, key: str) -> bool:
    return isinstance(node, MappingNode) and key in node.entries


def _mapping(node: Node, *keys: str) -> MappingNode:
    for key in keys:
        node = node.entries[key] if isinstance(node, MappingNode) else node
    if not isinstance(node, MappingNode):
        raise InputError.at(node.place, f"expected a mapping, got {node.describe()}", "`dashpot check` tells more")
    return node
