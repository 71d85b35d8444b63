"""What is refitted beside every structure: the numbers of the base, doubted faults, and errors of the forms of terms.

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
from dashpot.diagnose.term import Model

Array = NDArray[np.float64]

RIDGE = 1e-9
REACH = 1.0  # natural sizes (a factor of e) by which the linear step may move a number
FORM_ERROR = 0.1  # of the force of a term: how far the law of an element may be from the one that acts

NONE = frozenset[int]()


@dataclass(frozen=True, eq=False)
class Beside:
    """Columns with those in front fitted to each on all runs.

    ``moves`` (e, c) are the strengths of the columns in front that take up one of each, ``base_moves`` (b, c) those of
    the base; ``total`` (c, c) is the Gram matrix of all runs, ``prior`` (c, c) how unlikely the strengths are, and
    ``occam`` the nats by which the marginal likelihood is below that of the best strengths.
    """

    columns: NDArray[np.intp]
    moves: Array
    base_moves: Array
    total: Array
    prior: Array
    occam: float


@dataclass(eq=False)
class Front:
    """``grams`` (groups, e + c, e + c) of columns beside the base, of which ``base_moves`` (b, e + c) take up each.

    The first e have a ``precision`` (e,) known beforehand; ``owners`` (e,) are the terms of whose form they are errors,
    -1 for those of none. The next columns are the residual and ``tangents`` of terms.
    """

    grams: Array
    base_moves: Array
    precision: Array
    owners: NDArray[np.intp]
    tangents: int
    _known: dict[frozenset[int], Beside] = field(default_factory=dict)

    @cached_property
    def _sum(self) -> Array:
        return self.grams.sum(axis=0)

    def beside(self, gone: frozenset[int] = NONE) -> Beside:
        """The columns where some terms are ``gone``, and with them the errors of their forms."""
        if gone not in self._known:
            first = self.precision.size
            kept = np.flatnonzero(~np.isin(self.owners, list(gone)))
            columns = np.concatenate([kept, np.arange(first, len(self._sum))])
            total, moves, prior, occam = beside_base(
                self._sum[np.ix_(columns, columns)][None], self.precision[kept], free=0
            )
            numbers = range(1, 1 + self.tangents)
            prior[numbers, numbers] += REACH**-2.0
            base = self.base_moves[:, first:] - self.base_moves[:, kept] @ moves
            self._known[gone] = Beside(columns, moves, base, total[0], prior, occam)
        return self._known[gone]

    def groups(self, combined: Array, gone: frozenset[int] = NONE) -> Array:
        """The Gram matrices (groups, k, k) of combinations (c, k) of these columns, where some terms are ``gone``."""
        found, kept = self.beside(gone), self.precision.size
        used = np.flatnonzero(combined.any(axis=1))
        front = found.columns[: len(found.moves)]
        at = np.concatenate([front, kept + used])
        whole = np.vstack([-found.moves[:, used] @ combined[used], combined[used]])
        left: Array = whole.T @ self.grams[:, at[:, None], at] @ whole
        return left


def front_of(
    grams: Array, known: Array, free: int, layout: Layout, model: Model, candidates: Sequence[Candidate]
) -> Front:
    """From Gram matrices (groups, f + c, f + c) behind ``free`` columns of the base and ``known`` (f - free,) ones."""
    first = free + known.size
    errors, precision, owners = form_errors(np.einsum("gii->i", grams), first, layout, model, candidates)
    order = np.array([*range(first), *errors, *range(first, grams.shape[1])], dtype=np.intp)
    left, moves, _, _ = beside_base(grams[:, order][:, :, order] if errors else grams, np.zeros(free), free)
    # faults are of no term
    owned = np.array([*[-1] * known.size, *owners], dtype=np.intp)
    return Front(left, moves, np.append(known, precision), owned, layout.tangents)


def form_errors(
    total: Array, first: int, layout: Layout, model: Model, candidates: Sequence[Candidate]
) -> tuple[list[int], list[float], list[int]]:
    """Columns that are errors of the forms of terms, how precisely each is known to be none, and of which term it is.

    The law that acts is not quite that of a term. What it is beside it is thought to be a sum of the other forms of the
    cause, normal, together ``FORM_ERROR`` of the force of the term. ``total`` are the squares of the columns.
    """
    places: list[int] = []
    precision: list[float] = []
    owners: list[int] = []
    for number, term in enumerate(model.terms[: layout.terms]):
        size = total[first + layout.term(number)]
        if size < RIDGE * total[first]:
            continue  # a term without a force has no form that could err
        alike = [at for one in candidates if one.name == term.name for at in range(one.columns.start, one.columns.stop)]
        columns = first + layout.first_candidate + np.array(alike, dtype=np.intp)
        columns = columns[total[columns] > 0.0]
        places += columns.tolist()
        precision += (columns.size * total[columns] / (FORM_ERROR**2 * size)).tolist()
        owners += [number] * columns.size
    return places, precision, owners


def beside_base(grams: Array, precision: Array, free: int) -> tuple[Array, Array, Array, float]:
    """Gram matrices (groups, c, c) of all columns behind the first ones, with these fitted to each on all runs.

    ``precision`` (f,) is what is known of the strengths of the first columns beforehand, nothing of the ``free`` ones.
    Also the strengths (f, c) of that fit, their prior (c, c), and the nats by which the marginal likelihood is below
    that of the best strengths. The base itself is not left out with a group: where a run alone reaches a deflection,
    its curve there is not to be foretold by others, and says nothing of the terms.
    """
    first = precision.size
    total = grams.sum(axis=0)
    inner = total[:first, :first] + np.diag(precision)
    scale = np.sqrt(np.maximum(np.diag(inner), 1e-300))
    unit = inner / np.outer(scale, scale)
    moves = np.linalg.pinv(unit, rcond=1e-11, hermitian=True) @ (total[:first, first:] / scale[:, None])
    moves /= scale[:, None]
    left = np.array([_beside(gram, moves) for gram in grams])
    prior = moves[free:].T @ (precision[free:, None] * moves[free:])
    outside = np.linalg.pinv(unit[:free, :free], rcond=1e-11, hermitian=True)
    beside = unit[free:, free:] - unit[free:, :free] @ outside @ unit[:free, free:]
    sizes = np.linalg.eigvalsh(
        beside * np.outer(scale[free:], scale[free:]) / np.sqrt(np.outer(precision[free:], precision[free:]))
    )
    return left, moves, prior, 0.5 * float(np.log(np.maximum(sizes, 1.0)).sum())


def _beside(gram: Array, moves: Array) -> Array:
    """The Gram matrix (c, c) of columns after the first ones take up ``moves`` (f, c) of each."""
    first = len(moves)
    cross = gram[first:, :first] @ moves
    left = gram[first:, first:] + moves.T @ gram[:first, :first] @ moves
    left -= cross
    left -= cross.T
    return left
