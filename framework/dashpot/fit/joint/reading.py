"""Reading a joint file."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from dashpot.contract.registry import Registry
from dashpot.fit.joint.declaration import FORMAT, JointSpec, Specimen, Tie
from dashpot.fit.study.patterns import chosen, is_wild
from dashpot.model.network import NetworkSpec, Value
from dashpot.model.reading import read_network
from dashpot.model.shipped import SUFFIXES
from dashpot.text.document import Document
from dashpot.text.form import Form, read_text
from dashpot.text.name import RULE, is_name, shown
from dashpot.text.node import Mapping as MappingNode
from dashpot.text.node import Node, Sequence
from dashpot.text.problem import InputError, Problem, nearest


def read_joint(path: Path, registry: Registry) -> JointSpec:
    """The specimens in a file and what they share. InputError with all its mistakes and those of its networks."""
    document = Document.read(path)
    problems: list[Problem] = []
    form = Form(document.root, problems, "the joint fit")
    form.choice("format", (FORMAT,))
    name, about, seed = form.name("name"), form.text("about", ""), form.integer("seed", 0)
    specimens = tuple(_specimens(form, path.parent, registry))
    node = form.node("shared")
    form.close()
    if node is None:
        form.complain(None, "the joint fit lacks 'shared'", "name the parameters in common: shared: ['rubber.*']")
    elif not problems:
        ties = tuple(_ties(node, {each.name: each.network for each in specimens}, problems))
    if problems:
        raise InputError(problems)
    return JointSpec(name or "", about, specimens, ties, seed)


def _specimens(form: Form, folder: Path, registry: Registry) -> Iterator[Specimen]:
    entries = form.named("specimens") or {}
    if "specimens" in form and len(entries) < 2:
        form.complain("specimens", f"expected two specimens or more, got {len(entries)}", "fit a single one by 'fit'")
    for name, entry in entries.items():
        if not is_name(name):
            entry.complain(None, f"{shown(name)} cannot be the name of a specimen", RULE)
        word, data = entry.text("network"), entry.text("data")
        entry.close()
        if word and data:
            try:
                network = read_network(folder / word if Path(word).suffix in SUFFIXES else word, registry.elements)
            except InputError as error:
                form.problems.extend(error.problems)
                continue
            yield Specimen(name, network, folder / data)


def _ties(node: Node, networks: Mapping[str, NetworkSpec], problems: list[Problem]) -> Iterator[Tie]:
    taken: dict[tuple[str, str], Tie] = {}
    for item in node.items if isinstance(node, Sequence) else (node,):
        try:
            found = _named(item, networks) if isinstance(item, MappingNode) else _by_pattern(item, networks)
            for tie in found:
                _check(tie, networks)
                for pair in tie.paths.items():
                    if pair in taken:
                        raise ValueError(f"'{pair[1]}' of '{pair[0]}' is shared twice; name it once")
                    taken[pair] = tie
                yield tie
        except ValueError as error:
            problems.append(Problem(item.place, f"'shared': {error}"))


def _by_pattern(node: Node, networks: Mapping[str, NetworkSpec]) -> list[Tie]:
    """The numbers of one path that a pattern names in two specimens or more."""
    pattern = read_text(node)
    homes: dict[str, dict[str, str]] = {}
    for name, network in networks.items():
        for slot in network.slots():
            if slot.value.searched and chosen(slot.path, [pattern]):
                homes.setdefault(slot.path, {})[name] = slot.path
    found = [Tie(paths, node.place) for paths in homes.values() if len(paths) > 1]
    if not found:
        known = sorted({slot.path for network in networks.values() for slot in network.slots() if slot.value.searched})
        hint = "" if is_wild(pattern) else nearest(pattern, known)
        raise ValueError(
            f"no parameter '{pattern}' is identified in two specimens or more; "
            f"{hint or 'identified are: ' + (', '.join(known) or 'none')}"
        )
    return found


def _named(node: MappingNode, networks: Mapping[str, NetworkSpec]) -> list[Tie]:
    paths = {name: read_text(entry) for name, entry in node.entries.items()}
    for name in paths:
        if name not in networks:
            raise ValueError(f"there is no specimen '{name}'; {nearest(name, networks) or ', '.join(networks)}")
    if len(paths) < 2:
        raise ValueError(f"expected 'SPECIMEN: PATH' of two specimens or more, got {len(paths)}")
    return [Tie({name: paths[name] for name in networks if name in paths}, node.place)]


@dataclass(frozen=True)
class _Home:
    name: str
    path: str
    value: Value


def _check(tie: Tie, networks: Mapping[str, NetworkSpec]) -> None:
    homes = [_home(name, path, networks[name]) for name, path in tie.paths.items()]
    first, *others = homes
    for other in others:
        told = f"'{other.path}' of '{other.name}' and '{first.path}' of '{first.name}'"
        if other.value.unit != first.value.unit:
            raise ValueError(f"{told} are in {other.value.unit} and {first.value.unit}; share parameters of one unit")
        if other.value.scale != first.value.scale:
            raise ValueError(f"{told} are searched on a {other.value.scale} and a {first.value.scale} scale; agree")
        _check_knots(other, first, networks, told)


def _home(name: str, path: str, network: NetworkSpec) -> _Home:
    values = {slot.path: slot.value for slot in network.slots()}
    if path not in values:
        raise ValueError(f"'{name}' has no parameter '{path}'; {nearest(path, values) or ', '.join(values)}")
    if not values[path].searched:
        raise ValueError(f"'{path}' of '{name}' is not identified; give it a start: {{start: ...}}")
    return _Home(name, path, values[path])


def _check_knots(one: _Home, other: _Home, networks: Mapping[str, NetworkSpec], told: str) -> None:
    curves = [networks[home.name].curves().get(home.path.partition("[")[0]) for home in (one, other)]
    if any(curve and curve.data for curve in curves):
        raise ValueError(f"{told} come from the slow loop of each specimen; share parameters that no loop gives")
    ats = [curve.at if curve else () for curve in curves]
    if ats[0] != ats[1]:
        raise ValueError(f"{told} are knots at different places; give both curves the same knots")
