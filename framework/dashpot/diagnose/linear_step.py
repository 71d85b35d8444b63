"""The linear step from a fitted model to a structure: its numbers on all runs, with no strength below zero.

A refit cannot go where the force of a damper has the wrong sign, whatever that would explain. So a number to which the
force of its branch is proportional loses no more than all of itself in the step: it is held at zero, and the others are
fitted again. Of other numbers, as a relaxation time, a long linear step says only which way they go.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from dashpot.diagnose.front import NONE
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


class Held(NamedTuple):
    """Strengths that stay at zero: those of terms, by column, and of the base, by place."""

    own: frozenset[int] = frozenset()
    base: frozenset[int] = frozenset()


@dataclass(frozen=True, eq=False)
class Fit:
    """A structure fitted to all runs.

    ``at`` (k,) are the columns that it fits, ``combined`` (c, k + 1) what they and the target are made of, in scaled
    columns, ``whole`` (k, k) and ``right`` (k,) the Gram matrix of these and their products with the target, and
    ``solution`` (k,) their strengths.
    """

    at: NDArray[np.intp]
    combined: Array
    whole: Array
    right: Array
    solution: NDArray[np.floating]

    @property
    def rest(self) -> Array:
        """What it leaves of the target, as a combination (c,)."""
        left: Array = self.combined[:, -1] - self.combined[:, :-1] @ self.solution
        return left


@dataclass(eq=False)
class LinearStep:
    """The steps from the model of one look; which numbers are ``held`` is kept."""

    look: Look
    held: dict[Structure, Held] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.scale = self.look.front.beside().scale

    def gram(self, gone: frozenset[int] = NONE) -> Array:
        """The Gram matrix (c, c) of the scaled columns beside what is refitted where some terms are ``gone``.

        With what is known of the strengths beforehand.
        """
        return self.look.front.beside(gone).gram

    def columns(self, structure: Structure) -> NDArray[np.intp]:
        """The columns that a structure fits: the tangents of the terms that stay, then what joins."""
        paths = self.look.model.coordinates.paths
        gone = {path for number in structure.dropped for path in self.look.model.owned[number]}
        kept = [1 + k for k, at in enumerate(self.look.own) if paths[at] not in gone]
        alive = [at for at in kept if self.look.front.beside().squares[at] > 0.0]
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
        target = np.zeros(self.look.size)
        target[0] = 1.0
        for number in structure.dropped:
            at = self.look.layout.term(number)
            target[at] = self.scale[at] / self.scale[0]
        return target

    def fit(self, structure: Structure) -> Fit:
        """The structure fitted to all runs, with no strength below zero.

        One that would fall below it in the linear step is held there, and let go where it would rise again.
        """
        held, tried = self.held.get(structure, Held()), set[Held]()
        fit = self._fit(structure, held)
        while structure not in self.held:
            tried.add(held)
            held = self._at_zero(structure, fit, held)
            fit = self._fit(structure, held)
            if held in tried:
                self.held[structure] = held
        return fit

    def _fit(self, structure: Structure, held: Held) -> Fit:
        columns, target = self.columns(structure), self.target(structure)
        at = columns[~np.isin(columns, list(held.own))]
        for column in held.own:
            target[column] = self.scale[column] / self.scale[0]
        combined = self._combined(at, target, structure.dropped, held)
        seen = np.flatnonzero(combined.any(axis=1))
        products: Array = combined[seen].T @ self.gram(structure.dropped)[np.ix_(seen, seen)] @ combined[seen]
        whole: Array = products[:-1, :-1] + STEADY * np.eye(at.size)
        right: Array = products[:-1, -1]
        return Fit(at, combined, whole, right, np.linalg.solve(whole, right))

    def _combined(self, at: NDArray[np.intp], target: Array, gone: frozenset[int], held: Held) -> Array:
        """Columns ``at`` (k,) and the target as combinations (c, k + 1) of scaled columns, what is held put back."""
        found = np.zeros((self.look.size, len(at) + 1))
        found[at, np.arange(len(at))] = 1.0
        found[:, -1] = target
        columns, put_back, lost = self.put_back(gone, held)
        found[columns] += put_back @ found
        found[columns, -1] += lost
        return found

    def put_back(self, gone: frozenset[int], held: Held) -> tuple[NDArray[np.intp], Array, Array]:
        """The columns (h,) of the numbers of the base that are held, and how much of them goes with other columns.

        The base takes up a part of every column, and so moves these numbers: that is put back by ``strengths`` (h, c)
        of their own columns, and beside the target (h,) they lose all of themselves.
        """
        places = sorted(held.base)
        numbers, columns = self.look.positive[places], self.look.layout.size + np.array(places, dtype=np.intp)
        moves = self.look.front.beside(gone).base_moves[numbers]
        each = np.linalg.pinv(-moves[:, columns]) * (self.scale[columns] / self.scale[0])[:, None]
        return columns, each @ (moves * (self.scale[0] / self.scale)), each.sum(axis=1)

    def _at_zero(self, structure: Structure, fit: Fit, held: Held) -> Held:
        """The strengths that would lose more than all of themselves, and those held that would not rise again."""
        look, positive = self.look, self.look.model.strengths
        strengths = fit.solution * self.scale[0] / self.scale[fit.at]
        own = {
            int(column)
            for column, strength in zip(fit.at, strengths, strict=True)
            if column <= look.layout.tangents and strength < -1.0 and positive[look.own[column - 1]]
        }
        at_zero = self._combined(np.array(sorted(held.own), dtype=np.intp), fit.rest, structure.dropped, held)
        pull = at_zero[:, :-1].T @ self.gram(structure.dropped) @ fit.rest
        own |= {column for column, up in zip(sorted(held.own), pull, strict=True) if up <= 0.0}
        moves = look.front.beside(structure.dropped).base_moves[look.positive]
        steps = moves @ (fit.rest * self.scale[0] / self.scale)
        base = {
            int(place)
            for place, (step, up) in enumerate(zip(steps, fit.rest[look.layout.size :], strict=True))
            if (up <= 0.0 if place in held.base else step < -1.0)
        }
        return Held(frozenset(own), frozenset(base))

    def strengths(self, structure: Structure) -> Array:
        """The solution on all runs, one for each of ``columns``, in their own units."""
        fit, at = self.fit(structure), self.columns(structure)
        found = np.full(at.size, -1.0)  # of those that are held
        found[np.isin(at, fit.at)] = fit.solution * self.scale[0] / self.scale[fit.at]
        return found

    def moves(self, structure: Structure) -> Array:
        """The natural steps (p,) of all parameters of the model that a structure foresees."""
        at, strengths, look = self.columns(structure), self.strengths(structure), self.look
        found = np.zeros(look.model.point.size)
        tangents = at <= look.layout.tangents
        found[look.own[at[tangents] - 1]] = strengths[tangents]
        moves = look.front.beside(structure.dropped).base_moves[: look.base.size]
        found[look.base] = moves @ (self.fit(structure).rest * self.scale[0] / self.scale)
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
