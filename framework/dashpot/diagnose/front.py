"""What is refitted beside every structure: parameters of the base, doubted faults, and errors of the forms of terms.

The base is eliminated once. The errors of the form of a term go with it: a structure without the term could otherwise
keep its force as an error of a form that it does not have.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from dashpot.diagnose.candidate import Candidate
from dashpot.diagnose.columns import Layout
from dashpot.diagnose.term import Given, Model

Array = NDArray[np.float64]

RIDGE = 1e-9
ROOM = 30e6  # bytes of what is known beside structures of which terms are gone
FORM_ERROR = 0.1  # of the force of a term: how far the law of an element may be from the one that acts

NONE = frozenset[int]()


@dataclass(frozen=True, eq=False)
class Gram:
    """A Gram matrix (c, c): the ``whole`` (c, c) and a change of its rank, by the squares of rows ``back`` (g, c)."""

    whole: Array
    back: Array

    def block(self, rows: NDArray[np.intp], columns: NDArray[np.intp]) -> Array:
        """Its elements (r, k) in some rows (r,) and columns (k,)."""
        found: Array = self.whole[rows[:, None], columns] + self.back[:, rows].T @ self.back[:, columns]
        return found

    def times(self, rows: NDArray[np.intp], combination: Array) -> Array:
        """Some rows (r,) times a combination (c,) of few of the columns."""
        at = np.flatnonzero(combination)
        found: Array = self.block(rows, at) @ combination[at]
        return found

    @property
    def diagonal(self) -> Array:
        """Its diagonal (c,)."""
        return np.diag(self.whole) + np.sum(self.back**2, axis=0)


@dataclass(frozen=True, eq=False)
class Beside:
    """The columns of a ``front`` beside those in front that stay: some are ``going`` (g,) with their terms.

    Without these the strengths of the others that take up one of each column are smaller by ``moved`` times ``change``
    (g, c). ``gram`` is the Gram matrix of all runs, and of what is known beforehand, of columns divided by their scale.
    ``occam`` are the nats by which the marginal likelihood is below that of the best strengths.
    """

    front: Front
    going: NDArray[np.intp]
    change: Array
    gram: Gram
    occam: float

    @property
    def nbytes(self) -> int:
        """The bytes of its matrices."""
        return self.change.nbytes + self.gram.back.nbytes + len(self.front.grams) * 8 * self.moved.size

    @cached_property
    def moved(self) -> Array:
        """How the strengths (e, g) of the columns in front follow those that are going."""
        return self.front.covariance[:, self.going]

    @cached_property
    def _pulled(self) -> Array:
        """The products (groups, g, e) of what ``moved`` says with the columns in front, by group."""
        return self.front.pulled_together[:, self.going]

    def taken(self, at: NDArray[np.intp]) -> Array:
        """The strengths (e, k) of the columns in front that take up one of each of the columns ``at`` (k,)."""
        found: Array = self.front.moves[:, at] - self.moved @ self.change[:, at]
        found[self.going] = 0.0
        return found

    def base_moves(self, combination: Array) -> Array:
        """The strengths (b,) of the base that take up a combination (c,) of the columns."""
        at, first = np.flatnonzero(combination), self.front.precision.size
        own, base = combination[at], self.front.base_moves
        found: Array = base[:, first + at] @ own - base[:, :first] @ (self.taken(at) @ own)
        return found

    def groups(self, combined: Array) -> Array:
        """The Gram matrices (groups, k, k) of combinations (c, k) of these columns, by the group of runs."""
        at, grams, first = np.flatnonzero(combined.any(axis=1)), self.front.grams, self.front.precision.size
        own, places = combined[at], first + at
        half = 0.5 * (self.front.pulled(at) - self.change[:, at].T @ self._pulled)
        cross = (half - grams[:, places, :first]) @ self.taken(at)
        inner = grams[:, places[:, None], places] + cross + cross.transpose(0, 2, 1)
        found: Array = own.T @ inner @ own
        return found

    def unlikely(self, strengths: Array) -> float:
        """How unlikely a combination (c,) of the columns is beforehand, in nats."""
        at = np.flatnonzero(strengths)
        in_front = self.front.precision @ (self.taken(at) @ strengths[at]) ** 2
        # one natural size is the standard deviation of a number
        numbers = np.sum(strengths[1 : 1 + self.front.tangents] ** 2)
        return 0.5 * float(in_front + numbers) + self.occam


@dataclass(eq=False)
class Front:
    """``grams`` (groups, e + c, e + c) of columns beside the base, of which ``base_moves`` (b, e + c) take up each.

    ``total`` (e + c, e + c) is their sum in double precision. The first e have a ``precision`` (e,) known beforehand;
    ``owners`` (e,) are the terms of whose form they are errors, -1 for those of none. The next columns are the residual
    and ``tangents`` of terms.
    """

    grams: NDArray[np.floating]
    total: Array
    base_moves: Array
    precision: Array
    owners: NDArray[np.intp]
    tangents: int
    _known: dict[frozenset[int], Beside] = field(default_factory=dict)
    _pulls: dict[int, Array] = field(default_factory=dict)

    def beside(self, gone: frozenset[int] = NONE) -> Beside:
        """The columns where some terms are ``gone``, and with them the errors of their forms.

        Kept are those beside all terms, and of the others what was asked for last, as long as there is room.
        """
        gone &= self._owning
        found = self._known.pop(gone, None) or self._without(gone)
        self._known[gone] = found
        while len(self._known) > 2 and sum(one.nbytes for one in self._known.values()) > ROOM:
            del self._known[next(known for known in self._known if known)]
        return found

    @cached_property
    def _owning(self) -> frozenset[int]:
        """The terms with errors of their form."""
        return frozenset(self.owners.tolist())

    @cached_property
    def covariance(self) -> Array:
        """The covariance (e, e) of the strengths of the columns in front."""
        return covariance(self.total, self.precision)

    @cached_property
    def moves(self) -> Array:
        """The strengths (e, c) of the columns in front that take up one of each of the others."""
        first = self.precision.size
        return self.covariance @ self.total[:first, first:]

    @property
    def squares(self) -> Array:
        """The squares (c,) of what the columns in front leave of each of the others."""
        return self._eliminated[0]

    @property
    def scale(self) -> Array:
        """The sizes (c,) of the columns beside those in front."""
        return self._eliminated[1]

    @cached_property
    def _eliminated(self) -> tuple[Array, Array, Array]:
        """What the columns in front leave of the others: squares (c,), scale (c,) and Gram matrix (c, c).

        That is of columns divided by their scale, with what is known beforehand.
        """
        gram = beside(self.total, self.moves)
        squares = np.diag(gram).copy()
        gram += self.moves.T @ (self.precision[:, None] * self.moves)
        numbers = range(1, 1 + self.tangents)
        gram[numbers, numbers] += 1.0
        # below that share of a column what the others leave of it is rounding
        least = RIDGE * np.diag(self.total)[self.precision.size :]
        scale = np.sqrt(np.maximum(np.maximum(squares, least), 1e-300))
        gram /= np.outer(scale, scale)
        return squares, scale, gram

    @cached_property
    def pulled_together(self) -> Array:
        """The products (groups, e, e) of what moves with each column in front with these columns, by group."""
        first = self.precision.size
        found: Array = self.covariance @ self.grams[:, :first, :first].astype(float)
        return found

    def pulled(self, at: NDArray[np.intp]) -> Array:
        """The products (groups, k, e) of what takes up each of the columns ``at`` (k,) with the columns in front."""
        first = self.precision.size
        fresh = [place for place in at.tolist() if place not in self._pulls]
        if fresh:
            found = self.total[first + np.array(fresh), :first] @ self.pulled_together
            self._pulls.update(zip(fresh, found.transpose(1, 0, 2), strict=True))
        return np.stack([self._pulls[place] for place in at.tolist()], axis=1)

    def _without(self, gone: frozenset[int]) -> Beside:
        """Where the columns in front of some terms are going: a change of their rank."""
        leaves = np.isin(self.owners, list(gone))
        going, stays = np.flatnonzero(leaves), np.flatnonzero(~leaves)
        root = _inverse_root(self.covariance[np.ix_(going, going)])
        back = root @ self.moves[going]
        gram = Gram(self._eliminated[2], back / self.scale)
        nats = occam(self.total[np.ix_(stays, stays)], self.precision[stays])
        return Beside(self, going, root.T @ back, gram, nats)


def front_of(
    grams: list[Array],
    whole: Array,
    known: Array,
    free: int,
    layout: Layout,
    model: Model,
    candidates: Sequence[Candidate],
) -> Front:
    """From Gram matrices (f + c, f + c) of groups behind ``free`` columns of the base and ``known`` (f - free,) ones.

    ``whole`` is their sum. They are large, and taken out of the list one after the other.
    The residual is that of the base as it is, unless faults of each run are ``known``, to which no fit has adapted it.
    """
    first = free + known.size
    moves, squares = in_front(whole, np.zeros(free)), np.diag(whole).copy()
    squares[free:] -= np.sum(whole[:free, free:] * moves, axis=0)
    made_up = squares < RIDGE * np.diag(whole)  # by the base, but for rounding
    squares[made_up] = 0.0
    errors, precision, owners = form_errors(squares, first, layout, model, candidates)
    order = np.array([*range(first), *errors, *range(first, len(whole))], dtype=np.intp)
    owned = np.array([*[-1] * known.size, *owners], dtype=np.intp)  # faults are of no term
    at = np.ix_(order, order)
    total = whole[at]
    moves = moves[:, order[free:] - free]
    moves[:, first - free + len(errors)] *= known.size > 0
    stays = ~made_up[order[free:]]
    stay = np.outer(stays, stays)
    left = np.empty((len(grams), *stay.shape), np.float32)
    for number in range(len(grams)):
        left[number] = beside(grams.pop(0)[at], moves) * stay
    return Front(left, beside(total, moves) * stay, moves, np.append(known, precision), owned, layout.tangents)


def form_errors(
    total: Array, first: int, layout: Layout, model: Model, candidates: Sequence[Candidate]
) -> tuple[list[int], list[float], list[int]]:
    """Columns that are errors of the forms of terms, how precisely each is known to be none, and of which term it is.

    The law that acts is not quite that of a term. What it is beside it is thought to be a sum of the other forms of
    the cause, of the same thing, normal, together ``FORM_ERROR`` of the force of the term. ``total`` are the
    squares of what the base leaves of the columns: a spring that softens beside another one is as strong as what it
    changes.
    """
    places: list[int] = []
    precision: list[float] = []
    owners: list[int] = []
    for number, term in enumerate(model.terms[: layout.terms]):
        size = total[first + layout.term(number)]
        if isinstance(term, Given) or size < RIDGE * total[first]:
            continue  # a term without a force has no form that could err
        alike = [at for one in candidates if one.name == term.name for at in one.columns_of(term.changes)]
        columns = first + layout.first_candidate + np.array(alike, dtype=np.intp)
        columns = columns[total[columns] > 0.0]
        places += columns.tolist()
        precision += (columns.size * total[columns] / (FORM_ERROR**2 * size)).tolist()
        owners += [number] * columns.size
    return places, precision, owners


def in_front(total: Array, precision: Array) -> Array:
    """The strengths (f, c) with which the first columns of a Gram matrix (f + c, f + c) take up each of the others.

    ``precision`` (f,) is what is known of them beforehand. They are fitted on all runs, and not left out with a group:
    where a run alone reaches a deflection, the curve of the base there cannot be predicted from others, and says
    nothing of the terms.
    """
    return covariance(total, precision) @ total[: precision.size, precision.size :]


def covariance(total: Array, precision: Array) -> Array:
    """The covariance (f, f) of the strengths of the first columns, of which so much is known beforehand."""
    return _inverse(total[: precision.size, : precision.size] + np.diag(precision))


def _inverse(matrix: Array) -> Array:
    """The inverse (f, f) of a positive matrix; of what is not told in it, the smallest."""
    root = _inverse_root(matrix)
    return np.asarray(root.T @ root)


def _inverse_root(matrix: Array) -> Array:
    """A root (rank, f) of the inverse of a positive matrix (f, f): its transpose times it is the inverse."""
    scale = np.sqrt(np.maximum(np.diag(matrix), 1e-300))
    sizes, axes = np.linalg.eigh(matrix / np.outer(scale, scale))
    told = sizes > 1e-11 * sizes.max(initial=0.0)
    found: Array = (axes[:, told] / np.sqrt(sizes[told])).T / scale
    return found


def occam(total: Array, precision: Array) -> float:
    """The nats by which the marginal likelihood is below that of the best strengths of the first columns."""
    deviations = np.sqrt(precision)
    inner = total[: precision.size, : precision.size] / np.outer(deviations, deviations)
    return 0.5 * float(np.linalg.slogdet(inner + np.eye(precision.size))[1])


def beside(gram: Array, moves: Array) -> Array:
    """The Gram matrix (c, c) of columns after the first ones take up ``moves`` (f, c) of each."""
    first = len(moves)
    cross = gram[first:, :first] @ moves
    left: Array = gram[first:, first:] + moves.T @ gram[:first, :first] @ moves
    left -= cross
    left -= cross.T
    return left
