"""Structures refitted: what is tried beside a model, and what it predicts under the noise of a look."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from dashpot.diagnose.evidence import has_evidence, is_determined
from dashpot.diagnose.exclusive import without_rivals
from dashpot.diagnose.folds import Folds
from dashpot.diagnose.location import of_names
from dashpot.diagnose.look import Doubt, Look, look_at
from dashpot.diagnose.odds import Odds
from dashpot.diagnose.pursuit import Scored
from dashpot.diagnose.refit import Refitter
from dashpot.diagnose.score import Scores, Structure
from dashpot.diagnose.search import additions
from dashpot.diagnose.term import Given, Model, Part, Term, renamed
from dashpot.fit.refine import Outcome
from dashpot.kernel.workers import forked
from dashpot.text.problem import InputError

Array = NDArray[np.float64]


class _Asked(NamedTuple):
    """A model that is to have other ``terms``; natural steps ``moves`` (p,) of its numbers are foreseen."""

    model: Model
    terms: tuple[Part, ...]
    moves: Array


@dataclass(eq=False)
class Trials:
    """Refits on ``folds``, beside faults that each run may have; ``refused`` collects defects of causes: what could not
    be written into the network for which a cause proposed it.
    """

    refitter: Refitter
    folds: Folds
    doubted: Sequence[Doubt] = ()
    refused: list[str] = field(default_factory=list)

    def refitted(self, scores: Scores, structures: Sequence[Structure]) -> list[Scored | None]:
        """Structures refitted; None for one that cannot be written, or that the data do not tell.

        Numbers of a new law may follow a setting: such a dependence, which can be written only now that the law is
        there, is looked for beside it, and so is one that the model had of a law which is gone. The likelier of the
        two structures counts.
        """
        asked = [_asked(scores, one) for one in structures]
        found = self._each(scores, asked)
        further = {
            k: more
            for k, (one, trial) in enumerate(zip(asked, found, strict=True))
            if trial and (more := self._with_dependence(scores, one, trial))
        }
        for k, trial in zip(further, self._each(scores, list(further.values())), strict=True):
            found[k] = min((one for one in (found[k], trial) if one), key=lambda one: one.score)
        return found

    def _each(self, scores: Scores, asked: Sequence[_Asked]) -> list[Scored | None]:
        """Each of some models with other terms, refitted."""
        terms = dict.fromkeys(term for one in asked for term in (*scores.look.model.terms, *one.terms))
        found = forked(partial(self._refitted, scores), asked, self.refitter.jobs, (*terms,))
        for one, scored in zip(asked, found, strict=True):
            self.refused += self._defects(one) if scored is None else []
        return found

    def can_be_tried(self, scores: Scores, structure: Structure) -> bool:
        """Whether a structure can be written, or what cannot be is a defect of a cause, which is to be told.

        Else a new term lacks another one that goes, or does not go along with one that stays.
        """
        asked = _asked(scores, structure)
        return self._can_be_written(asked.model, self._writable(asked)) or bool(self._defects(asked))

    def is_as_independent(self, scores: Scores, structure: Structure) -> bool:
        """Whether a new term can be written without other causes, or the one in whose place it is cannot either."""
        model = scores.look.model
        given = [term for term in model.terms if isinstance(term, Given)]
        old, new = (model.terms[number] for number in structure.dropped), terms_of(scores, structure)[-1]
        return self._can_be_written(model, [*given, new]) or not self._can_be_written(model, [*given, *old])

    def _defects(self, asked: _Asked) -> list[str]:
        """What to say of each new term that cannot be written into the model for which its cause proposed it.

        Of others nothing: they do not go along with one another, or lack one that goes.
        """
        model, found = asked.model, []
        for term in asked.terms:
            if isinstance(term, Term) and term not in model.terms:
                reason = self.refitter.refusal(model, [*without_rivals(model, term), term])
                found += [f"'{term.word}' could not be written into the network: {reason}"] if reason else []
        return found

    def _refitted(self, scores: Scores, asked: _Asked) -> Scored | None:
        """A model with other terms, refitted; None where that cannot be written.

        Or where it is not stable, as with a mass below zero on a fixture that gives way.
        """
        look, new = scores.look, {term for term in asked.terms if term not in scores.look.model.terms}
        try:
            kept = self._writable(asked)
            model = self.refitter.refit(asked.model, kept, look.noise, asked.moves)
            found = self._tenable(look, model, new)
        except InputError:
            return None
        if found is None:
            return None
        seen, lacking = found
        scored = replace(scored_by(seen, scores.odds), unproven=frozenset(one.form for one in lacking))
        return scored if np.isfinite(scored.score) else None

    def _writable(self, asked: _Asked) -> Sequence[Part]:
        """All terms, without those of the model that cannot be written any more beside new ones."""
        new = [term for term in asked.terms if term not in asked.model.terms]
        former = [term for term in asked.terms if term in asked.model.terms]
        written = self.refitter.writable(asked.model, asked.terms)
        if len(written) < len(asked.terms):
            written = max(written, self.refitter.writable(asked.model, [*new, *former]), key=len)
        return written if set(new) <= set(written) else asked.terms

    def _with_dependence(self, scores: Scores, asked: _Asked, trial: Scored) -> _Asked | None:
        """A refitted structure with the best dependence of its numbers, where it scores better to first order."""
        look, terms = scores.look, trial.model.terms
        kept = self._writable(asked)
        causes = [term.cause for term in asked.terms if isinstance(term, Term) and term not in kept]
        if any(term.kind == "specimen" for term in terms if term not in look.model.terms):
            causes += [one.cause for one in look.candidates if one.cause.changes_numbers]
        if not causes:
            return None
        each = [*dict.fromkeys(causes)]
        beside = Scores(look_at(self.refitter, trial.model, each, self.folds, look.noise, self.doubted))
        found = [Structure(added=frozenset({one})) for one in additions(beside, Structure())]
        written = [one for one in found if self._can_be_written(trial.model, terms_of(beside, one))]
        best = min([Structure(), *written], key=beside.score)
        return _Asked(trial.model, tuple(terms_of(beside, best)), beside.moves(best)) if best.size else None

    def _can_be_written(self, model: Model, terms: Sequence[Part]) -> bool:
        """Whether terms can be written, all of them."""
        return len(self.refitter.writable(model, terms)) == len(terms)

    def _tenable(self, look: Look, model: Model, new: set[Part]) -> tuple[Scores, set[Part]] | None:
        """A refitted model under the noise of a look, and those of its new terms that lack evidence.

        Its former terms go that are no longer what they are called, or are not told or shown any more, as a moving mass
        where a delay has come in. A new term that is not what it is called or is not told refuses the structure.
        """
        while model.outcome is not Outcome.FAILED and model.keeps_all and new <= set(model.terms):
            gone = set(renamed(model))
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

    def lacking(self, seen: Scores) -> tuple[set[Part], set[Part]]:
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


def _asked(scores: Scores, structure: Structure) -> _Asked:
    return _Asked(scores.look.model, tuple(terms_of(scores, structure)), scores.moves(structure))


def scored_by(scores: Scores, odds: Odds) -> Scored:
    """What the model of a look predicts, as it is."""
    found, model = scores.predicted(Structure()), scores.look.model
    assert found is not None
    return Scored(model, *found, scores.exact(), scores.look.samples, odds.of_model(model))


def terms_of(scores: Scores, structure: Structure) -> list[Part]:
    """The terms of a structure: those of the model that stay, then the new ones at the strengths that are foreseen."""
    look = scores.look
    found: list[Part] = [term for number, term in enumerate(look.model.terms) if number not in structure.dropped]
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
