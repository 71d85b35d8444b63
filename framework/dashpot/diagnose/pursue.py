"""From a fitted network to the best structure: look, search, refit the best few, until none is better.

What is refitted is judged by the same score as what was searched. At the end every term has to be worth its place: the
structure without it is refitted, and so are those with another cause in its place.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Cause
from dashpot.diagnose.candidate import Candidate
from dashpot.diagnose.evidence import has_evidence, is_determined
from dashpot.diagnose.location import of_names
from dashpot.diagnose.look import Look, look_at, look_settled
from dashpot.diagnose.pursuit import NAMED, Form, Pursuit, Scored, Without
from dashpot.diagnose.score import NUMBER_ODDS, Odds, Scores, Structure
from dashpot.diagnose.search import search
from dashpot.diagnose.term import Model, Term
from dashpot.diagnose.trials import Trials, scored_by
from dashpot.kernel.workers import forked

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

    trials: Trials
    causes: Sequence[type[Cause]]
    relevance: float
    seed: int
    watch: Callable[[int, int], None] = lambda looks, terms: None
    looked: Look | None = field(default=None, init=False)
    looks: int = field(default=0, init=False)
    ended: bool = field(default=False, init=False)

    def run(self, model: Model) -> Pursuit:
        """Search from a fitted model until no refitted structure scores better, then let go what is not needed."""
        self.looked = self.look(model)
        seen: set[frozenset[object]] = set()
        while True:
            look, present, without, others = self.local_optimum(seen)
            scores = Scores(look)
            rivals = self.rivals(scores, search(scores, scores.given)) if present.model.causes else []
            smaller = self.without_given(scores) if self.ended else []
            others += smaller
            del scores
            seen.add(present.model.forms)
            fresh = [rival for _, rival in rivals if rival.model.forms not in seen]
            onward = self._onward(look, [*fresh, *smaller], present) if self.ended else None
            if onward is None:
                weights = self.weights(len(look.folds.names))
                found = (present, look, model, without, tuple(rivals), tuple(others), weights)
                likeliest = self.likeliest(look, present, without)
                return Pursuit(*found, *likeliest, self.looks, self.ended, tuple(self.trials.refused))
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
            self.watch(self.looks, len(look.model.causes))
            scores, onward = Scores(look), None
            present, trials = scored_by(scores, scores.odds), []
            for few in self.tried(scores, search(scores, scores.given)):
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
                settled = self.look(trial.model, known)
                scores, odds = Scores(settled), Odds(look.layout.bank)
                if any(self.trials.lacking(scores)):
                    continue
                before = self.trials.scored(settled, self.trials.refitted_under(settled, present.model), odds)
                if self._likelier(scored_by(scores, odds), before):
                    return settled.model
        return None

    def _all_candidates(self, model: Model) -> Look:
        """All candidates beside a model that was fitted under the noise that it leaves."""
        at = self.trials
        return look_at(at.refitter, model, self.causes, at.folds, doubted=at.doubted)

    def look(self, model: Model, known: Sequence[Candidate] | None = None) -> Look:
        """All candidates beside a model, or the known ones, refitted under the noise that it leaves."""
        at = self.trials
        return look_settled(at.refitter, model, self.causes, at.folds, at.doubted, known)

    def weights(self, folds: int) -> Array:
        """Random weights (draws, folds) of the folds, exponential with mean one (Bayesian bootstrap; Rubin 1981)."""
        draws = np.random.default_rng(self.seed).exponential(size=(DRAWS, folds))
        return draws / draws.mean(axis=1, keepdims=True)

    def tried(self, scores: Scores, ranked: Iterable[Structure]) -> Iterator[list[Scored]]:
        """The best structures of different terms that score better than the present one, a few at a time, refitted.

        A fault of the measurement that lacks its evidence in one of them is not tried beside other terms.
        """
        present, waiting, unproven = scores.score(Structure()), dict[Key, Structure](), set[Form]()
        for structure in ranked:
            if structure.size and scores.score(structure) < present:
                waiting.setdefault(_key(scores, structure), structure)
        for tried in range(0, TRIED, REFITTED):
            few = list(_few(waiting, unproven, min(REFITTED, TRIED - tried)))
            found = [trial for trial in self.trials.refitted(scores, [waiting.pop(key) for key in few]) if trial]
            unproven.update(*(trial.unproven for trial in found))
            yield found

    def without_given(self, scores: Scores) -> list[Scored]:
        """The best structures in which branches of the diagnosed network go or give way to a cause, refitted.

        They are tried when no cause is to join any more: one that is gone could not tell what else follows from it.
        """
        found = self.tried(scores, search(scores)) if scores.given else []
        return [trial for few in found for trial in few]

    def pruned(self, look: Look) -> tuple[Scored, tuple[Without, ...]]:
        """The structure without the causes that are not worth their place, the weakest first, and without each one."""
        odds = Odds(look.layout.bank)
        present = self.trials.scored(look, self.trials.refitter.fit(look.model, look.noise), odds)
        while True:
            seen = self.trials.scores_of(look, present.model)
            found = self._without(look, present, [(term,) for term in present.model.causes], odds)
            worth = [self._worth(seen, one.terms[0], present, one.scored) for one in found]
            if min(worth, default=1.0) >= NAMED:
                return present, self._without_causes(look, present, odds, found)
            present = min(zip(worth, (one.scored for one in found), strict=True), key=_weakness)[1]

    def _without(self, look: Look, present: Scored, each: Sequence[tuple[Term, ...]], odds: Odds) -> list[Without]:
        """The structure without each of some sets of terms, refitted.

        Where branches of the diagnosed network have gone, they come back if that is likelier: it has them.
        """
        refitter, model = self.trials.refitter, present.model

        def refitted(gone: tuple[Term, ...]) -> Without:
            rest = [one for one in model.terms if one not in gone]
            ways = [rest, [*model.gone, *rest]] if model.gone else [rest]
            found = [refitter.refit(model, refitter.writable(model, way), look.noise) for way in ways]
            return Without(gone, min((self.trials.scored(look, one, odds) for one in found), key=lambda one: one.score))

        return forked(refitted, each, refitter.jobs, model.terms)

    def _without_causes(
        self, look: Look, present: Scored, odds: Odds, found: Sequence[Without] = ()
    ) -> tuple[Without, ...]:
        """The structure without all terms of each cause; that without a single one may be ``found`` already."""
        terms = present.model.causes
        every = [tuple(t for t in terms if t.name == name) for name in dict.fromkeys(present.model.names)]
        known = {one.terms: one for one in found}
        known |= {one.terms: one for one in self._without(look, present, [e for e in every if e not in known], odds)}
        return tuple(known[terms] for terms in every)

    def likeliest(
        self, look: Look, present: Scored, without: tuple[Without, ...]
    ) -> tuple[Scored, tuple[Without, ...]]:
        """The present structure less the causes without which it scores better, and that without each of the others.

        Such causes stay, since the laws as they are predict worse without them; they make up for the form of another
        law, and beside them that law explains little alone.
        """
        odds = Odds(look.layout.bank)
        while without:
            best = min((one.scored for one in without), key=lambda one: one.score)
            if best.score >= present.score:
                break
            present, without = best, self._without_causes(look, best, odds)
        return present, without

    def _worth(self, seen: Scores, term: Term, present: Scored, without: Scored) -> float:
        """The share of draws in which a structure predicts worse without a term; 0 for one that nothing shows."""
        number = present.model.terms.index(term)
        if not (is_determined(seen, number) and has_evidence(self.trials.refitter, seen, number)):
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
        """For each cause the best few structures with another one in its place, refitted.

        A second one is refitted where it promises more than the refit of the first one has kept.
        """
        terms = scores.look.model.terms
        waiting = {term: _exchanges(scores, ranked, terms.index(term)) for term in scores.look.model.causes}
        found: dict[Term, list[Scored]] = {term: [] for term in waiting}
        while few := [
            (term, waiting[term].pop(0)) for term in waiting if _promises(scores, waiting[term], found[term])
        ]:
            for (term, _), trial in zip(few, self.trials.refitted(scores, [one for _, one in few]), strict=True):
                found[term] += [trial] if trial else []
        return [(term, trial) for term, trials in found.items() for trial in trials]


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


def _joins_alone(scores: Scores, structure: Structure) -> bool:
    """Whether one cause joins that is not there."""
    names = [scores.look.candidates[k].name for k, _ in structure.added]
    return len(names) == 1 and names[0] not in scores.look.model.names


def _weakness(removal: tuple[float, Scored]) -> tuple[float, float]:
    return removal[0], removal[1].score


def _key(scores: Scores, structure: Structure) -> Key:
    """Terms that go and forms that join, whatever their places."""
    joins = ((scores.look.candidates[k].name, scores.look.candidates[k].suspect.form) for k, _ in structure.added)
    return frozenset([*((number,) for number in structure.dropped), *joins])
