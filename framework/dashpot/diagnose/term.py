"""A structure: a network and the terms that a diagnosis has added to it, refitted together."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect
from dashpot.fit.coordinates import Coordinates, search_coordinates
from dashpot.fit.ranges import Sizes, with_ranges
from dashpot.fit.refine import Outcome
from dashpot.model.element import Element
from dashpot.model.network import NetworkSpec
from dashpot.model.reading import build_network
from dashpot.model.sites import Site
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
    def title(self) -> str:
        """What the cause is, and where."""
        return " ".join([self.cause.about, self.site.words] if self.site else [self.cause.about])

    def scaled(self, share: float) -> Term:
        """The term with all strengths times ``share``."""
        return replace(self, atoms=tuple((share * strength, place) for strength, place in self.atoms))


@dataclass(frozen=True, eq=False)
class Model:
    """A fitted structure.

    ``base`` is the network that is diagnosed, ``declared`` its text extended by the ``terms``, ``fitted`` the same with
    fitted parameters; ``owned`` holds for each term the paths of the parameters that it brought.
    """

    base: NetworkSpec
    terms: tuple[Term, ...]
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
    def names(self) -> tuple[tuple[str, str], ...]:
        """The names of all terms."""
        return tuple(term.name for term in self.terms)

    @property
    def forms(self) -> frozenset[object]:
        """The names and forms of all terms."""
        return frozenset((term.name, term.suspect.form) for term in self.terms)

    @property
    def keeps_all(self) -> bool:
        """Whether no term has replaced a number that another one brought."""
        known = {slot.path for slot in self.fitted.slots()}
        return all(path in known for owned in self.owned for path in owned)

    def count(self, number: int) -> int:
        """How many more parameters are searched with a term: less those of a branch that it took the place of."""
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


def first_model(declared: NetworkSpec, fitted: NetworkSpec) -> Model:
    """A fitted network as the start of a search."""
    coordinates = search_coordinates(fitted)
    return Model(declared, (), declared, (), fitted, coordinates, coordinates.start)


def extended(
    network: NetworkSpec, term: Term, elements: Mapping[str, type[Element]]
) -> tuple[NetworkSpec, tuple[str, ...]]:
    """A network extended by a term, and the paths of the parameters that it brought.

    Raises InputError for a term that cannot be written into the network.
    """
    known = {slot.path for slot in network.slots()}
    document = Document.parse(term.suspect.extend(network.text, term.atoms), network.file, ours=True)
    declared = build_network(document, elements)
    return declared, tuple(slot.path for slot in declared.slots() if slot.path not in known)


def inherited(
    declared: NetworkSpec, owned: Sequence[Sequence[str]], terms: Sequence[Term], model: Model, sizes: Sizes
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
