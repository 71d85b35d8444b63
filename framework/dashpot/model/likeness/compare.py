"""What one network has more, less or different than another one."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations

from dashpot.model.likeness.matching import pair_nodes, role
from dashpot.model.likeness.reduced import Label, Part, Reduced, reduce_network
from dashpot.model.network import END, Joint, NetworkSpec, Value, branch_slots
from dashpot.text.quantity import pretty

SAME = 1e-9
COUNTS = ("no", "one", "two", "three", "four", "five", "six")


@dataclass(frozen=True)
class Likeness:
    """The differences in words: of the structure, and of the parameters where the structure is the same."""

    structure: tuple[str, ...]
    numbers: tuple[str, ...]

    @property
    def same_structure(self) -> bool:
        """Whether the two differ in names and numbers only."""
        return not self.structure


def compare_structures(first: NetworkSpec, second: NetworkSpec) -> Likeness:
    """What the first network has more, less or different than the second.

    Names, the order of branches and of the parts of a series do not count; laws, forms of curves, masses, what is held
    and what is to be found do.
    """
    pair = _Pair.of(first, second)
    structure = tuple(pair.structure())
    return Likeness(structure, () if structure else tuple(pair.numbers()))


@dataclass(frozen=True)
class _Pair:
    first: Reduced
    second: Reduced
    pairing: Mapping[str, str]
    names: tuple[str, str]

    @classmethod
    def of(cls, first: NetworkSpec, second: NetworkSpec) -> _Pair:
        here, there = reduce_network(first), reduce_network(second)
        alike = first.name == second.name
        names = ("the first", "the second") if alike else (f"'{first.name}'", f"'{second.name}'")
        return cls(here, there, pair_nodes(here, there), names)

    def structure(self) -> Iterator[str]:
        """Nodes, then what lies between them, then the load cell."""
        yield from self._nodes()
        for lower, upper in combinations(self.pairing, 2):
            told = list(self._between(lower, upper))
            for line in dict.fromkeys(told):
                yield line + (f" ({told.count(line)} times)" if told.count(line) > 1 else "")
        yield from self._alone(self.first, self.names[0], set(self.first.joints) - set(self.pairing))
        yield from self._alone(self.second, self.names[1], set(self.second.joints) - set(self.pairing.values()))
        cells = [
            {key: value.searched for key, value in network.spec.measurement.items()}
            for network in (self.first, self.second)
        ]
        if cells[0] != cells[1]:
            told = [", ".join(f"{key}{' free' * found}" for key, found in cell.items()) or "nothing" for cell in cells]
            yield f"measurement: {told[0]} in {self.names[0]}, {told[1]} in {self.names[1]}"

    def _nodes(self) -> Iterator[str]:
        for here, there in self.pairing.items():
            one, other = self.first.joints[here], self.second.joints[there]
            if role(one) != role(other):
                yield (
                    f"the node {_node(here)} is {_held(one)} in {self.names[0]}, {_node(there)} is {_held(other)} "
                    f"in {self.names[1]}"
                )

    def _between(self, lower: str, upper: str) -> Iterator[str]:
        there = self.pairing[lower], self.pairing[upper]
        mine, yours = self.first.labels[lower, upper], self.second.labels[there]
        more = _chosen(self.first.between(lower, upper), mine - yours)
        less = _chosen(self.second.between(*there), yours - mine)
        for part in list(more):
            other = next((p for p in less if _words(p) == _words(part)), None)
            if other:
                more.remove(part)
                less.remove(other)
                yield (
                    f"between {_node(lower)} and {_node(upper)}: {part.describe(True)} in {self.names[0]}, "
                    f"{other.describe(True)} in {self.names[1]}"
                )
        yield from _told(self.names[0], more, lower, upper)
        yield from _told(self.names[1], less, *there)

    def _alone(self, network: Reduced, name: str, nodes: set[str]) -> Iterator[str]:
        for node in (joint for joint in network.joints if joint in nodes):
            yield f"{name} has one node more, {_node(node)}, which is {_held(network.joints[node])}"
        for (lower, upper), parts in network.parts.items():
            if nodes & {lower, upper}:
                yield from _told(name, list(parts), lower, upper)

    def numbers(self) -> Iterator[str]:
        """Every number that differs, by its path."""
        for lower, upper in combinations(self.pairing, 2):
            yours = list(self.second.between(self.pairing[lower], self.pairing[upper]))
            for part in self.first.between(lower, upper):
                other = _twin(part, yours)
                yours.remove(other)
                for one, two in zip(part.edges(), other.edges(), strict=True):
                    yield from self._differing(_numbers(one, self.first), _numbers(two, self.second))
        for here, there in self.pairing.items():
            yield from self._differing(_masses(self.first.joints[here]), _masses(self.second.joints[there]))
        yield from self._differing(*(_common(network.spec) for network in (self.first, self.second)))

    def _differing(self, mine: dict[str, tuple[str, Value]], yours: dict[str, tuple[str, Value]]) -> Iterator[str]:
        for key in mine.keys() | yours.keys() if mine.keys() != yours.keys() else mine:
            (path, one), (other, two) = mine.get(key, ("", None)), yours.get(key, ("", None))
            if (
                one is None
                or two is None
                or abs(one.number - two.number) > SAME * max(abs(one.number), abs(two.number))
            ):
                called = f" ({other})" if other and path and other != path else ""
                yield f"{path or other}: {_shown(one)} in {self.names[0]}, {_shown(two)} in {self.names[1]}{called}"


def _chosen(parts: tuple[Part, ...], wanted: Counter[Label]) -> list[Part]:
    found = []
    for part in parts:
        if wanted[part.label] > 0:
            wanted[part.label] -= 1
            found.append(part)
    return found


def _words(part: Part) -> str:
    return " ".join(sorted(edge.edge.branch.element.word for edge in part.edges() if edge.edge)) + part.kind


def _told(name: str, parts: list[Part], lower: str, upper: str) -> Iterator[str]:
    words = [part.describe() for part in parts]
    for word in dict.fromkeys(words):
        count = words.count(word)
        number = COUNTS[count] if count < len(COUNTS) else str(count)
        yield f"{name} has {number} {word} more between {_node(lower)} and {_node(upper)}"


def _node(name: str) -> str:
    return name if name != END else "the driven end"


def _held(joint: Joint) -> str:
    masses = [
        key + (" free" if value.searched else "") + (" given by runs" if value.setting else "")
        for key, value in joint.masses.items()
    ]
    tied = ", tied to another node" if joint.shares else ""
    return joint.hold + (f" with {', '.join(masses)}{tied}" if masses else "")


def _twin(part: Part, others: list[Part]) -> Part:
    alike = [other for other in others if other.label == part.label]
    names = [edge.edge.branch.name for edge in part.edges() if edge.edge]
    return next((p for p in alike if [e.edge.branch.name for e in p.edges() if e.edge] == names), alike[0])


def _numbers(part: Part, network: Reduced) -> dict[str, tuple[str, Value]]:
    assert part.edge
    branch, ends = part.edge.branch, network.spec.ends.get(part.edge.offset.rpartition(".")[0])
    found = {slot.path.removeprefix(branch.numbers): (slot.path, slot.value) for slot in branch_slots(branch)}
    for key, parameter in branch.element.declares.parameters.items():
        if key not in branch.values and parameter.default is not None:
            found[f".{key}"] = (f"{branch.numbers}.{key}", Value(parameter.default, parameter.unit))
    for key, curve in branch.characteristics().items():
        unit = curve.curve.over[1]
        found |= {
            f".{key} at {k}": (f"{branch.numbers}.{key}, knot {k + 1}", Value(at, unit))
            for k, at in enumerate(curve.at)
        }
    offset = ends.offset if ends and ends.offset else Value(0.0, "m")
    return found | {" offset": (part.edge.offset or f"{branch.numbers}.offset", offset)}


def _masses(joint: Joint) -> dict[str, tuple[str, Value]]:
    return {key: (f"{joint.numbers}.{key}", value) for key, value in joint.masses.items()}


def _common(spec: NetworkSpec) -> dict[str, tuple[str, Value]]:
    found = {key: (f"measurement.{key}", value) for key, value in spec.measurement.items()}
    return found | {"gravity": ("gravity", Value(spec.gravity, "m/s^2"))}


def _shown(value: Value | None) -> str:
    return pretty(value.number, value.unit) if value else "nothing"
