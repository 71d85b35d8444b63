"""Reading the nodes of a network, and which of them a branch connects."""

from __future__ import annotations

import re
from collections.abc import Iterable
from collections.abc import Mapping as MappingType
from typing import get_args

from dashpot.model.network import Ends, Hold, Joint
from dashpot.model.values import Kind, Reading, read_value
from dashpot.text.form import Form, read_items, read_text
from dashpot.text.node import Mapping, Node, Scalar
from dashpot.text.problem import Problem, nearest

HOLDS: tuple[Hold, ...] = get_args(Hold)
WEIGHTS = {"mass": Kind("kg", (1e-9, 1e9), "log", off=True), "added_mass": Kind("kg", (0.0, 1e9), "linear")}
OFFSET = Kind("m", (-10.0, 10.0), "linear")


NAME = re.compile(r"\w[\w+-]*")


def read_joints(form: Form) -> dict[str, Joint]:
    """The nodes under ``nodes:``: ``platform: driven``, ``wheel: {mass: 40 kg}``, ``right: {same_as: left}``.

    A node with mistakes is there nevertheless, so that branches may connect it without another complaint.
    """
    found: dict[str, Joint] = {}
    for name, entry in (form.take("nodes", _entries, None) or {}).items():
        if not NAME.fullmatch(name):
            form.problems.append(
                Problem(
                    entry.place,
                    f"expected a name of letters, digits, '_', '-' and '+', got '{name}'",
                    "rename the node",
                )
            )
        found[name] = _read_joint(name, entry, form, found)
    return found


def _entries(node: Node) -> MappingType[str, Node]:
    if isinstance(node, Mapping) and node.entries:
        return node.entries
    raise ValueError(f"expected named nodes 'name: driven' or 'name: {{mass: 40 kg}}', got {node.describe()}")


def _read_joint(name: str, node: Node, outer: Form, known: MappingType[str, Joint]) -> Joint:
    what = f"the node '{name}'"
    if isinstance(node, Scalar):
        word = node.written
        if word in HOLDS:
            return Joint(name, word, place=node.place)
        Reading(what, outer.problems).complain(
            node.place, f"expected {', '.join(HOLDS)} or '{{mass: ...}}', got '{word}'", nearest(word, HOLDS)
        )
        return Joint(name, "free", place=node.place)
    form = Form(node, outer.problems, what)
    form.text("about", "")
    twin = form.take("same_as", lambda inner: read_known(inner, known, "node"), "")
    hold = form.choice("hold", HOLDS, known[twin].hold if twin else "free")
    reading = Reading(what, outer.problems)
    masses = {
        key: value
        for key, kind in WEIGHTS.items()
        if (weight := form.node(key)) and (value := read_value(weight, kind, reading.named(f"{name}.{key}")))
    }
    form.close()
    if twin and masses:
        form.complain("same_as", f"{what} has masses of its own and those of '{twin}'", "remove one of them")
    shared = known[twin].masses if twin else masses
    return Joint(name, hold, shared, known[twin].numbers if twin else "", form.place)  # type: ignore[arg-type]


def read_known(node: Node, known: Iterable[str], kind: str) -> str:
    """The name of a part that stands above. ValueError for another one."""
    word, names = read_text(node), tuple(known)
    if word not in names:
        raise ValueError(f"there is no {kind} '{word}' above; {nearest(word, names)}".rstrip("; "))
    return word


def read_ends(name: str, form: Form, joints: MappingType[str, Joint]) -> Ends | None:
    """What a branch connects, ``between: [lower, upper]``, and its ``offset``; None in a network without nodes."""
    if not joints:
        for key in ("between", "offset"):
            if form.node(key):
                form.complain(
                    key,
                    f"'{name}' has '{key}', but the network has no nodes",
                    "name them at the top: 'nodes: {platform: driven, body: ground}'",
                )
        return None
    pair = form.take("between", lambda node: _read_pair(node, joints))
    offset = form.node("offset")
    value = read_value(offset, OFFSET, Reading(f"{name}.offset", form.problems)) if offset else None
    return Ends(pair[0], pair[1], value) if pair else None


def _read_pair(node: Node, joints: MappingType[str, Joint]) -> tuple[str, str]:
    words = [read_text(item) for item in read_items(node)]
    if len(words) != 2 or words[0] == words[1]:
        raise ValueError(f"expected two different nodes, the lower one first, got [{', '.join(words)}]")
    for word in words:
        if word not in joints:
            hint = nearest(word, joints) or f"known nodes: {', '.join(joints)}"
            raise ValueError(f"there is no node '{word}'; {hint}")
    return words[0], words[1]
