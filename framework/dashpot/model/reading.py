"""From the text of a network to its declaration; all mistakes of a file are told at once."""

from __future__ import annotations

from collections.abc import Mapping as MappingType
from dataclasses import replace
from pathlib import Path

from dashpot.model.element import Element
from dashpot.model.network import Branch, Characteristic, Group, NetworkSpec, Value
from dashpot.model.shipped import find_network
from dashpot.model.values import FACTOR, Kind, kind_of, read_curve, read_value
from dashpot.text.document import Document
from dashpot.text.form import Form
from dashpot.text.problem import InputError, Problem, nearest

FORMAT = "dashpot-network/1"
MEASUREMENT = {
    "force.delay": Kind("s", (-0.1, 0.1), "linear"),
    "force.gain": Kind("1", (0.2, 5.0), "linear"),
    "force.offset": Kind("N", (-1e6, 1e6), "linear"),
}
MAXIMUM_DEPTH = 8
MAXIMUM_COPIES = 100

Elements = MappingType[str, type[Element]]


def read_network(path_or_name: str | Path, elements: Elements) -> NetworkSpec:
    """The network in a file, or the shipped one of that name. Raises InputError with every mistake of the file."""
    return build_network(Document.read(find_network(path_or_name)), elements)


def parse_network(text: str, elements: Elements, file: str | None = None) -> NetworkSpec:
    """The network in a text. Raises InputError with every mistake of the text."""
    return build_network(Document.parse(text, file), elements)


def build_network(document: Document, elements: Elements, depth: int = 0) -> NetworkSpec:
    """The network in a document. Raises InputError with every mistake."""
    problems: list[Problem] = []
    form = Form(document.root, problems, "the network")
    form.choice("format", (FORMAT,))
    name = form.text("name")
    about, source = form.text("about", ""), form.text("source", "")
    reader = _Reader(elements, problems, depth)
    members = reader.members(form, "branches")
    measurement = _read_measurement(form, problems)
    _skip_record(form)
    form.close()
    if not problems and not members:
        form.complain("branches", "the network has no branch", "add a branch, e.g. 'stiffness: {element: spring, ...}'")
    if any(problem.severity == "error" for problem in problems):
        raise InputError(problems)
    return NetworkSpec(name, Group("", "parallel", tuple(members)), measurement, about, source, document)


def _skip_record(form: Form) -> None:
    # where the numbers of an identified model came from: written for people, read by nobody
    form.node("identified")


def _read_measurement(form: Form, problems: list[Problem]) -> dict[str, Value]:
    outer = form.form("measurement", default=None)
    inner = outer.form("force", default=None) if outer else None
    found = {}
    for path, kind in MEASUREMENT.items():
        key = path.partition(".")[2]
        node = inner.node(key) if inner else None
        value = read_value(node, kind, problems, f"measurement, {path}") if node else None
        if value:
            found[path] = value
    for part in (outer, inner):
        if part:
            part.close()
    return found


class _Reader:
    """Reads branches; holds what every branch needs."""

    def __init__(self, elements: Elements, problems: list[Problem], depth: int) -> None:
        self.elements, self.problems, self.depth = elements, problems, depth

    def members(self, form: Form, key: str) -> list[Branch | Group]:
        named = form.named(key, default={} if key != "branches" else None) or {}
        return [member for name, entry in named.items() for member in self.branch(name, entry)]

    def branch(self, name: str, form: Form) -> list[Branch | Group]:
        """The branch, or its copies when it is repeated."""
        copies = form.integer("repeat", 1) or 1
        if not 1 <= copies <= MAXIMUM_COPIES:
            form.complain("repeat", f"expected 1 to {MAXIMUM_COPIES} copies, got {copies}")
            copies = 1
        first = len(self.problems)
        found = []
        for copy in range(copies):
            title = name if copies == 1 else f"{name}_{copy + 1}"
            member = self.single(title, form, copy)
            if member:
                found.append(member)
            if len(self.problems) > first:
                break
        return found

    def single(self, name: str, form: Form, copy: int) -> Branch | Group | None:
        form.text("about", "")
        for kind in ("series", "parallel"):
            if kind in form:
                return self.group(name, form, kind)
        if "use" in form:
            return self.used(name, form)
        return self.element(name, form, copy)

    def group(self, name: str, form: Form, kind: str) -> Group:
        members = self.members(form, kind)
        form.close()
        return Group(name, kind, tuple(_prefixed(member, name) for member in members), form.place)

    def used(self, name: str, form: Form) -> Group | None:
        other = form.text("use")
        form.close()
        if self.depth >= MAXIMUM_DEPTH:
            form.complain("use", f"networks use each other more than {MAXIMUM_DEPTH} deep", "does one use itself?")
            return None
        try:
            inner = build_network(Document.read(find_network(other)), self.elements, self.depth + 1)
        except InputError as error:
            form.complain("use", f"the network '{other}' cannot be used: {error.problems[0]}")
            return None
        return Group(name, "parallel", tuple(_prefixed(member, name) for member in inner.root.members), form.place)

    def element(self, name: str, form: Form, copy: int) -> Branch | None:
        word = form.text("element")
        law = self.elements.get(word)
        if law is None:
            if word:
                form.complain("element", f"there is no element '{word}'", nearest(word, self.elements)
                              or f"known elements: {', '.join(sorted(self.elements))}")  # fmt: skip
            return None
        values = self.values(name, law, form, copy)
        curves = {key: self.curve(f"{name}.{key}", form, key, curve, copy)
                  for key, curve in law.declares.curves.items()}  # fmt: skip
        scale = self.curve(f"{name}.scale", form, "scale", FACTOR, copy, required=False)
        form.close()
        return Branch(name, law, values, {key: c for key, c in curves.items() if c}, scale, form.place)

    def values(self, name: str, law: type[Element], form: Form, copy: int) -> dict[str, Value]:
        found = {}
        for key, parameter in law.declares.parameters.items():
            node = form.node(key)
            if node is None:
                if parameter.default is None:
                    form.complain(None, f"'{name}' lacks '{key}' ({parameter.about}, {parameter.unit})",
                                  f"add '{key}: ...'")  # fmt: skip
                continue
            value = self.guarded(lambda: read_value(node, kind_of(parameter), self.problems, f"{name}.{key}", copy), form, key)  # noqa: B023, E501
            if value:
                found[key] = value
        return found

    def curve(self, path: str, form: Form, key: str, curve, copy: int, required: bool = True) -> Characteristic | None:  # noqa: ANN001, E501
        node = form.node(key)
        if node is None:
            if required:
                form.complain(None, f"'{path.partition('.')[0]}' lacks '{key}' ({curve.about})", f"add '{key}: ...'")
            return None
        return self.guarded(lambda: read_curve(node, curve, self.problems, path, copy), form, key)

    def guarded(self, read, form: Form, key: str):  # noqa: ANN001, ANN201
        try:
            return read()
        except ValueError as error:
            form.complain(key, f"{form.what}, '{key}': {error}")
            return None


def _prefixed(member: Branch | Group, prefix: str) -> Branch | Group:
    name = f"{prefix}.{member.name}"
    if isinstance(member, Group):
        return replace(member, name=name, members=tuple(_prefixed(inner, prefix) for inner in member.members))
    return replace(member, name=name)
