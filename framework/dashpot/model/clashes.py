"""What is wrong with a network although each of its branches is right."""

from __future__ import annotations

from collections.abc import Iterator

from dashpot.model.network import Branch, Group, NetworkSpec, Value
from dashpot.text.node import Mapping, Node
from dashpot.text.problem import Place, Problem


def find_clashes(spec: NetworkSpec) -> Iterator[Problem]:
    """Parts of one name, curves that cannot come from data, free parameters in two places at once."""
    yield from _equal_names(spec.leaves())
    yield from _equal_paths(spec)
    yield from _curves_without_a_loop(spec)
    yield from _curves_from_the_same_data(spec)
    yield from _shared_numbers(spec)


def _equal_names(leaves: tuple[Branch, ...]) -> Iterator[Problem]:
    first: dict[str, Branch] = {}
    for branch in leaves:
        if branch.name in first:
            place = first[branch.name].place
            yield Problem(
                branch.place,
                f"a second branch is called '{branch.name}', the first one stands in {place}",
                "rename one; the copies of a repeated branch are called <name>_1, <name>_2 ...",
            )
        first.setdefault(branch.name, branch)


def _equal_paths(spec: NetworkSpec) -> Iterator[Problem]:
    seen: set[str] = set()
    branches = {branch.name for branch in spec.leaves()}
    for slot in spec.slots():
        name, place = slot.path.rpartition(".")[0], slot.value.node.place if slot.value.node else Place()
        if slot.path in seen and name not in _doubled(spec):
            yield Problem(
                place,
                f"two parameters are called '{slot.path}'",
                f"rename the {'branch' if name in branches else 'node'} '{name}'",
            )
        seen.add(slot.path)


def _doubled(spec: NetworkSpec) -> set[str]:
    names = [branch.name for branch in spec.leaves()]
    return {name for name in names if names.count(name) > 1}


def _curves_without_a_loop(spec: NetworkSpec) -> Iterator[Problem]:
    # a slow loop is one force over one deflection: it is the curve of what lies between the two ends, of nothing else
    inside = {branch.name for group in _series(spec.root) for branch in group.leaves()}
    for path, curve in spec.data_curves().items():
        place = curve.node.place if curve.node else Place()
        if spec.joints:
            yield Problem(
                place,
                f"'{path}' cannot come from {curve.data} data in a network with nodes: the loop of "
                "the whole is not the curve of a part",
                "write a table; or fit the part by itself, on runs of its own, and write "
                "'use: fitted.yaml, fixed: true'",
            )
        elif path.rpartition(".")[0] in inside:
            yield Problem(
                place,
                f"'{path}' cannot come from {curve.data} data inside a series connection: it sees a "
                "part of the deflection only",
                "write a number or a table",
            )


def _series(group: Group) -> Iterator[Group]:
    for member in group.members:
        if isinstance(member, Group):
            if member.kind == "series":
                yield member
            else:
                yield from _series(member)


def _curves_from_the_same_data(spec: NetworkSpec) -> Iterator[Problem]:
    seen: dict[str, str] = {}
    if spec.joints:
        return
    for path, curve in spec.data_curves().items():
        if curve.data in seen:
            place = curve.node.place if curve.node else Place()
            message = f"'{path}' and '{seen[curve.data]}' both come from {curve.data} data: the force would count twice"
            yield Problem(place, message, "write a number or a table for one of them")
        seen.setdefault(curve.data, path)


def _shared_numbers(spec: NetworkSpec) -> Iterator[Problem]:
    # an alias shows one number in two places; the copies of a repeated branch share theirs on purpose, and so do
    # networks that are used twice, which are looked at by themselves
    homes: dict[int, tuple[str, Node]] = {}
    families = {branch.name: branch.family for branch in spec.leaves()}
    for slot in spec.slots():
        number, node = _number_of(slot.value), slot.value.node
        if number is None or node is None or (spec.document and node.place.file != spec.document.file):
            continue
        name, _, key = slot.path.partition("[")[0].rpartition(".")
        if slot.of and name not in families:
            name, _, inner = name.rpartition(".")
            key = f"{inner}.{key}"
        home = f"{families.get(name, name)}.{key}"
        known, first = homes.setdefault(id(number), (home, node))
        if known != home or first is not node:
            yield Problem(
                node.place,
                f"'{slot.path}' is an alias of '{known}', a parameter to be identified",
                "write it out: an alias does not tie two parameters together",
            )


def _number_of(value: Value) -> Node | None:
    if not value.searched or not isinstance(value.node, Mapping):
        return None
    return value.node.entries.get("value", value.node.entries.get("start"))
