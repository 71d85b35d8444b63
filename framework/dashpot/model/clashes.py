"""What is wrong with a network although each of its branches is right."""

from __future__ import annotations

from collections.abc import Iterator

from dashpot.model.network import Branch, NetworkSpec, Value
from dashpot.text.node import Mapping, Node
from dashpot.text.problem import Place, Problem


def find_clashes(spec: NetworkSpec) -> Iterator[Problem]:
    """Branches of one name, several curves from the same data, searched numbers in two places at once."""
    yield from _equal_names(spec.leaves())
    yield from _curves_from_the_same_data(spec)
    yield from _shared_numbers(spec)


def _equal_names(leaves: tuple[Branch, ...]) -> Iterator[Problem]:
    first: dict[str, Branch] = {}
    for branch in leaves:
        if branch.name in first:
            place = first[branch.name].place
            yield Problem(branch.place, f"a second branch is called '{branch.name}', the first one stands in {place}",
                          "rename one; the copies of a repeated branch are called <name>_1, <name>_2 ...")  # fmt: skip
        first.setdefault(branch.name, branch)


def _curves_from_the_same_data(spec: NetworkSpec) -> Iterator[Problem]:
    seen: dict[str, str] = {}
    for path, curve in spec.data_curves().items():
        if curve.data in seen:
            place = curve.node.place if curve.node else Place()
            message = f"'{path}' and '{seen[curve.data]}' both come from {curve.data} data: the force would count twice"
            yield Problem(place, message, "write a number or a table for one of them")
        seen.setdefault(curve.data, path)


def _shared_numbers(spec: NetworkSpec) -> Iterator[Problem]:
    # an alias shows one number in two places; the copies of a repeated branch share theirs on purpose
    homes: dict[int, tuple[str, Node]] = {}
    families = {branch.name: branch.family for branch in spec.leaves()}
    for slot in spec.slots():
        number, node = _number_of(slot.value), slot.value.node
        if number is None or node is None:
            continue
        name, _, key = slot.path.partition("[")[0].rpartition(".")
        home = f"{families.get(name, name)}.{key}"
        known, first = homes.setdefault(id(number), (home, node))
        if known != home or first is not node:
            yield Problem(node.place, f"'{slot.path}' is an alias of '{known}', a number that is to be identified",
                          "write it out: an alias does not tie two numbers together")  # fmt: skip


def _number_of(value: Value) -> Node | None:
    if not value.searched or not isinstance(value.node, Mapping):
        return None
    return value.node.entries.get("value", value.node.entries.get("start"))
