"""From a fitted network to the best structure: look, search, refit the best few, until none is better.

What is refitted is judged by the same score as what was searched. At the end every term has to be worth its place: the
structure without it is refitted, and so are those with another cause in its place.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Cause
from dashpot.diagnose.candidate import Candidate
from dashpot.diagnose.evidence import has_evidence, is_determined
from dashpot.diagnose.location import of_names
from dashpot.diagnose.look import Look, look_at, look_settled
from dashpot.diagnose.odds import NUMBER_ODDS, Odds
from dashpot.diagnose.pursuit import NAMED, Form, Pursuit, Scored, Without
from dashpot.diagnose.score import Added, Scores, Structure
from dashpot.diagnose.search import other_forms, search
from dashpot.diagnose.term import Model, Term, each_part_gone, renamed
from dashpot.diagnose.trials import Trials, scored_by
from dashpot.kernel.workers import forked

Array = NDArray[np.float64]

REFITTED = 2  # structures with one change, and as many with more, at a time
TRIED = 5  # of these at a look, until one is better, and of the rivals of a cause, until one can be told
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
            rivals = self.rivals(look)
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

        Where terms go, or predict better in another form, the search continues from there, to structures that were not
        ``seen`` (tabu search).
        """
        look, others = self.climbed(seen)
        while True:
            present, without = self.pruned(look)
            onward = present.model
            if onward.terms == look.model.terms:
                better = self.in_another_form(look, present, seen)
                if better is None:
                    return look, present, without, others
                onward = better
            seen |= {look.model.forms, onward.forms}
            del look  # a look is large
            self.looked = self.look(onward)
            look, others = self.climbed(seen)

    def in_another_form(self, look: Look, present: Scored, seen: Collection[frozenset[object]]) -> Model | None:
        """The structure with a term in another form of its cause that predicts better with the laws as they are.

        The score of a cause allows for an error of its form; what is written should not have it. A form that changes
        a number of another cause makes that one seem more than it is, and is none for one that stands alone.
        """
        scores = Scores(look)
        terms = [number for number, term in enumerate(look.model.terms) if isinstance(term, Term)]
        forms = ([one for one in other_forms(scores, n) if self.trials.is_as_independent(scores, one)] for n in terms)
        asked = [one for each in forms for one in each[:REFITTED]]
        trials = [trial for trial in self.trials.refitted(scores, asked) if trial and not trial.unproven]
        better = [one for one in trials if one.model.forms not in seen and self._predicts_better(one, present)]
        return min(better, key=lambda one: one.exact_score).model if better else None

    def climbed(self, seen: Collection[frozenset[object]]) -> tuple[Look, list[Scored]]:
        """The look at a structure than which none of those refitted is better, if it is reached, and these.

        It begins with the look at hand, which is let go, and goes to none that was ``seen``.
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
                fresh = [trial for trial in few if trial.model.forms not in seen]
                onward = self._onward(look, fresh, present)
                if onward is not None:
                    break
            del scores
            self.ended = onward is None
            if onward is not None:
                del look  # a look is large
                look = self._all_candidates(onward)
        return look, trials

    def _onward(self, look: Look, trials: Iterable[Scored], present: Scored) -> Model | None:
        """The best of some structures that is better than the present one, refitted under the noise that it leaves.

        Under that noise the present one is refitted, too. The likelier one is that of the better mean score under both
        noises, so that it does not matter which of the two the search came to first. The terms keep their evidence.
        """
        for trial in sorted(trials, key=lambda trial: trial.score):
            if self._better(trial, present):
                known = of_names(look.candidates, (*trial.model.names, *present.model.names))
                settled = self.look(trial.model, known)
                scores, odds = Scores(settled), look.odds
                if any(self.trials.lacking(scores)):
                    continue
                after = scored_by(scores, odds)
                before = self.trials.scored(settled, self.trials.refitted_under(settled, present.model), odds)
                if 0.5 * (_ahead(after, before) + _ahead(trial, present)) > _least(trial, present):
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

        A fault of the measurement that lacks its evidence in one of them is not tried beside other terms, nor is what
        can be written beside a term only that goes.
        """
        present, waiting, unproven = scores.score(Structure()), dict[Key, Structure](), set[Form]()
        for structure in ranked:
            if structure.size and scores.score(structure) < present:
                waiting.setdefault(_key(scores, structure), structure)
        able = cache(lambda key: self.trials.can_be_tried(scores, waiting[key]))
        for tried in range(0, TRIED, REFITTED):
            few = list(_few(waiting, unproven, able, min(REFITTED, TRIED - tried)))
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
        """The structure without the causes that are not worth their place, the weakest first, and without each one.

        What would not be what it is called without a cause goes with it, and counts to what that one is worth.
        """
        odds = look.odds
        present = self.trials.scored(look, self.trials.refitter.fit(look.model, look.noise), odds)
        while True:
            seen = self.trials.scores_of(look, present.model)
            found = self._without(look, present, [(term,) for term in present.model.causes], odds)
            rest = [self._of_its_name(look, one.scored, odds) for one in found]
            worth = [self._worth(seen, one.terms[0], present, left) for one, left in zip(found, rest, strict=True)]
            if min(worth, default=1.0) < NAMED:
                present = min(zip(worth, rest, strict=True), key=_weakness)[1]
                continue
            fewer = self._fewer_parts(look, present, odds)
            if fewer is present:
                return present, self._without_causes(look, present, odds, found)
            present = fewer

    def _fewer_parts(self, look: Look, present: Scored, odds: Odds) -> Scored:
        """The structure without the parts of its terms that it predicts as well without, one after the other.

        Nobody calls a part by a name: it has the prior odds of its numbers only. A part stays without which its term
        would not be what it is called.
        """
        at = self.trials

        def refitted(less: Model) -> Scored:
            return at.scored(look, at.refitted_under(look, less), odds)

        while True:
            less = [one for one in each_part_gone(present.model) if not at.refitter.refusal(one, one.terms)]
            trials = forked(refitted, less, at.refitter.jobs, [term for one in less for term in one.terms])
            spare = [one for one in trials if self._is_spare(present, one) and not renamed(one.model)]
            if not spare:
                return present
            present = min(spare, key=lambda one: one.exact_score)

    def _is_spare(self, present: Scored, without: Scored) -> bool:
        """Whether a structure predicts as well ``without`` a part, or its error grows by nothing of interest."""
        return self._predicts_better(without, present) or not self._matters(present, without)

    def _of_its_name(self, look: Look, without: Scored, odds: Odds) -> Scored:
        """A structure from which a term has gone, without those that are not what they are called without it."""
        refitter, model = self.trials.refitter, without.model
        while gone := renamed(model):
            kept = refitter.writable(model, [term for term in model.terms if term not in gone])
            model = refitter.refit(model, kept, look.noise)
        return without if model is without.model else self.trials.scored(look, model, odds)

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
        odds = look.odds
        while without:
            best = min((one.scored for one in without), key=lambda one: one.score)
            if best.score >= present.score:
                break
            present, without = best, self._without_causes(look, best, odds)
        return present, without

    def _worth(self, seen: Scores, term: Term, present: Scored, without: Scored) -> float:
        """The share of draws in which a structure predicts worse without a term.

        0 for one that nothing shows, or that is not what it is called any more.
        """
        number = present.model.terms.index(term)
        shown = is_determined(seen, number) and has_evidence(self.trials.refitter, seen, number)
        if not (shown and term.admits(present.model.numbers_of(number))):
            return 0.0
        weights = self.weights(present.samples.size)
        worse = without.drawn_exactly(weights) > present.drawn_exactly(weights)
        return float(np.mean(worse)) if self._matters(present, without) else 0.0

    def _better(self, trial: Scored, present: Scored) -> bool:
        """Whether a structure is likelier than the present one, and predicts better with the laws as they are."""
        likelier = not trial.unproven and _ahead(trial, present) > _least(trial, present)
        return likelier and self._predicts_better(trial, present)

    def _predicts_better(self, trial: Scored, present: Scored) -> bool:
        """Whether a structure predicts better with the laws as they are.

        This in more than half of the draws, in nine of ten if it is the larger one.
        """
        weights = self.weights(present.samples.size)
        better = float(np.mean(trial.drawn_exactly(weights) < present.drawn_exactly(weights)))
        return better > 0.5 if trial.price <= present.price else better >= NAMED

    def _matters(self, present: Scored, without: Scored) -> bool:
        """Whether the error grows by what is of interest when a term goes."""
        cost = without.likelihood(forms_err=False) - present.likelihood(forms_err=False)
        return cost > float(without.samples.sum()) * self.relevance

    def rivals(self, look: Look) -> list[tuple[Term, Scored]]:
        """For each cause the best structures with others in the place of its terms, refitted: as simple, and richer.

        What is as simple, no less likely beforehand, may make a name less sure; what has more numbers, if it is better.
        In the place of all faults of the measurement those that nothing can prove are refitted as well.
        """
        model = look.model
        others = tuple(one for one in look.candidates if one.name not in model.names)
        scores = Scores(replace(look, candidates=others))
        waiting: dict[tuple[Term, str], list[Structure]] = {}
        unproven = _not_provable(scores)
        for term in {term.name: term for term in reversed(model.causes)}.values():
            ranked = _in_place_of(scores, term)
            waiting[term, "as simple"] = [one for one in ranked if scores.price(one) <= 0.0][:TRIED]
            waiting[term, "richer"] = [one for one in ranked if scores.price(one) > 0.0][:TRIED]
            if term.kind == "measurement":
                waiting[term, "not provable"], unproven = unproven, []
        found: dict[tuple[Term, str], Scored] = {}
        while few := [(key, left.pop(0)) for key, left in waiting.items() if left and key not in found]:
            trials = self.trials.refitted(scores, [one for _, one in few])
            found.update({key: trial for (key, _), trial in zip(few, trials, strict=True) if trial})
        return [(term, trial) for (term, _), trial in found.items()]


def _ahead(trial: Scored, present: Scored) -> float:
    """By how many nats a structure is likelier than the present one."""
    return present.score - trial.score


def _least(trial: Scored, present: Scored) -> float:
    """By how many nats it has to be: another fit of the same terms by the odds of a number."""
    return float(-np.log(NUMBER_ODDS)) if trial.model.forms == present.model.forms else 0.0


def _few(
    waiting: Mapping[Key, Structure], unproven: set[Form], able: Callable[[Key], bool], many: int
) -> Iterator[Key]:
    """The best so many structures that can be tried with one change, and as many with more and nothing ``unproven``."""
    yield from islice((key for key, one in waiting.items() if one.size == 1 and able(key)), many)
    more = (key for key, one in waiting.items() if one.size > 1 and not unproven & key)
    yield from islice((key for key in more if able(key)), many)


def _in_place_of(scores: Scores, term: Term) -> list[Structure]:
    """The best structures with candidates of a look in the place of all terms of a cause, and no more terms than it."""
    terms = list(enumerate(scores.look.model.terms))
    gone = frozenset(number for number, one in terms if one.name == term.name)
    stay = frozenset(number for number, _ in terms) - gone
    ranked = [one for one in search(scores, stay, gone) if 0 < len(one.added) <= len(gone)]
    different = {_key(scores, one): one for one in reversed(ranked)}
    return sorted(different.values(), key=scores.score)


def _not_provable(scores: Scores) -> list[Structure]:
    """The structures with a fault that nothing can prove in the place of all faults of the measurement."""
    gone = frozenset(number for number, kind in enumerate(scores.kinds) if kind == "measurement")
    rivals = [(k, each) for k, each in enumerate(scores.look.candidates) if not each.provable] if gone else []
    forms = [Added(k, (place,)) for k, each in rivals for place in range(len(each.suspect.grid))]
    found = [Structure(gone, frozenset({form})) for form in forms]
    return sorted((one for one in found if np.isfinite(scores.score(one))), key=scores.score)


def _weakness(removal: tuple[float, Scored]) -> tuple[float, float]:
    return removal[0], removal[1].score


def _key(scores: Scores, structure: Structure) -> Key:
    """Terms that go and forms that join, whatever their places."""
    joins = ((scores.look.candidates[k].name, scores.look.candidates[k].suspect.form) for k, _ in structure.added)
    return frozenset([*((number,) for number in structure.dropped), *joins])
