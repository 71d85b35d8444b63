"""A beam search over structures, on the Gram matrices of one look: add, drop and swap."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from dashpot.diagnose.candidate import Candidate
from dashpot.diagnose.exclusive import can_be_beside, dependent_numbers
from dashpot.diagnose.front import NONE, Gram
from dashpot.diagnose.score import Added, Scores, Structure, steadied
from dashpot.diagnose.term import Term

Array = NDArray[np.float64]

BEAM = 3
MOST_ADDED = 2  # at one look; a refit and another look follow
PROPOSED = 8
LEFT = 1e-5  # of the square of a column must be left beside the others
SAME = 1e-6  # nats: forms of a cause that are told apart by a refit only, as a line and an exponential
STALE = 2  # steps of the beam without a better structure


def search(scores: Scores, stay: frozenset[int] = NONE, gone: frozenset[int] = NONE) -> list[Structure]:
    """The structures that were scored, best first: from the present one by adding, dropping and swapping terms.

    Some terms are to ``stay``, and others are ``gone`` from the start and do not come back.
    """
    start = Structure(gone)
    front, seen, best, stale = [start], {start}, scores.score(start), 0
    while front and stale < STALE:
        moves = {move for one in front for move in moves_from(scores, one, stay, gone)} - seen
        seen |= moves
        grouped = sorted(moves, key=lambda one: sorted(one.dropped))  # beside the same terms one after the other
        ranked = sorted(grouped, key=scores.score)
        front = [one for one in ranked if np.isfinite(scores.score(one))][:BEAM]
        now = min((scores.score(one) for one in front), default=np.inf)
        stale = 0 if now < best - 1e-9 else stale + 1
        best = min(best, now)
    return sorted(
        (one for one in seen if np.isfinite(scores.score(one))), key=lambda one: (scores.score(one), one.size)
    )


def moves_from(
    scores: Scores, structure: Structure, stay: frozenset[int] = NONE, gone: frozenset[int] = NONE
) -> set[Structure]:
    """All structures one step away that the score test proposes; some terms are to ``stay``, others are ``gone``."""
    may_go, may_come = set(range(len(scores.kinds))) - structure.dropped - stay, structure.dropped - gone
    found = {Structure(structure.dropped | {number}, structure.added) for number in may_go}
    found |= {Structure(structure.dropped - {number}, structure.added) for number in may_come}
    if len(structure.added) < MOST_ADDED:
        found |= {Structure(structure.dropped, structure.added | {one}) for one in additions(scores, structure)}
    for term in structure.added:
        less = Structure(structure.dropped, structure.added - {term})
        found |= {less} | {Structure(less.dropped, less.added | {one}) for one in additions(scores, less)[:4]}
    for going in [*combinations(may_go, 1), *combinations(may_go, 2)]:  # exchanged, or merged into one law
        less = Structure(structure.dropped | set(going), structure.added)
        if len(structure.added) < MOST_ADDED:
            found |= {Structure(less.dropped, less.added | {one}) for one in additions(scores, less)[:4]}
    return {one for one in found if can_be_beside(scores, one)}


@dataclass(frozen=True, eq=False)
class _Projected:
    """Scores ``right`` (m,) and squares ``sizes`` (m,) of the candidates' columns, everything in a structure projected
    out. A unit of the square of the residual is worth ``nats``.

    ``whole`` is the Gram matrix before that, in which the columns stand at ``places`` (m,), ``across`` (k, m) are their
    products with the k columns of the structure, and ``solved`` (k, m) the strengths of these that take up one of each.
    """

    right: Array
    sizes: Array
    nats: float
    whole: Gram
    places: NDArray[np.intp]
    across: Array
    solved: Array

    def gram(self, at: NDArray[np.intp]) -> Array:
        """The Gram matrix (n, n) of some columns."""
        own = self.places[at]
        left: Array = self.whole.block(own, own) - self.across[:, at].T @ self.solved[:, at]
        return left


def additions(scores: Scores, structure: Structure) -> list[Added]:
    """The candidates that explain most beside a structure (score test), the best places of each; best first."""
    left, taken = _project(scores, structure), dependent_numbers(scores, structure)
    used = {k for k, _ in structure.added} | _gone(scores, structure) | _same_fault(scores, structure)
    found = []
    for k, candidate in enumerate(scores.look.candidates):
        open_to = [number not in taken for number in candidate.suspect.each_dependent]
        if candidate.provable and k not in used and (best := _places(candidate, left, open_to)):
            added = Added(k, best[1])
            found.append((best[0] - scores.joining(added), added))
    found.sort(key=lambda pair: -round(pair[0] / SAME))
    return _varied(scores, found)


def other_forms(scores: Scores, number: int) -> list[Structure]:
    """A term of the model in other forms of its cause or of more parts, where these explain most; best first."""
    term, gone = scores.look.model.terms[number], frozenset({number})
    assert isinstance(term, Term)
    left, taken, found = _project(scores, Structure(gone)), dependent_numbers(scores, Structure(gone)), []
    for k, candidate in enumerate(scores.look.candidates):
        changed = zip(candidate.suspect.each_of, candidate.suspect.each_dependent, strict=True)
        same = [thing in term.changes and number not in taken for thing, number in changed]
        best = _places(candidate, left, same) if candidate.name == term.name else None
        if best and (candidate.suspect.form != term.suspect.form or len(best[1]) > len(term.atoms)):
            found.append(Structure(gone, frozenset({Added(k, best[1])})))
    return sorted(found, key=scores.score)


def _same_fault(scores: Scores, structure: Structure) -> set[int]:
    """The other forms of faults of the measurement that are there: one against the other they would be any law."""
    candidates, terms = scores.look.candidates, enumerate(scores.look.model.terms)
    faults = {candidates[k].name for k, _ in structure.added if candidates[k].cause.kind == "measurement"}
    faults |= {term.name for k, term in terms if term.kind == "measurement" and k not in structure.dropped}
    return {k for k, one in enumerate(candidates) if one.name in faults}


def _gone(scores: Scores, structure: Structure) -> set[int]:
    """The candidates that are terms which go: coming back elsewhere is left to the refit."""
    terms = [scores.look.model.terms[number] for number in structure.dropped]
    gone = {term.form for term in terms}
    return {k for k, one in enumerate(scores.look.candidates) if (one.name, one.suspect.form) in gone}


def _varied(scores: Scores, ordered: Sequence[tuple[float, Added]]) -> list[Added]:
    """The first few, each behind its nats: at most two forms of a cause, of those that are the same to first order the
    first.
    """
    kept: dict[Added, float] = {}
    for gain, added in ordered:
        name = scores.look.candidates[added.candidate].name
        known = [nats for other, nats in kept.items() if scores.look.candidates[other.candidate].name == name]
        if len(known) < 2 and not any(abs(gain - nats) < SAME for nats in known):
            kept[added] = gain
    return list(kept)[:PROPOSED]


def _project(scores: Scores, structure: Structure) -> _Projected:
    at, target, gram = scores.columns(structure), scores.target(structure), scores.gram(structure.dropped)
    bank = np.arange(scores.look.layout.first_candidate, target.size)
    told, across, of_target = gram.times(at, target), gram.block(at, bank), np.flatnonzero(target)
    taken = np.linalg.solve(steadied(gram.block(at, at)), np.column_stack([told, across]))
    strengths, solved = taken[:, 0], np.asarray(taken[:, 1:], dtype=float)
    sizes = gram.diagonal[bank] - np.einsum("kc,kc->c", across, solved)
    square = float(target[of_target] @ gram.times(of_target, target) - strengths @ told)
    samples = float(scores.look.samples.sum())
    # per unit of the residual, so that a gain in squares is one in nats
    nats = 0.5 * samples / max(square, 1e-300)
    return _Projected(gram.times(bank, target) - solved.T @ told, sizes, nats, gram, bank, across, solved)


def _places(candidate: Candidate, left: _Projected, open_to: Sequence[bool]) -> tuple[float, tuple[int, ...]] | None:
    """The places of a candidate, of those ``open_to`` it, that explain most together, and the gain in nats less that
    of chance.
    """
    suspect, own = candidate.suspect, np.arange(candidate.columns.start, candidate.columns.stop)
    right, sizes = left.right[own], left.sizes[own]
    alive = np.flatnonzero((sizes > LEFT) & open_to)
    if not alive.size:
        return None
    if suspect.joint:
        return _jointly(left.gram(own[alive]), right[alive], alive, left.nats, bool(suspect.sign))
    strengths = right[alive] / sizes[alive]
    alone = strengths * right[alive]
    if suspect.sign:
        alone[strengths < 0.0] = -np.inf
    chosen = [int(alive[np.argmax(alone)])]
    best = float(alone.max()) * left.nats - (1 + suspect.unknowns), tuple(chosen)
    if best[0] <= 0.0:
        return None
    matrix = left.gram(own) if suspect.most > 1 else np.empty((0, 0))
    while len(chosen) < min(suspect.most, alive.size):
        gains = _gains(matrix, right, chosen, bool(suspect.sign))
        j = int(alive[np.argmax(gains[alive])])
        nats = float(gains[j]) * left.nats - (len(chosen) + 1) * (1 + suspect.unknowns)
        if nats <= best[0]:
            break
        chosen.append(j)
        best = nats, tuple(chosen)
    return best


def _jointly(
    gram: Array, right: Array, alive: NDArray[np.intp], nats: float, positive: bool
) -> tuple[float, tuple[int, ...]] | None:
    """Of the places ``alive`` all that explain something together, and what they do."""
    from scipy.optimize import nnls

    matrix = gram + 1e-7 * np.eye(alive.size)
    if positive:
        sizes, axes = np.linalg.eigh(matrix)
        root = np.sqrt(np.maximum(sizes, 1e-9 * sizes[-1]))
        strengths = nnls(root[:, None] * axes.T, axes.T @ right / root)[0]
    else:
        strengths = np.linalg.solve(matrix, right)
    kept = alive[strengths != 0.0]
    gain = 2.0 * right @ strengths - strengths @ matrix @ strengths
    return (gain * nats - kept.size, tuple(int(j) for j in kept)) if kept.size else None


def _gains(matrix: Array, right: Array, chosen: list[int], positive: bool) -> Array:
    """What each column (m,) explains together with those ``chosen``; -inf for one of these or of the wrong sign."""
    inner, across = matrix[np.ix_(chosen, chosen)], matrix[chosen]
    solved = np.linalg.solve(inner, np.column_stack([across, right[chosen]]))
    across_solved, alone = solved[:, :-1], solved[:, -1]
    sizes = np.diag(matrix) - np.sum(across * across_solved, axis=0)
    rest = right - alone @ across
    free = sizes > LEFT
    strengths = np.divide(rest, sizes, out=np.zeros_like(rest), where=free)
    gains = np.where(free, right[chosen] @ alone + strengths * rest, -np.inf)
    if positive:
        gains[(strengths < 0.0) | (alone[:, None] < across_solved * strengths).any(axis=0)] = -np.inf
    gains[chosen] = -np.inf
    return gains
