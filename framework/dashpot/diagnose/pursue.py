"""From a fitted network to the best structure: look, search, refit the best few, until none is better.

What is refitted is judged by the same score as what was searched. At the end every term has to be worth its place: the
structure without it is refitted, and so are those with another cause in its place.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Cause, ChannelFault
from dashpot.diagnose.evidence import has_evidence
from dashpot.diagnose.look import Look, look_at
from dashpot.diagnose.refit import Refitter
from dashpot.diagnose.score import Odds, Scores, Structure
from dashpot.diagnose.search import search
from dashpot.diagnose.term import Model, Term
from dashpot.fit.refine import Outcome
from dashpot.text.problem import InputError

Array = NDArray[np.float64]

REFITTED = 2  # structures with one change, and as many with more, at each look
TRIED = 5  # for these; some cannot be written, or have no evidence
MOST_LOOKS = 12
DRAWS = 200
NAMED = 0.9  # of the draws: probability from which on a cause is named


@dataclass(frozen=True, eq=False)
class Scored:
    """A refitted structure and what it predicts.

    ``nats`` (groups,) are minus the log likelihood of each group left out with errors of forms allowed for, ``errors``
    the nats that these errors cost, ``exact`` (groups,) the same as ``nats`` with the laws as they are, ``price`` the
    prior of the terms.
    """

    model: Model
    nats: Array
    errors: float
    exact: Array
    samples: Array
    price: float

    @property
    def score(self) -> float:
        """Minus the log of likelihood and prior."""
        return float(self.nats.sum()) + self.errors + self.price

    def drawn(self, weights: Array) -> Array:
        """The score (draws,) under weights (draws, groups) of the groups."""
        return weights @ self.nats + self.errors + self.price

    def drawn_exactly(self, weights: Array) -> Array:
        """The score (draws,) with the laws as they are."""
        return weights @ self.exact + self.price


@dataclass(frozen=True, eq=False)
class Without:
    """The structure without one term, refitted, and the share of draws in which it is the worse one."""

    term: Term
    scored: Scored
    share: float


@dataclass(frozen=True, eq=False)
class Pursuit:
    """The best structure, the last look at it, and what was refitted beside it at the end.

    ``without`` has the structures without each term, ``rivals`` those with another cause in its place. ``first`` is the
    model that was diagnosed, ``ended`` whether the search came to its end, ``refused`` what could not be written.
    """

    best: Scored
    look: Look
    first: Model
    without: tuple[Without, ...]
    rivals: tuple[tuple[Term, Scored], ...]
    weights: Array
    looks: int
    ended: bool
    refused: tuple[tuple[Term, str], ...] = ()

    def probability(self, name: tuple[str, str]) -> float:
        """The share of draws in which the best of all these structures has a cause."""
        pool = [self.best, *(one.scored for one in self.without), *(one for _, one in self.rivals)]
        best = np.argmin([one.drawn(self.weights) for one in pool], axis=0)
        return float(np.mean([name in pool[number].model.names for number in best]))


@dataclass(eq=False)
class Pursuer:
    """What the steps of a pursuit share."""

    refitter: Refitter
    causes: Sequence[type[Cause]]
    groups: Mapping[str, str]
    relevance: float
    seed: int
    watch: Callable[[int, int], None] = lambda looks, terms: None
    faults: Sequence[ChannelFault] = ()
    refused: list[tuple[Term, str]] = field(default_factory=list)

    def run(self, model: Model, look: Look | None = None) -> Pursuit:
        """Search from a fitted model until no refitted structure scores better, then let go what is not needed."""
        first, look, ended, looks = model, look or self.look(model), False, 0
        seen: set[frozenset[object]] = set()
        while True:
            look, looks, ended = self.climbed(look, looks)
            fitted, odds = self.refitter.fit(look.model, look.noise), Odds(look.layout.bank)
            present, without = self.pruned(look, self.scored(look, fitted, odds), odds)
            if present.model.names != look.model.names:
                look = self.look(present.model)
            rivals = tuple(self.rivals(Scores(look), search(Scores(look)))) if present.model.terms else ()
            seen.add(present.model.forms)
            fresh = (rival for _, rival in rivals if rival.model.forms not in seen)
            better = min(fresh, key=lambda one: one.score, default=present)
            if not ended or not better.score < present.score:
                weights = self.weights(len(look.groups))
                return Pursuit(present, look, first, without, rivals, weights, looks, ended, tuple(self.refused))
            look = self.look(better.model)

    def climbed(self, look: Look, looks: int) -> tuple[Look, int, bool]:
        """The look at a structure than which none of those refitted is better, and whether it was reached."""
        while looks < MOST_LOOKS:
            looks += 1
            self.watch(looks, len(look.model.terms))
            scores = Scores(look)
            present = self.scored(look, look.model, scores.odds)
            trials = (trial for trial in self.trials(scores, search(scores)) if self._surely(trial, present))
            best = min(trials, key=lambda trial: trial.score, default=present)
            if not best.score < present.score:
                return look, looks, True
            look = self.look(best.model)
        return look, looks, False

    def look(self, model: Model) -> Look:
        """All candidates beside a model."""
        return look_at(self.refitter, model, self.causes, self.groups, faults=self.faults)

    def weights(self, groups: int) -> Array:
        """Random weights (draws, groups) of the groups, exponential with mean one (Bayesian bootstrap; Rubin 1981)."""
        draws = np.random.default_rng(self.seed).exponential(size=(DRAWS, groups))
        return draws / draws.mean(axis=1, keepdims=True)

    def scored(self, look: Look, model: Model, odds: Odds) -> Scored:
        """What a fitted model predicts under the noise of a look, its numbers left free to first order."""
        return scored_by(self.scores_of(look, model), odds)

    def scores_of(self, look: Look, model: Model) -> Scores:
        """A fitted model under the noise of a look, with the forms of its own causes only."""
        causes = list(dict.fromkeys(term.cause for term in model.terms))
        known = look.candidates
        return Scores(look_at(self.refitter, model, causes, self.groups, look.noise, self.faults, known))

    def trials(self, scores: Scores, ranked: Iterable[Structure]) -> Iterator[Scored]:
        """The best few structures of different terms that score better than the present one, refitted."""
        present, names = scores.score(Structure()), set()
        many, tried = {True: 0, False: 0}, {True: 0, False: 0}
        for structure in ranked:
            key, single = _key(scores, structure), structure.size == 1
            wanted = many[single] < REFITTED and tried[single] < TRIED
            if structure.size and key not in names and wanted and scores.score(structure) < present:
                names.add(key)
                tried[single] += 1
                trial = self.refitted(scores, structure)
                if trial:
                    many[single] += 1
                    yield trial

    def refitted(self, scores: Scores, structure: Structure) -> Scored | None:
        """A structure refitted; None for one that cannot be written, or whose numbers are not what it is called."""
        terms, look = terms_of(scores, structure), scores.look
        try:
            trial = self.refitter.refit(look.model, terms, look.noise, scores.moves(structure))
        except InputError as error:
            self.refused += [(term, str(error)) for term in terms if term not in look.model.terms]
            return None
        if trial.outcome is Outcome.FAILED or not trial.keeps_all:
            return None
        if not all(term.suspect.admits(trial.numbers_of(k)) for k, term in enumerate(trial.terms)):
            return None
        seen = self.scores_of(look, trial)
        if not all(has_evidence(self.refitter, seen, number) for number in range(len(trial.terms))):
            return None
        return scored_by(seen, scores.odds)

    def pruned(self, look: Look, present: Scored, odds: Odds) -> tuple[Scored, tuple[Without, ...]]:
        """The structure without the terms that are not worth their place, the weakest first, and what each is worth."""
        weights = self.weights(present.nats.size)
        while True:
            found, seen = [], self.scores_of(look, present.model)
            for number, term in enumerate(present.model.terms):
                rest = [other for other in present.model.terms if other is not term]
                rest = self.refitter.writable(present.model, rest)
                scored = self.scored(look, self.refitter.refit(present.model, rest, look.noise), odds)
                share = float(np.mean(scored.drawn_exactly(weights) > present.drawn_exactly(weights)))
                worth = self._matters(present, scored) and has_evidence(self.refitter, seen, number)
                found.append(Without(term, scored, share if worth else 0.0))
            weakest = min(found, key=lambda one: (one.share, one.scored.score), default=None)
            if weakest is None or weakest.share >= NAMED:
                return present, tuple(found)
            present = weakest.scored

    def _surely(self, trial: Scored, present: Scored) -> bool:
        """Whether a larger structure predicts more than its prior odds, by the draws, with the laws as they are."""
        weights = self.weights(present.exact.size)
        better = trial.drawn_exactly(weights) < present.drawn_exactly(weights)
        return trial.price <= present.price or float(np.mean(better)) >= NAMED

    def _matters(self, present: Scored, without: Scored) -> bool:
        """Whether the error grows by what is of interest when a term goes."""
        total = float(np.sum(without.exact - present.exact))
        return total > float(without.samples.sum()) * self.relevance

    def rivals(self, scores: Scores, ranked: Iterable[Structure]) -> Iterator[tuple[Term, Scored]]:
        """For each term the best structure with another cause in its place, refitted."""
        look = scores.look
        wanted = set(range(len(look.model.terms)))
        for structure in ranked:
            gone, new = structure.dropped, [look.candidates[k] for k, _ in structure.added]
            if len(gone) == 1 and len(new) == 1 and gone <= wanted:
                (number,) = gone
                if new[0].name not in look.model.names and (trial := self.refitted(scores, structure)):
                    wanted -= gone
                    yield look.model.terms[number], trial


def scored_by(scores: Scores, odds: Odds) -> Scored:
    """What the model of a look predicts, as it is."""
    nats, found, model = scores.nats(Structure()), scores.predicted(Structure()), scores.look.model
    assert nats is not None and found is not None
    errors = found[1] + scores.look.occam
    return Scored(model, nats, errors, scores.exact_nats(), scores.look.samples, odds.of_model(model))


def _key(scores: Scores, structure: Structure) -> frozenset[tuple[object, ...]]:
    """Terms that go and forms that join, whatever their places."""
    joins = ((scores.look.candidates[k].name, scores.look.candidates[k].suspect.form) for k, _ in structure.added)
    return frozenset([*((number,) for number in structure.dropped), *joins])


def terms_of(scores: Scores, structure: Structure) -> list[Term]:
    """The terms of a structure: those of the model that stay, then the new ones at the strengths that are foreseen."""
    look = scores.look
    found = [term for number, term in enumerate(look.model.terms) if number not in structure.dropped]
    strengths = scores.strengths(structure)
    at = strengths.size - len(scores.atoms(structure))
    for k, places in sorted(structure.added):
        candidate = look.candidates[k]
        mine = strengths[at : at + len(places)]
        at += len(places)
        grid = candidate.suspect.grid
        atoms = tuple((float(strength), grid[place]) for strength, place in zip(mine, places, strict=True))
        found.append(Term(candidate.cause, candidate.suspect, atoms, candidate.site))
    return found
