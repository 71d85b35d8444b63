"""From a fitted network to the best structure: look, search, refit the best few, until none is better.

What is refitted is judged by the same score as what was searched. At the end every term has to be worth its place: the
structure without it is refitted, and so are those with another cause in its place.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Cause
from dashpot.diagnose.evidence import has_evidence, is_determined
from dashpot.diagnose.folds import Folds
from dashpot.diagnose.location import of_names
from dashpot.diagnose.look import Doubt, Look, look_at, look_settled
from dashpot.diagnose.pursuit import NAMED, Form, Pursuit, Scored, Without
from dashpot.diagnose.refit import Refitter
from dashpot.diagnose.score import NUMBER_ODDS, Odds, Scores, Structure
from dashpot.diagnose.search import search
from dashpot.diagnose.term import Model, Term
from dashpot.fit.refine import Outcome
from dashpot.kernel.workers import forked
from dashpot.text.problem import InputError

Array = NDArray[np.float64]

REFITTED = 2  # structures with one change, and as many with more, at a time
TRIED = 5  # of these at a look, and of the rivals of a term, until one is better
MOST_LOOKS = 12
DRAWS = 200
Key = frozenset[tuple[object, ...]]  # numbers of terms that go, and forms that join


@dataclass(eq=False)
class Pursuer:
    """What the steps of a pursuit share.

    ``looked`` is the look to go on from, let go when it is used; ``looks`` counts them, and ``ended`` says whether the
    search came to its end.
    """

    refitter: Refitter
    causes: Sequence[type[Cause]]
    folds: Folds
    relevance: float
    seed: int
    watch: Callable[[int, int], None] = lambda looks, terms: None
    doubted: Sequence[Doubt] = ()
    looked: Look | None = field(default=None, init=False)
    refused: list[str] = field(default_factory=list, init=False)
    looks: int = field(default=0, init=False)
    ended: bool = field(default=False, init=False)

    def run(self, model: Model) -> Pursuit:
        """Search from a fitted model until no refitted structure scores better, then let go what is not needed."""
        self.looked = self.look(model)
        seen: set[frozenset[object]] = set()
        while True:
            look, present, without, others = self.local_optimum(seen)
            scores = Scores(look)
            rivals = self.rivals(scores, search(scores)) if present.model.terms else []
            del scores
            seen.add(present.model.forms)
            fresh = [rival for _, rival in rivals if rival.model.forms not in seen]
            onward = self._onward(look, fresh, present) if self.ended else None
            if onward is None:
                weights = self.weights(len(look.folds.names))
                found = (present, look, model, without, tuple(rivals), tuple(others), weights)
                return Pursuit(*found, self.looks, self.ended, tuple(self.refused))
            del look  # a look is large
            self.looked = self._all_candidates(onward)

    def local_optimum(self, seen: set[frozenset[object]]) -> tuple[Look, Scored, tuple[Without, ...], list[Scored]]:
        """The look at the best structure, all terms of which are worth their place, and what was refitted beside it.

        Where terms go the search continues from the rest, unless that was ``seen``.
        """
        look, others = self.climbed()
        while True:
            present, without = self.pruned(look)
            if present.model.terms == look.model.terms:
                return look, present, without, others
            del look  # a look is large
            self.looked = self.look(present.model)
            fresh = present.model.forms not in seen
            seen.add(present.model.forms)
            look, others = self.climbed() if fresh else (self.looked, [])

    def climbed(self) -> tuple[Look, list[Scored]]:
        """The look at a structure than which none of those refitted is better, if it is reached, and these.

        It begins with the look at hand, which is let go.
        """
        look, self.looked = self.looked, None
        assert look is not None
        trials: list[Scored] = []
        self.ended = False
        while not self.ended and self.looks < MOST_LOOKS:
            self.looks += 1
            self.watch(self.looks, len(look.model.terms))
            scores, onward = Scores(look), None
            present, trials = scored_by(scores, scores.odds), []
            for few in self.trials(scores, search(scores)):
                trials += few
                onward = self._onward(look, few, present)
                if onward is not None:
                    break
            del scores
            self.ended = onward is None
            if onward is not None:
                del look  # a look is large
                look = self._all_candidates(onward)
        return look, trials

    def _onward(self, look: Look, trials: Iterable[Scored], present: Scored) -> Model | None:
        """The best of some structures that is better than the present one, and likelier under the noise that it leaves.

        Under each noise both are refitted, and the terms keep their evidence.
        """
        for trial in sorted(trials, key=lambda trial: trial.score):
            if self._better(trial, present):
                known = of_names(look.candidates, (*trial.model.names, *present.model.names))
                settled = look_settled(self.refitter, trial.model, self.causes, self.folds, self.doubted, known)
                scores, odds = Scores(settled), Odds(look.layout.bank)
                if any(self._lacking(scores)):
                    continue
                before = self.scored(settled, self.refitted_under(settled, present.model), odds)
                if self._likelier(scored_by(scores, odds), before):
                    return settled.model
        return None

    def _all_candidates(self, model: Model) -> Look:
        """All candidates beside a model that was fitted under the noise that it leaves."""
        return look_at(self.refitter, model, self.causes, self.folds, doubted=self.doubted)

    def look(self, model: Model) -> Look:
        """All candidates beside a model, refitted under the noise that it leaves."""
        return look_settled(self.refitter, model, self.causes, self.folds, self.doubted)

    def refitted_under(self, look: Look, model: Model) -> Model:
        """A model, its parameters fitted under the noise of a look."""
        return self.refitter.refit(model, model.terms, look.noise)

    def weights(self, folds: int) -> Array:
        """Random weights (draws, folds) of the folds, exponential with mean one (Bayesian bootstrap; Rubin 1981)."""
        draws = np.random.default_rng(self.seed).exponential(size=(DRAWS, folds))
        return draws / draws.mean(axis=1, keepdims=True)

    def scored(self, look: Look, model: Model, odds: Odds) -> Scored:
        """What a fitted model predicts under the noise of a look, its numbers left free to first order."""
        return scored_by(self.scores_of(look, model), odds)

    def scores_of(self, look: Look, model: Model) -> Scores:
        """A fitted model under the noise of a look, with the forms of its own causes where they are."""
        known = of_names(look.candidates, model.names)
        return Scores(look_at(self.refitter, model, (), self.folds, look.noise, self.doubted, known))

    def trials(self, scores: Scores, ranked: Iterable[Structure]) -> Iterator[list[Scored]]:
        """The best structures of different terms that score better than the present one, a few at a time, refitted.

        A fault of the measurement that lacks its evidence in one of them is not tried beside other terms.
        """
        present, waiting, unproven = scores.score(Structure()), dict[Key, Structure](), set[Form]()
        for structure in ranked:
            if structure.size and scores.score(structure) < present:
                waiting.setdefault(_key(scores, structure), structure)
        for tried in range(0, TRIED, REFITTED):
            few = list(_few(waiting, unproven, min(REFITTED, TRIED - tried)))
            found = [trial for trial in self.refitted(scores, [waiting.pop(key) for key in few]) if trial]
            unproven.update(*(trial.unproven for trial in found))
            yield found

    def refitted(self, scores: Scores, structures: Sequence[Structure]) -> list[Scored | None]:
        """Structures refitted; None for one that cannot be written, or that the data do not tell."""
        each = [(tuple(terms_of(scores, one)), scores.moves(one)) for one in structures]
        terms = dict.fromkeys(term for mine, _ in each for term in (*scores.look.model.terms, *mine))
        found = forked(partial(self._refitted, scores), each, self.refitter.jobs, (*terms,))
        for (mine, _), (_, refusal) in zip(each, found, strict=True):
            self.refused += refusals(scores.look.model.terms, mine, refusal) if refusal else []
        return [scored for scored, _ in found]

    def _refitted(self, scores: Scores, asked: tuple[Sequence[Term], Array]) -> tuple[Scored | None, str]:
        """The model with other terms, refitted, and why it cannot be written, if that is so."""
        (terms, moves), look = asked, scores.look
        try:
            model = self.refitter.refit(look.model, terms, look.noise, moves)
            found = self._tenable(look, model, {term for term in terms if term not in look.model.terms})
        except InputError as error:
            return None, str(error)
        if found is None:
            return None, ""
        seen, lacking = found
        unproven = frozenset((one.name, one.suspect.form) for one in lacking)
        return replace(scored_by(seen, scores.odds), unproven=unproven), ""

    def _tenable(self, look: Look, model: Model, new: set[Term]) -> tuple[Scores, set[Term]] | None:
        """A refitted model under the noise of a look, and those of its new terms that lack evidence.

        Its former terms go that are no longer what they are called, or are not told or shown any more, as a moving mass
        where a delay has come in. A new term that is not what it is called or is not told refuses the structure.
        """
        while model.outcome is not Outcome.FAILED and model.keeps_all and new <= set(model.terms):
            gone = {term for k, term in enumerate(model.terms) if not term.suspect.admits(model.numbers_of(k))}
            if not gone:
                seen = self.scores_of(look, model)
                untold, unproven = self._lacking(seen)
                gone = untold | unproven - new
                if not gone:
                    return seen, unproven
            if gone & new:
                return None
            kept = self.refitter.writable(model, [term for term in model.terms if term not in gone])
            model = self.refitter.refit(model, kept, look.noise)
        return None

    def _lacking(self, seen: Scores) -> tuple[set[Term], set[Term]]:
        """The terms of a refitted model that the data do not tell, and those that have no evidence."""
        terms = list(enumerate(seen.look.model.terms))
        untold = {term for number, term in terms if not is_determined(seen, number)}
        return untold, {term for number, term in terms if not has_evidence(self.refitter, seen, number)}

    def pruned(self, look: Look) -> tuple[Scored, tuple[Without, ...]]:
        """The structure without the terms that are not worth their place, the weakest first, and without each cause."""
        odds = Odds(look.layout.bank)
        present = self.scored(look, self.refitter.fit(look.model, look.noise), odds)
        while True:
            seen = self.scores_of(look, present.model)
            found = self._without(look, present, [(term,) for term in present.model.terms], odds)
            worth = [self._worth(seen, number, present, one.scored) for number, one in enumerate(found)]
            if min(worth, default=1.0) >= NAMED:
                return present, self._without_causes(look, present, found, odds)
            present = min(zip(worth, (one.scored for one in found), strict=True), key=_weakness)[1]

    def _without(self, look: Look, present: Scored, each: Sequence[tuple[Term, ...]], odds: Odds) -> list[Without]:
        """The structure without each of some sets of terms, refitted."""

        def refitted(gone: tuple[Term, ...]) -> Without:
            rest = self.refitter.writable(present.model, [one for one in present.model.terms if one not in gone])
            return Without(gone, self.scored(look, self.refitter.refit(present.model, rest, look.noise), odds))

        return forked(refitted, each, self.refitter.jobs, present.model.terms)

    def _without_causes(self, look: Look, present: Scored, found: Sequence[Without], odds: Odds) -> tuple[Without, ...]:
        """The structure without all terms of each cause; that without a single one is ``found``."""
        every = {name: tuple(t for one in found if one.name == name for t in one.terms) for name in _names(found)}
        more = self._without(look, present, [terms for terms in every.values() if len(terms) > 1], odds)
        known = {one.terms: one for one in (*found, *more)}
        return tuple(known[terms] for terms in every.values())

    def _worth(self, seen: Scores, number: int, present: Scored, without: Scored) -> float:
        """The share of draws in which a structure predicts worse without a term; 0 for one that nothing shows."""
        if not (is_determined(seen, number) and has_evidence(self.refitter, seen, number)):
            return 0.0
        weights = self.weights(present.samples.size)
        worse = without.drawn_exactly(weights) > present.drawn_exactly(weights)
        return float(np.mean(worse)) if self._matters(present, without) else 0.0

    def _better(self, trial: Scored, present: Scored) -> bool:
        """Whether a structure is likelier than the present one, and predicts better with the laws as they are.

        This in more than half of the draws, in nine of ten if it is the larger one.
        """
        if trial.unproven or not self._likelier(trial, present):
            return False
        weights = self.weights(present.samples.size)
        better = float(np.mean(trial.drawn_exactly(weights) < present.drawn_exactly(weights)))
        return better > 0.5 if trial.price <= present.price else better >= NAMED

    def _likelier(self, trial: Scored, present: Scored) -> bool:
        """Whether a structure scores better; another fit of the same terms has to by the odds of a number."""
        least = -np.log(NUMBER_ODDS) if trial.model.forms == present.model.forms else 0.0
        return trial.score < present.score - least

    def _matters(self, present: Scored, without: Scored) -> bool:
        """Whether the error grows by what is of interest when a term goes."""
        cost = without.likelihood(forms_err=False) - present.likelihood(forms_err=False)
        return cost > float(without.samples.sum()) * self.relevance

    def rivals(self, scores: Scores, ranked: Sequence[Structure]) -> list[tuple[Term, Scored]]:
        """For each term the best few structures with another cause in its place, refitted.

        A second one is refitted where it promises more than the refit of the first one has kept.
        """
        waiting = {term: _exchanges(scores, ranked, k) for k, term in enumerate(scores.look.model.terms)}
        found: dict[Term, list[Scored]] = {term: [] for term in waiting}
        while few := [
            (term, waiting[term].pop(0)) for term in waiting if _promises(scores, waiting[term], found[term])
        ]:
            for (term, _), trial in zip(few, self.refitted(scores, [one for _, one in few]), strict=True):
                found[term] += [trial] if trial else []
        return [(term, trial) for term, trials in found.items() for trial in trials]


def refusals(before: Sequence[Term], after: Sequence[Term], reason: str) -> list[str]:
    """What to say of each term that could not join: in place of which ones, since others may need what these added."""
    gone = " and ".join(f"'{term.cause.word}'" for term in before if term not in after)
    place = f" in place of {gone}" if gone else ""
    words = [term.cause.word for term in after if term not in before]
    return [f"'{word}' could not be written into the network{place}: {reason}" for word in words]


def _few(waiting: Mapping[Key, Structure], unproven: set[Form], many: int) -> Iterator[Key]:
    """The best so many structures with one change, and as many with more that have nothing ``unproven``."""
    yield from islice((key for key, one in waiting.items() if one.size == 1), many)
    yield from islice((key for key, one in waiting.items() if one.size > 1 and not unproven & key), many)


def _exchanges(scores: Scores, ranked: Sequence[Structure], number: int) -> list[Structure]:
    """The best structures with another cause in the place of a term, by its number."""
    exchanged = [one for one in ranked if one.dropped == {number} and _joins_alone(scores, one)]
    different = {_key(scores, one): one for one in reversed(exchanged)}
    return sorted(different.values(), key=scores.score)[:TRIED]


def _promises(scores: Scores, waiting: Sequence[Structure], found: Sequence[Scored]) -> bool:
    """Whether the next of some structures may be better than those refitted."""
    best = min((one.score for one in found), default=np.inf)
    return bool(waiting) and len(found) < REFITTED and scores.score(waiting[0]) < best


def _names(found: Iterable[Without]) -> Iterable[tuple[str, str]]:
    return dict.fromkeys(one.name for one in found)


def _joins_alone(scores: Scores, structure: Structure) -> bool:
    """Whether one cause joins that is not there."""
    names = [scores.look.candidates[k].name for k, _ in structure.added]
    return len(names) == 1 and names[0] not in scores.look.model.names


def _weakness(removal: tuple[float, Scored]) -> tuple[float, float]:
    return removal[0], removal[1].score


def scored_by(scores: Scores, odds: Odds) -> Scored:
    """What the model of a look predicts, as it is."""
    found, model = scores.predicted(Structure()), scores.look.model
    assert found is not None
    return Scored(model, *found, scores.exact(), scores.look.samples, odds.of_model(model))


def _key(scores: Scores, structure: Structure) -> Key:
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
