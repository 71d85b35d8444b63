"""A structure: a network and the terms that a diagnosis has added to it, refitted together."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect
from dashpot.fit.coordinates import Coordinates, search_coordinates
from dashpot.fit.ranges import Sizes, with_ranges
from dashpot.fit.refine import Outcome
from dashpot.model.element import Element
from dashpot.model.expression import parse_expression
from dashpot.model.network import Branch, NetworkSpec, branch_slots, over_slots
from dashpot.model.patch import remove_branch
from dashpot.model.reading import build_network
from dashpot.model.sites import Site
from dashpot.model.starts import starts_within_bounds
from dashpot.text.document import Document

Array = NDArray[np.float64]

AT_BOUND = 1e-3  # of a range


@dataclass(frozen=True, eq=False)
class Term:
    """A cause in one of its forms, started at places of its grid; ``site`` is where in a network with nodes."""

    cause: type[Cause]
    suspect: Suspect
    atoms: tuple[Atom, ...]
    site: Site | None = None

    @property
    def name(self) -> tuple[str, str]:
        """The word of the cause, and the words of the site."""
        return self.cause.word, self.site.words if self.site else ""

    @property
    def kind(self) -> str:
        """What the cause is of: ``specimen`` or ``measurement``."""
        return self.cause.kind

    @property
    def form(self) -> tuple[tuple[str, str], str]:
        """The name, and the form of the law."""
        return self.name, self.suspect.form

    @property
    def word(self) -> str:
        """The word of the cause."""
        return self.cause.word

    @property
    def title(self) -> str:
        """What the cause is, and where."""
        return " ".join([self.about, self.site.words] if self.site else [self.about])

    @property
    def about(self) -> str:
        """What the form is, else what its cause is."""
        return self.suspect.about or self.cause.about

    @property
    def changes(self) -> frozenset[str]:
        """What it changes, where the forms of its cause change different things."""
        each = dict(zip(self.suspect.grid, self.suspect.each_of, strict=True))
        return frozenset(each[place] for _, place in self.atoms)

    @property
    def dependent(self) -> frozenset[str]:
        """The numbers of the network that follow a setting or a channel by it."""
        each = dict(zip(self.suspect.grid, self.suspect.each_dependent, strict=True))
        return frozenset(each[place] for _, place in self.atoms) - {""}

    def scaled(self, share: float) -> Term:
        """The term with all strengths times ``share``."""
        return replace(self, atoms=tuple((share * strength, place) for strength, place in self.atoms))

    def admits(self, numbers: Mapping[str, float]) -> bool:
        """Whether refitted numbers, by the last words of their paths, still belong to the cause."""
        return self.suspect.admits(numbers)


@dataclass(frozen=True)
class Given:
    """A branch of the diagnosed network that may go, or give way to a cause, as any term may."""

    branch: str
    kind: ClassVar[str] = "given"

    @property
    def name(self) -> tuple[str, str]:
        """No word of a cause, and the branch."""
        return "", self.branch

    @property
    def form(self) -> tuple[tuple[str, str], str]:
        """The name; its law is that of the branch."""
        return self.name, ""

    @property
    def word(self) -> str:
        """The name of the branch."""
        return self.branch

    def scaled(self, share: float) -> Given:
        """Itself: it is there."""
        return self

    def admits(self, numbers: Mapping[str, float]) -> bool:
        """Whatever its numbers are, it is called by its name."""
        return True


Part = Term | Given


@dataclass(frozen=True, eq=False)
class Model:
    """A fitted structure.

    ``base`` is the network that is diagnosed, ``terms`` are the causes and those of its branches that could go.
    ``declared`` is its text extended by the causes and without what has gone, ``fitted`` the same with fitted
    parameters; ``owned`` holds for each term the paths of the parameters that it brought.
    """

    base: NetworkSpec
    terms: tuple[Part, ...]
    declared: NetworkSpec
    owned: tuple[tuple[str, ...], ...]
    fitted: NetworkSpec
    coordinates: Coordinates
    point: Array
    outcome: Outcome = Outcome.CONVERGED

    @property
    def values(self) -> Array:
        """All slots (slots,) in SI."""
        return self.coordinates.to_values(self.point)[0]

    @property
    def at_bound(self) -> NDArray[np.bool_]:
        """Which coordinates (p,) are at an end of their range."""
        margin = AT_BOUND * (self.coordinates.high - self.coordinates.low)
        return (self.point <= self.coordinates.low + margin) | (self.point >= self.coordinates.high - margin)

    @property
    def causes(self) -> tuple[Term, ...]:
        """The terms that a diagnosis has added."""
        return tuple(term for term in self.terms if isinstance(term, Term))

    @property
    def gone(self) -> tuple[Given, ...]:
        """The branches of the base that have gone."""
        return tuple(one for one in given_branches(self.base) if one not in self.terms)

    @property
    def names(self) -> tuple[tuple[str, str], ...]:
        """The names of all causes."""
        return tuple(term.name for term in self.causes)

    @property
    def forms(self) -> frozenset[object]:
        """The names and forms of all terms."""
        return frozenset(term.form for term in self.terms)

    @property
    def keeps_all(self) -> bool:
        """Whether no cause has replaced a number that another one brought."""
        known = {slot.path for slot in self.fitted.slots()}
        brought = (owned for term, owned in zip(self.terms, self.owned, strict=True) if isinstance(term, Term))
        return all(path in known for owned in brought for path in owned)

    def count(self, number: int) -> int:
        """How many more parameters are searched with a term: less those of a branch that it took the place of."""
        if isinstance(self.terms[number], Given):
            return sum(slot.value.searched for slot in self.base.slots() if slot.path in self.owned[number])
        homes = {path.rpartition(".")[0] for path in self.owned[number]}
        gone = {slot.path for slot in self.base.slots() if slot.value.searched} - {s.path for s in self.fitted.slots()}
        replaced = sum(path.rpartition(".")[0] in homes for path in gone)
        return len(set(self.owned[number]) & set(self.coordinates.paths)) - replaced

    def numbers_of(self, number: int) -> dict[str, float]:
        """Fitted parameters in SI that a term brought, by the last word of the path; a second one ends in ``_2``."""
        return numbers_by_word(self.fitted, self.owned[number])

    def moved(self, change: Array) -> NetworkSpec:
        """The fitted network after natural steps ``change`` (p,) of its coordinates, within their ranges."""
        from dashpot.fit.coordinates import with_point

        point = self.coordinates.allowed(self.coordinates.moved(self.point, change))[0]
        return with_point(self.fitted, self.coordinates, point)


def renamed(model: Model) -> list[Part]:
    """The terms whose numbers are beyond the borders of what they are called; none where some are replaced."""
    known = enumerate(model.terms) if model.keeps_all else ()
    return [term for number, term in known if not term.admits(model.numbers_of(number))]


def first_model(declared: NetworkSpec, fitted: NetworkSpec) -> Model:
    """A fitted network as the start of a search."""
    coordinates, terms = search_coordinates(fitted), given_branches(declared)
    owned = tuple(numbers_of(declared, one) for one in terms)
    return Model(declared, terms, declared, owned, fitted, coordinates, coordinates.start)


def without_term(model: Model, number: int) -> NetworkSpec | None:
    """The fitted network without the branches, dependences and numbers of the force channel that a term brought.

    All other numbers are as they are. None where the term has changed something else, or where something that another
    term brought would have to go along: only the text of the network tells what is there then.
    """
    network, owned = model.fitted, set(model.owned[number])
    if network.joints or network.root.kind != "parallel":
        return None
    known = {one.name for one in model.base.root.members} if isinstance(model.terms[number], Term) else set()
    going = {one.name for one in network.leaves() if one.name not in known and _is_own(one, owned)}
    channel = {key: value for key, value in network.measurement.items() if f"measurement.{key}" not in owned}
    members = tuple(one for one in network.root.members if one.name not in going)
    left = replace(network, root=replace(network.root, members=members), measurement=channel)
    loose = [slot for slot in left.slots() if (brought := {one.path for one in over_slots(slot)}) and brought <= owned]
    rest = left.with_values({slot.path: replace(slot.value, over=None) for slot in loose})
    gone = {slot.path for slot in network.slots()} - {slot.path for slot in rest.slots()}
    others = (set(other) for k, other in enumerate(model.owned) if k != number)
    alone = all(other <= gone or not other & gone for other in others)  # a dependence is written as a whole
    return rest if alone and owned <= gone and not _refers(rest, going) else None


def each_part_gone(model: Model) -> list[Model]:
    """A fitted structure without each part of those of its terms that have several, to be refitted.

    All other numbers are as they are. A part is a branch: terms whose parts share branches keep them, and so do those
    on whose numbers another term has put a dependence, which names the branch.
    """
    found = []
    for number, (term, owned) in enumerate(zip(model.terms, model.owned, strict=True)):
        parts = list(dict.fromkeys(path.rpartition(".")[0] for path in owned))
        if isinstance(term, Term) and len(parts) == len(term.atoms) > 1 and not _named(model, number) & set(parts):
            for k, part in enumerate(parts):
                less = replace(term, atoms=term.atoms[:k] + term.atoms[k + 1 :])
                left = tuple(path for path in owned if path.rpartition(".")[0] != part)
                terms, rest = _with(model.terms, number, less), _with(model.owned, number, left)
                found.append(replace(model, terms=terms, owned=rest))
    return found


def _named(model: Model, number: int) -> set[str]:
    """The branches that all terms but one name: their own, and those of the numbers that they make depend."""
    others = (each for k, each in enumerate(model.terms) if k != number and isinstance(each, Term))
    paths = (path for k, owned in enumerate(model.owned) if k != number for path in owned)
    return {path.partition(".")[0] for path in (*paths, *(path for each in others for path in each.dependent))}


def _with(each: tuple[Any, ...], number: int, one: object) -> tuple[Any, ...]:
    return (*each[:number], one, *each[number + 1 :])


def _is_own(branch: Branch, owned: set[str]) -> bool:
    """Whether all numbers of a branch are among those owned, but for what dependences bring."""
    return bool(branch.values or branch.curves) and all(slot.path in owned for slot in branch_slots(branch))


def _refers(network: NetworkSpec, gone: set[str]) -> bool:
    """Whether branches have numbers of others that have gone, or a number follows from others."""
    shared = any(one.shares in gone for one in network.leaves() if one.shares)
    return shared or any(slot.value.expression for slot in network.slots())


def given_branches(network: NetworkSpec) -> tuple[Given, ...]:
    """The branches of a network that a search may let go: those with memory and free numbers.

    They do what causes do. Springs and dampers stay, without which there is no specimen; so do branches in groups,
    those of a network with nodes, what another part of the network refers to, and curves from data.
    """
    members = network.root.members
    having = [one for one in members if isinstance(one, Branch) and one.element.declares.states]
    if network.joints or len(having) == len(members):
        return ()
    searched = {slot.path.partition(".")[0] for slot in network.slots() if slot.value.searched}
    drawn = {path.partition(".")[0] for path in network.data_curves()}
    bound = {leaf.shares for leaf in network.leaves()} | set(_mentioned(network)) | drawn
    return tuple(Given(one.name) for one in having if one.name in searched - bound)


def _mentioned(network: NetworkSpec) -> Iterator[str]:
    """The branches that expressions of other ones refer to."""
    for slot in network.slots():
        if slot.value.expression:
            names = (name.partition(".")[0] for name in parse_expression(slot.value.expression).names)
            yield from (name for name in names if not slot.path.startswith(f"{name}."))


def numbers_of(network: NetworkSpec, given: Given) -> tuple[str, ...]:
    """The paths of the numbers of a branch."""
    return tuple(slot.path for slot in network.slots() if slot.path.startswith(f"{given.branch}."))


def reduced(network: NetworkSpec, gone: Sequence[str], elements: Mapping[str, type[Element]]) -> NetworkSpec:
    """A network without some of its branches. Raises InputError where another part of it asks for one of them."""
    text = network.text
    for branch in gone:
        text = remove_branch(text, branch)
    return build_network(Document.parse(text, network.file, ours=True), elements) if gone else network


def extended(
    network: NetworkSpec, term: Term, elements: Mapping[str, type[Element]]
) -> tuple[NetworkSpec, tuple[str, ...]]:
    """A network extended by a term, and the paths of the parameters that it brought.

    The strengths of a term are computed to first order; where an element does not admit what they come to, its numbers
    begin at the nearer end of their bounds. Raises InputError for a term that cannot be written into the network.
    """
    known = {slot.path for slot in network.slots()}
    document = Document.parse(term.suspect.extend(network.text, term.atoms), network.file, ours=True)
    if (text := starts_within_bounds(document, elements)) != document.text:
        document = Document.parse(text, network.file, ours=True)
    declared = build_network(document, elements)
    return declared, tuple(slot.path for slot in declared.slots() if slot.path not in known)


def inherited(
    declared: NetworkSpec, owned: Sequence[Sequence[str]], terms: Sequence[Part], model: Model, sizes: Sizes
) -> NetworkSpec:
    """A declared structure with the fitted parameters of a model wherever the two share a term or the base."""
    homes = {path: path for path in (slot.path for slot in model.base.slots())}
    for term, paths in zip(terms, owned, strict=True):
        if term in model.terms:
            old = model.owned[model.terms.index(term)]
            homes.update(zip(paths, old, strict=False) if len(old) == len(paths) else ())
    curves = {
        f"{branch.name}.{key}": curve
        for branch in model.fitted.leaves()
        for key, curve in branch.characteristics().items()
    }
    for path in declared.data_curves():
        declared = declared.with_curve(path, curves[path])
    known = {slot.path: slot.value for slot in model.fitted.slots()}
    # knots of curves from data have paths that the declared base has not
    values = {
        slot.path: replace(known[homes.get(slot.path, slot.path)], node=slot.value.node, over=slot.value.over)
        for slot in declared.slots()
        if homes.get(slot.path, slot.path) in known and (slot.path in homes or not _owned(slot.path, owned))
    }
    return with_ranges(declared.with_values(values), sizes)


def _owned(path: str, owned: Sequence[Sequence[str]]) -> bool:
    return any(path in paths for paths in owned)


def numbers_by_word(network: NetworkSpec, paths: Sequence[str]) -> dict[str, float]:
    """Numbers in SI by the last word of their path; those of a second branch end in ``_2``, and so on."""
    values = {slot.path: slot.value.number for slot in network.slots()}
    found: dict[str, float] = {}
    for path in paths:
        word = path.rpartition(".")[2]
        times = sum(name == word or name.startswith(f"{word}_") for name in found)
        found[word if not times else f"{word}_{times + 1}"] = values[path]
    return found
