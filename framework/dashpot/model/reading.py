"""From the text of a network to its declaration; all mistakes of a file are told at once."""

from __future__ import annotations

from collections.abc import Mapping as MappingType
from dataclasses import dataclass, replace
from pathlib import Path

from dashpot.model.branches import BranchReader
from dashpot.model.clashes import find_clashes
from dashpot.model.element import Element
from dashpot.model.identified import read_identified
from dashpot.model.joints import read_joints
from dashpot.model.nesting import TooDeep
from dashpot.model.network import Group, NetworkSpec, Value
from dashpot.model.shipped import find_network, find_used_network, read_specification
from dashpot.model.topology import COMPLIANCE
from dashpot.model.values import Kind, Reading, read_value
from dashpot.text.document import Document
from dashpot.text.form import Form
from dashpot.text.node import Mapping
from dashpot.text.problem import InputError, Place, Problem

FORMAT = "dashpot-network/1"
MEASUREMENT = {
    "force.delay": Kind("s", (-1e3, 1e3), "linear"),
    "force.gain": Kind("1", (0.2, 5.0), "linear"),
    "force.offset": Kind("N", (-1e9, 1e9), "linear"),
    "force.least": Kind("N", (-1e9, 1e9), "linear"),
    "force.largest": Kind("N", (-1e9, 1e9), "linear"),
    "force.lag": Kind("s", (0.0, 1e3), "linear"),
    COMPLIANCE: Kind("m/N", (0.0, 1.0), "linear"),
    "force.hum.frequency": Kind("Hz", (1e-3, 1e5), "linear"),
    "force.hum.cosine": Kind("N", (-1e9, 1e9), "linear"),
    "force.hum.sine": Kind("N", (-1e9, 1e9), "linear"),
}

# what drifts over a session, or with the temperature of the load cell
DRIFTING = ("force.gain", "force.offset")

Elements = MappingType[str, type[Element]]


def read_network(path_or_name: str | Path, elements: Elements) -> NetworkSpec:
    """The network in a file, or the shipped one of that name. Raises InputError with every mistake of the file."""
    return build_network(read_specification(find_network(path_or_name)), elements)


def parse_network(
    text: str, elements: Elements, file: str | None = None, beside: MappingType[str, Document] | None = None
) -> NetworkSpec:
    """The network in a text. Raises InputError with every mistake of the text.

    ``file`` is its name in messages, and networks that it uses are among those ``beside`` it, by the word for them, or
    lie in the folder of that file.
    """
    return build_network(Document.parse(text, file), elements, beside=beside)


def build_network(
    document: Document, elements: Elements, *, beside: MappingType[str, Document] | None = None
) -> NetworkSpec:
    """The network in a document. Raises InputError with every mistake."""
    return _build(document, _Uses(document.file, elements, (), beside or {}, {}, 0))


def _build(document: Document, uses: _Uses) -> NetworkSpec:
    problems: list[Problem] = []
    form = Form(document.root, problems, "the network")
    form.choice("format", (FORMAT,))
    name = form.name("name")
    about, source = form.text("about", ""), form.text("source", "")
    joints = read_joints(form)
    gravity = form.quantity("gravity", "m/s^2", 0.0)
    if "gravity" in form and "nodes" not in form:
        form.complain("gravity", "gravity pulls at the masses of nodes, but the network has no nodes", "remove it")
    reader = BranchReader(uses.elements, problems, uses.network, joints, uses.depth)
    members = reader.outermost(form)
    measurement = _read_measurement(form, problems)
    identified = read_identified(form)
    form.close()
    if not problems and not members:
        form.complain("branches", "the network has no branch", "add a branch, e.g. 'stiffness: {element: spring, ...}'")
    root = Group("", "parallel", members)
    spec = NetworkSpec(
        name, root, measurement, joints, reader.ends, gravity, about, source, document, identified, tuple(reader.used)
    )
    problems.extend(find_clashes(spec))
    if problems:
        raise InputError(problems)
    # numbers that follow from others are computed when all have been read
    return spec.with_values({})


def _read_measurement(form: Form, problems: list[Problem]) -> dict[str, Value]:
    forms = {"": form.form("measurement", default=None)}
    found = {}
    for path, kind in MEASUREMENT.items():
        inner, _, key = path.rpartition(".")
        within = _form_at(inner, forms)
        node = within.node(key) if within else None
        value = read_value(node, kind, Reading(f"measurement, {path}", problems)) if node else None
        if value and value.over and path not in DRIFTING:
            place = value.node.place if value.node else Place()
            problems.append(
                Problem(
                    place,
                    f"measurement, {path}: of the load cell only gain and offset may depend on a setting",
                    "write the value alone",
                )
            )
        elif value:
            found[path] = value
    hum = forms.get("force.hum")
    if hum and isinstance(hum.origin, Mapping) and "frequency" not in hum:
        hum.complain(None, f"{hum.what} lacks 'frequency'", "add 'frequency: 50 Hz'")
    for part in forms.values():
        if part:
            part.close()
    return found


def _form_at(path: str, forms: dict[str, Form | None]) -> Form | None:
    """The mapping at a path under ``measurement``, None where there is none; ``forms`` are those known so far."""
    if path not in forms:
        outer, _, key = path.rpartition(".")
        above = _form_at(outer, forms)
        forms[path] = above.form(key, default=None) if above else None
    return forms[path]


@dataclass(frozen=True)
class _Uses:
    """The networks that a file may use: shipped ones and those in or below its folder.

    ``trail`` are the files of the networks that use this one, outermost first; ``read`` what became of each file that
    was used so far: it is read once, however often it is used. ``depth`` is in how many groups and networks it lies.
    """

    file: str | None
    elements: Elements
    trail: tuple[Path, ...]
    beside: MappingType[str, Document]
    read: dict[Path, NetworkSpec | InputError]
    depth: int

    def network(self, word: str, depth: int) -> NetworkSpec:
        """The network that a file calls ``word``. Raises InputError with all that is wrong with it."""
        if word in self.beside:
            return self._used(self.beside[word], self.trail, depth)
        here = Path(self.file).resolve() if self.file else None
        trail = (*self.trail, here) if here else self.trail
        found = find_used_network(word, here.parent if here else Path.cwd())
        if found.resolve() in trail:
            names = " -> ".join(path.name for path in (*trail, found))
            raise InputError.at(Place(str(found)), f"the network uses itself: {names}", "break the circle")
        known = self.read.get(found.resolve()) or self._outcome(found, trail, depth)
        self.read[found.resolve()] = known
        if isinstance(known, InputError):
            raise known
        return known

    def _outcome(self, file: Path, trail: tuple[Path, ...], depth: int) -> NetworkSpec | InputError:
        try:
            return self._used(read_specification(file), trail, depth)
        except TooDeep:
            raise
        except InputError as error:
            return error

    def _used(self, document: Document, trail: tuple[Path, ...], depth: int) -> NetworkSpec:
        inner = _build(document, replace(self, file=document.file, trail=trail, beside={}, depth=depth))
        if inner.joints:
            raise InputError.at(
                document.root.place,
                "a network that is used has two ends, expected no 'nodes'",
                "use a network whose branches all lie between the same two ends",
            )
        for value in inner.measurement.values():
            place = value.node.place if value.node else document.root.place
            message = "a network that is used describes the specimen only, expected no 'measurement'"
            raise InputError.at(place, message, "move it to the network that uses this one")
        return inner
