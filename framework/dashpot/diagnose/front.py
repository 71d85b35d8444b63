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
class Beside:
    """Columns with those in front fitted to each on all runs.

    ``moves`` (e, c) are the strengths of the columns in front that take up one of each, ``base_moves`` (b, c) those of
    the base, ``squares`` (c,) the residual of the columns. ``gram`` (c, c) is the Gram matrix of all runs, and of what
    is known beforehand, of columns divided by their ``scale`` (c,). ``precision`` (e,) is that of the columns in front,
    ``tangents`` how many parameters terms have, and ``occam`` the nats by which the marginal likelihood is below
    that of the best strengths. ``grams`` (groups, e + c, e + c) are those of the groups, before anything is fitted.
    """

    columns: NDArray[np.intp]
    moves: Array
    base_moves: Array
    squares: Array
    scale: Array
    gram: Array
    precision: Array
    tangents: int
    occam: float
    grams: NDArray[np.floating]

    @property
    def nbytes(self) -> int:
        """The bytes of its matrices."""
        return (
            self.moves.nbytes + self.base_moves.nbytes + self.gram.nbytes + len(self.grams) * 8 * len(self.moves) ** 2
        )

    @cached_property
    def _inner(self) -> Array:
        """The Gram matrices (groups, e, e) of the columns in front."""
        front = self.columns[: len(self.moves)]
        return self.grams[:, front[:, None], front].astype(float)

    def groups(self, combined: Array) -> Array:
        """The Gram matrices (groups, k, k) of combinations (c, k) of these columns, by the group of runs."""
        used, kept = np.flatnonzero(combined.any(axis=1)), len(self.moves)
        front, at, own = self.columns[:kept], self.columns[kept + used], combined[used]
        taken = self.moves[:, used] @ own
        cross = own.T @ self.grams[:, at[:, None], front] @ taken
        found: Array = own.T @ self.grams[:, at[:, None], at] @ own + taken.T @ (self._inner @ taken)
        found -= cross
        found -= cross.transpose(0, 2, 1)
        return found

    def unlikely(self, strengths: Array) -> float:
        """How unlikely a combination (c,) of the columns is beforehand, in nats."""
        in_front = self.precision @ (self.moves @ strengths) ** 2
        numbers = np.sum(strengths[1 : 1 + self.tangents] ** 2)  # one natural size is their standard deviation
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

    def _without(self, gone: frozenset[int]) -> Beside:
        return self._part(self.beside(), np.isin(self.owners, list(gone))) if gone else self._beside_all()

    def _beside_all(self) -> Beside:
        first, total, precision = self.precision.size, self.total, self.precision
        moves = in_front(total, precision)
        gram = beside(total, moves)
        squares = np.diag(gram).copy()
        gram += moves.T @ (precision[:, None] * moves)
        numbers = range(1, 1 + self.tangents)
        gram[numbers, numbers] += 1.0
        # below that share of a column what the others leave of it is rounding
        scale = np.sqrt(np.maximum(np.maximum(squares, RIDGE * np.diag(total)[first:]), 1e-300))
        gram /= np.outer(scale, scale)
        base = self.base_moves[:, first:] - self.base_moves[:, :first] @ moves
        columns = np.arange(len(total))
        nats = occam(total, precision)
        return Beside(columns, moves, base, squares, scale, gram, precision, self.tangents, nats, self.grams)

    def _part(self, whole: Beside, going: NDArray[np.bool_]) -> Beside:
        """The same where some of the columns in front are ``going`` (e,): a change of their rank."""
        first, kept = self.precision.size, np.flatnonzero(~going)
        pull = _inverse(self._covariance[np.ix_(going, going)]) @ whole.moves[going]
        moves = whole.moves[kept] - self._covariance[np.ix_(kept, going)] @ pull
        comes_back = (whole.moves[going] / whole.scale).T @ (pull / whole.scale)
        base = self.base_moves[:, first:] - self.base_moves[:, kept] @ moves
        columns = np.concatenate([kept, np.arange(first, len(self.total))])
        precision, gram = self.precision[kept], whole.gram + comes_back
        squares = np.diag(gram) * whole.scale**2 - precision @ moves**2
        squares[1 : 1 + self.tangents] -= 1.0
        nats = occam(self.total[np.ix_(kept, kept)], precision)
        return Beside(columns, moves, base, squares, whole.scale, gram, precision, self.tangents, nats, self.grams)

    @cached_property
    def _covariance(self) -> Array:
        """The covariance (e, e) of the strengths of the columns in front."""
        return covariance(self.total, self.precision)


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
    scale = np.sqrt(np.maximum(np.diag(matrix), 1e-300))
    unit = np.outer(scale, scale)
    found: Array = np.linalg.pinv(matrix / unit, rcond=1e-11, hermitian=True) / unit
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
