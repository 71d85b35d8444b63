"""Structures refitted: what is tried beside a model, and what it predicts under the noise of a look."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from dashpot.diagnose.evidence import has_evidence, is_determined
from dashpot.diagnose.folds import Folds
from dashpot.diagnose.location import of_names
from dashpot.diagnose.look import Doubt, Look, look_at
from dashpot.diagnose.pursuit import Scored
from dashpot.diagnose.refit import Refitter
from dashpot.diagnose.score import Odds, Scores, Structure
from dashpot.diagnose.search import additions
from dashpot.diagnose.term import Model, Term
from dashpot.fit.refine import Outcome
from dashpot.kernel.workers import forked
from dashpot.text.problem import InputError

Array = NDArray[np.float64]


@dataclass(eq=False)
class Trials:
    """Refits on ``folds``, beside faults that each run may have; ``refused`` collects what could not be written."""

    refitter: Refitter
    folds: Folds
    doubted: Sequence[Doubt] = ()
    refused: list[str] = field(default_factory=list)

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
            model = self._with_terms(look, terms, moves)
            found = self._tenable(look, model, {term for term in terms if term not in look.model.terms})
        except InputError as error:
            return None, str(error)
        if found is None:
            return None, ""
        seen, lacking = found
        unproven = frozenset((one.name, one.suspect.form) for one in lacking)
        return replace(scored_by(seen, scores.odds), unproven=unproven), ""

    def _with_terms(self, look: Look, terms: Sequence[Term], moves: Array) -> Model:
        """The model of a look with other terms, refitted. Raises InputError for a new one that cannot be written.

        A former term that changes what is not there any more, as the dependence of a friction limit on a setting where
        another law takes the place of friction, is looked for again beside the new terms.
        """
        new = [term for term in terms if term not in look.model.terms]
        former = [term for term in terms if term in look.model.terms]
        orders = [self.refitter.writable(look.model, order) for order in (terms, [*new, *former])]
        written = max(orders, key=len)
        kept = written if set(new) <= set(written) else terms
        model = self.refitter.refit(look.model, kept, look.noise, moves)
        stranded = [term for term in former if term not in kept]
        for cause in dict.fromkeys(term.cause for term in stranded):
            scores = Scores(look_at(self.refitter, model, [cause], self.folds, look.noise, self.doubted))
            found = min(self._with_one_more(scores), key=scores.score)
            if found.size:
                model = self.refitter.refit(model, terms_of(scores, found), look.noise, scores.moves(found))
        return model

    def _with_one_more(self, scores: Scores) -> list[Structure]:
        """The structure of a look as it is, and with each of its best candidates that can be written beside it."""
        found = [Structure(added=frozenset({one})) for one in additions(scores, Structure())]
        model = scores.look.model
        lengths = [len(self.refitter.writable(model, terms_of(scores, one))) for one in found]
        return [Structure(), *(one for one, n in zip(found, lengths, strict=True) if n > len(model.terms))]

    def _tenable(self, look: Look, model: Model, new: set[Term]) -> tuple[Scores, set[Term]] | None:
        """A refitted model under the noise of a look, and those of its new terms that lack evidence.

        Its former terms go that are no longer what they are called, or are not told or shown any more, as a moving mass
        where a delay has come in. A new term that is not what it is called or is not told refuses the structure.
        """
        while model.outcome is not Outcome.FAILED and model.keeps_all and new <= set(model.terms):
            gone = {term for k, term in enumerate(model.terms) if not term.suspect.admits(model.numbers_of(k))}
            if not gone:
                seen = self.scores_of(look, model)
                untold, unproven = self.lacking(seen)
                gone = untold | unproven - new
                if not gone:
                    return seen, unproven
            if gone & new:
                return None
            kept = self.refitter.writable(model, [term for term in model.terms if term not in gone])
            model = self.refitter.refit(model, kept, look.noise)
        return None

    def lacking(self, seen: Scores) -> tuple[set[Term], set[Term]]:
        """The terms of a refitted model that the data do not tell, and those that have no evidence."""
        terms = list(enumerate(seen.look.model.terms))
        untold = {term for number, term in terms if not is_determined(seen, number)}
        return untold, {term for number, term in terms if not has_evidence(self.refitter, seen, number)}

    def refitted_under(self, look: Look, model: Model) -> Model:
        """A model, its parameters fitted under the noise of a look."""
        return self.refitter.refit(model, model.terms, look.noise)

    def scored(self, look: Look, model: Model, odds: Odds) -> Scored:
        """What a fitted model predicts under the noise of a look, its numbers left free to first order."""
        return scored_by(self.scores_of(look, model), odds)

    def scores_of(self, look: Look, model: Model) -> Scores:
        """A fitted model under the noise of a look, with the forms of its own causes where they are."""
        known = of_names(look.candidates, model.names)
        return Scores(look_at(self.refitter, model, (), self.folds, look.noise, self.doubted, known))


def refusals(before: Sequence[Term], after: Sequence[Term], reason: str) -> list[str]:
    """What to say of each term that could not join: in place of which ones, since others may need what these added."""
    gone = " and ".join(f"'{term.cause.word}'" for term in before if term not in after)
    place = f" in place of {gone}" if gone else ""
    words = [term.cause.word for term in after if term not in before]
    return [f"'{word}' could not be written into the network{place}: {reason}" for word in words]


def scored_by(scores: Scores, odds: Odds) -> Scored:
    """What the model of a look predicts, as it is."""
    found, model = scores.predicted(Structure()), scores.look.model
    assert found is not None
    return Scored(model, *found, scores.exact(), scores.look.samples, odds.of_model(model))


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
