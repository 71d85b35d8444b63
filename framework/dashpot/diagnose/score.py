"""The score of a structure: what it predicts of runs that took no part in its fit, and its prior odds.

For each group of runs (a run with its repeats) the structure is fitted to all others, to first order, and predicts it;
minus the predictive log likelihood, under one variance for all groups, is

    n / 2 log(mean square of what is not predicted),

in nats, with the n independent samples of all groups. A variance for each group would let a structure win that follows
some runs to the noise and gives up the others. A term that only follows the noise, or the error of another term's form,
does not predict. The prior odds of each term are stated in ``odds``.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from dashpot.diagnose.front import NONE, Gram
from dashpot.diagnose.look import Look

Array = NDArray[np.float64]

STEADY = 1e-6  # of the square of a column: keeps numbers that nothing tells from running away


class Added(NamedTuple):
    """Columns of a candidate that join a structure, by their number among its own."""

    candidate: int
    places: tuple[int, ...]


class Structure(NamedTuple):
    """What changes at a model: own terms that go, by number, and columns that join."""

    dropped: frozenset[int] = frozenset()
    added: frozenset[Added] = frozenset()

    @property
    def size(self) -> int:
        """How many changes these are."""
        return len(self.dropped) + len(self.added)


@dataclass(eq=False)
class Scores:
    """The scores of structures at one look; what was computed once is kept."""

    look: Look
    known: dict[Structure, tuple[Array, float] | None] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.odds = self.look.odds
        self.scale = self.look.front.scale
        self.kinds = [term.kind for term in self.look.model.terms]
        self.given = frozenset(number for number, kind in enumerate(self.kinds) if kind == "given")

    def gram(self, gone: frozenset[int] = NONE) -> Gram:
        """The Gram matrix (c, c) of the scaled columns beside what is refitted where some terms are ``gone``.

        With what is known of the strengths beforehand.
        """
        return self.look.front.beside(gone).gram

    def columns(self, structure: Structure) -> NDArray[np.intp]:
        """The columns that a structure fits: the tangents of the terms that stay, then what joins."""
        paths = self.look.model.coordinates.paths
        gone = {path for number in structure.dropped for path in self.look.model.owned[number]}
        kept = [1 + k for k, at in enumerate(self.look.own) if paths[at] not in gone]
        alive = [at for at in kept if self.look.front.squares[at] > 0.0]
        return np.array([*alive, *self.atoms(structure)], dtype=np.intp)

    def atoms(self, structure: Structure) -> list[int]:
        """The columns that join."""
        first = self.look.layout.first_candidate
        return [
            first + self.look.candidates[k].columns.start + place
            for k, places in sorted(structure.added)
            for place in places
        ]

    def target(self, structure: Structure) -> Array:
        """The residual as a combination (c,) of the scaled columns: what dropped terms explained comes back."""
        target = np.zeros(self.look.layout.size)
        target[0] = 1.0
        for number in structure.dropped:
            at = self.look.layout.term(number)
            target[at] = self.scale[at] / self.scale[0]
        return target

    def strengths(self, structure: Structure) -> Array:
        """The solution on all runs, one for each of ``columns``, in their own units."""
        at = self.columns(structure)
        solution = np.linalg.solve(*self._equations(structure, at, self.target(structure)))
        return np.asarray(solution * self.scale[0] / self.scale[at])

    def moves(self, structure: Structure) -> Array:
        """The natural steps (p,) of all parameters of the model that a structure foresees."""
        at, strengths, look = self.columns(structure), self.strengths(structure), self.look
        found = np.zeros(look.model.point.size)
        tangents = at <= look.layout.tangents
        found[look.own[at[tangents] - 1]] = strengths[tangents]
        rest = self.target(structure) * self.scale[0] / self.scale
        rest[at] -= strengths
        found[look.base] = look.front.beside(structure.dropped).base_moves(rest)[: look.base.size]
        return found

    def admitted(self, structure: Structure) -> bool:
        """Whether no strength has the wrong sign."""
        found = self.strengths(structure)
        first = found.size - len(self.atoms(structure))
        for k, places in sorted(structure.added):
            mine = found[first : first + len(places)]
            first += len(places)
            if self.look.candidates[k].suspect.sign and (mine < 0.0).any():
                return False
        return True

    def predicted(self, structure: Structure) -> tuple[Array, float] | None:
        """Mean square (groups,) of each group, predicted from all others, and what errors of forms cost in nats.

        None where a strength has the wrong sign.
        """
        if structure not in self.known:
            self.known[structure] = self._predicted(structure) if self.admitted(structure) else None
        return self.known[structure]

    def _predicted(self, structure: Structure) -> tuple[Array, float]:
        at, target, samples = self.columns(structure), self.target(structure), self.look.samples
        beside, foreseen = self.look.front.beside(structure.dropped), structure != Structure()
        whole, right = self._equations(structure, at, target)
        left = _left_out(beside.groups(_scaled(self.scale, at, target)), whole, right, foreseen)
        if foreseen:
            target[at] -= np.linalg.solve(whole, right)
        rest = target * self.scale[0] / self.scale
        return np.maximum(left * self.scale[0] ** 2 / samples, 1e-12), beside.unlikely(rest)

    def _equations(self, structure: Structure, at: NDArray[np.intp], target: Array) -> tuple[Array, Array]:
        """The normal equations, a matrix (k, k) and a right side (k,), of the columns of a structure on all runs."""
        gram = self.gram(structure.dropped)
        return steadied(gram.block(at, at)), gram.times(at, target)

    def exact(self) -> Array:
        """Mean square (groups,) of each group, predicted from all others by the present structure.

        The laws are as they are: no errors of their forms are allowed for.
        """
        total = self.look.exact.sum(axis=0)
        scale = np.sqrt(np.maximum(np.diag(total), 1e-300))
        alive = 1 + np.flatnonzero(np.diag(total)[1:] > 0.0)
        unit = np.outer(scale, scale)
        known = np.diag(np.append(0.0, np.ones(scale.size - 1)))
        target = np.eye(scale.size)[0]
        combined = _scaled(scale, alive, target)
        gram = (total + known) / unit
        whole, right = steadied(gram[np.ix_(alive, alive)]), gram[alive, 0]
        left = _left_out(combined.T @ self.look.exact @ combined, whole, right, foreseen=False)
        return np.maximum(left * scale[0] ** 2 / self.look.samples, 1e-12)

    def price(self, structure: Structure) -> float:
        """The prior of a structure in nats: what joins less what goes."""
        joins = sum(self.joining(added) for added in structure.added)
        model, had = self.look.model, len(self.kinds) - len(self.given)
        goes = sum(self.odds.price(self.kinds[number], model.count(number)) for number in structure.dropped)
        has = had - len(structure.dropped - self.given) + len(structure.added)
        return joins - goes + self.odds.of_any(has) - self.odds.of_any(had)

    def joining(self, added: Added) -> float:
        """The price of what joins."""
        candidate = self.look.candidates[added.candidate]
        numbers = len(added.places) * (1 + (0 if candidate.suspect.joint else candidate.suspect.unknowns))
        return self.odds.price(candidate.cause.kind, numbers)

    def score(self, structure: Structure) -> float:
        """Minus the log of likelihood and prior; the smaller, the better; infinite for one of the wrong sign."""
        found = self.predicted(structure)
        return np.inf if found is None else float(nats(found[0], self.look.samples)) + found[1] + self.price(structure)


def nats(squares: Array, samples: Array) -> Array:
    """Minus the log likelihood (...) of mean squares (..., groups) of ``samples`` (..., groups), of one variance."""
    whole = samples.sum(axis=-1)
    found: Array = 0.5 * whole * np.log(np.sum(samples * squares, axis=-1) / whole)
    return found


def _scaled(scale: Array, at: NDArray[np.intp], target: Array) -> Array:
    """Columns ``at`` divided by their ``scale`` (c,) and a ``target`` (c,) of such ones, as combinations (c, k + 1)."""
    found = np.zeros((scale.size, at.size + 1))
    found[at, np.arange(at.size)] = 1.0 / scale[at]
    found[:, -1] = target / scale
    return found


def _left_out(grams: Array, whole: Array, right: Array, foreseen: bool) -> Array:
    """The squares (groups,) of a target that columns leave in each group, with strengths from all others.

    ``grams`` (groups, k + 1, k + 1) are those of the columns and the target. ``whole`` (k, k) and ``right`` (k,), the
    normal equations, hold their sum over the groups, and what is known of the strengths beforehand. Where the strengths
    are not ``foreseen`` the model stays as it is, but for what leaving a group out changes: a step that a fit has not
    made promises too much.
    """
    inner, cross, square = grams[:, :-1, :-1], grams[:, :-1, -1], grams[:, -1, -1]
    # what the other groups hardly tell is not put to the test: there the fit to all runs stands in
    tied = 1.0 / len(inner)
    solved = np.linalg.solve((1.0 + tied) * whole - inner, ((1.0 + tied) * right - cross)[..., None])
    if not foreseen:
        solved -= np.linalg.solve(whole, right)[:, None]
    left: Array = square - 2.0 * np.sum(solved[..., 0] * cross, axis=1)
    return left + np.sum(solved * (inner @ solved), axis=(1, 2))


def steadied(gram: Array) -> Array:
    """A Gram matrix (k, k) of columns, where strengths that nothing tells stay small."""
    return gram + STEADY * np.eye(len(gram))
