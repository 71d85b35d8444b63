"""What a pursuit ends with: the best structure, those beside it, and how sure its causes are."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from dashpot.diagnose.look import Look
from dashpot.diagnose.odds import against_unknown, agreed_by_chance, share_of_both
from dashpot.diagnose.score import nats
from dashpot.diagnose.term import Model, Term

Array = NDArray[np.float64]
Names = tuple[tuple[str, str], ...]  # words of causes and where they are
Form = tuple[tuple[str, str], str]  # name of a term and the form of its law

NAMED = 0.9  # of the draws: probability from which on a cause is named


@dataclass(frozen=True, eq=False)
class Scored:
    """A refitted structure and what it predicts.

    ``squares`` (folds,) are the mean squares of what it does not predict of each fold left out, with errors of forms
    allowed for, ``errors`` the nats that these errors cost, ``exact`` (folds,) the mean squares with the laws as they
    are, ``samples`` (folds,) how many there are, ``price`` the prior of the terms in nats. ``unproven`` are the faults
    of the measurement in it, and their forms, that lack evidence.
    """

    model: Model
    squares: Array
    errors: float
    exact: Array
    samples: Array
    price: float
    unproven: frozenset[Form] = frozenset()

    @property
    def score(self) -> float:
        """Minus the log of likelihood and prior."""
        return self.likelihood(forms_err=True) + self.price

    @property
    def exact_score(self) -> float:
        """The same with the laws as they are."""
        return self.likelihood(forms_err=False) + self.price

    def likelihood(self, forms_err: bool) -> float:
        """Minus its log, with errors of forms allowed for or with the laws as they are."""
        if forms_err:
            return float(nats(self.squares, self.samples)) + self.errors
        return float(nats(self.exact, self.samples))

    def drawn(self, weights: Array) -> Array:
        """The score (draws,) under weights (draws, folds) of the folds."""
        return nats(self.squares, weights * self.samples) + self.errors + self.price

    def drawn_exactly(self, weights: Array) -> Array:
        """The score (draws,) with the laws as they are."""
        return nats(self.exact, weights * self.samples) + self.price

    def ahead(self, other: Scored, weights: Array) -> NDArray[np.bool_]:
        """In which draws (draws,) it is more likely than another one, and better with the laws as they are."""
        likely = self.drawn(weights) < other.drawn(weights)
        return likely & (self.drawn_exactly(weights) < other.drawn_exactly(weights))


@dataclass(frozen=True, eq=False)
class Without:
    """The structure without some terms of a cause, refitted."""

    terms: tuple[Term, ...]
    scored: Scored

    @property
    def name(self) -> tuple[str, str]:
        """The word of the cause and where it is."""
        return self.terms[0].name


@dataclass(frozen=True, eq=False)
class Pursuit:
    """The best structure, the last look at it, and what was refitted beside it at the end.

    ``without`` has the structures without each cause, all terms of it, ``rivals`` those with another cause in the place
    of a term, ``others`` what else was refitted at the last look. ``likeliest`` is the best one less the causes without
    which it scores better, ``without_one`` that without each of its causes. ``first`` is the model that was diagnosed,
    ``ended`` whether the search came to its end, ``refused`` what could not be written.
    """

    best: Scored
    look: Look
    first: Model
    without: tuple[Without, ...]
    rivals: tuple[tuple[Term, Scored], ...]
    others: tuple[Scored, ...]
    weights: Array
    likeliest: Scored
    without_one: tuple[Without, ...]
    looks: int
    ended: bool
    refused: tuple[str, ...] = ()

    @cached_property
    def winners(self) -> Counter[Names]:
        """The names of the structure that the search would take in each draw, and in how many.

        That is the best one, or the likeliest of those that are ahead of it.
        """
        found = [*(one.scored for one in self.without), *(one for _, one in self.rivals), *self.others]
        scores = [np.where(one.ahead(self.best, self.weights), one.drawn(self.weights), np.inf) for one in found]
        taken = np.argmin([self.best.drawn(self.weights), *scores], axis=0)
        return Counter([self.best, *found][number].model.names for number in taken)

    def probability(self, name: tuple[str, str], unexplained: float = 0.0) -> float:
        """How sure a cause is: the share of draws in which the best structure has it.

        Times its own part of what tells it from others and of what stays ``unexplained``, which might decide otherwise.
        """
        return self._share(lambda names: name in names) * self._own(name, unexplained)

    def presence(self, name: tuple[str, str], unexplained: float = 0.0) -> float:
        """The same where draws count in which another cause stands in its place, if it leads: something is there."""
        if not self.leads(name):
            return self.probability(name, unexplained)
        known = set(self.best.model.names)
        return self._share(lambda names: name in names or bool(set(names) - known)) * self._own(name, unexplained)

    def leads(self, name: tuple[str, str]) -> bool:
        """Whether no other cause stands in the place of one in more draws than it does itself."""
        own = self._share(lambda names: name in names)
        return max(self._in_place_of(name).values(), default=0) <= own * self.winners.total()

    def replacements(self, name: tuple[str, str], unexplained: float = 0.0) -> tuple[tuple[str, str], ...]:
        """The causes that stand in the place of one in more than one of ten draws.

        And those from which it is told by less than NAMED beside what stays ``unexplained``.
        """
        least, known = (1.0 - NAMED) * self.winners.total(), set(self.best.model.names)
        drawn = {new for new, count in self._in_place_of(name).items() if count > least}
        others = self._without_name(name) if unexplained else []
        near = [one for one in others if self._ahead_of(one, unexplained) < NAMED]
        return tuple(sorted(drawn.union(*(set(one.model.names) - known for one in near))))

    def _in_place_of(self, name: tuple[str, str]) -> Counter[tuple[str, str]]:
        """In how many draws which causes stand in the place of one."""
        found = Counter[tuple[str, str]]()
        for names, count in self.winners.items():
            if name not in names:
                found.update({new: count for new in names if new not in self.best.model.names})
        return found

    def _share(self, held: Callable[[Names], bool]) -> float:
        """The share of draws whose structure has names of which something holds."""
        return sum(count for names, count in self.winners.items() if held(names)) / self.winners.total()

    def _own(self, name: tuple[str, str], unexplained: float) -> float:
        """How surely a cause is told from a law that nobody has named, from chance, and from all in its place."""
        whole, less = self._alone(name)
        alone = _growth(whole, less, forms_err=True)
        if less is None or unexplained == 0.0:
            return float(alone > 0.0 or less is None)
        by_chance = agreed_by_chance(self.look.folds.groups)
        model = self.best.model
        mine = [term for term in model.causes if term.name == name]
        odds = min(against_unknown(term.cause, model.numbers_of(model.terms.index(term))) for term in mine)
        rivals = [self._ahead_of(other, unexplained) for other in self._without_name(name)]
        return min([share_of_both(alone, unexplained, odds), 1.0 - by_chance, *rivals])

    def _ahead_of(self, other: Scored, unexplained: float) -> float:
        """The probability of the best structure against one as simple, beside a share ``unexplained`` of the square.

        Both are laws that are known. Structure of unknown cause comes again in every cycle of a run, and more cycles
        tell no more of it: each group of runs is one observation, a normal deviate of unknown variance (BIC).
        """
        nats = 0.5 * self.look.folds.groups * np.log1p(self._behind(other) / unexplained)
        return float(1.0 / (1.0 + np.exp(-nats)))

    def _without_name(self, name: tuple[str, str]) -> list[Scored]:
        """The structures without a cause that have others in its place, and are as simple: no less likely beforehand.

        A law that has more numbers follows it whatever acts; a fault of the measurement is no law without evidence.
        """
        found = [*(one for _, one in self.rivals), *self.others]
        simple = [one for one in found if one.price <= self.best.price and not one.unproven]
        return [one for one in simple if name not in one.model.names]

    def _behind(self, other: Scored) -> float:
        """By what share the square is larger in a structure than in the best one, prior odds included."""
        return _share_of(other.score - self.best.score, self.best)

    def explained(self, name: tuple[str, str]) -> float:
        """By what share the square of the residual grows without a cause, all else refitted."""
        return _growth(self.best, self.without_cause(name), forms_err=False)

    def explained_alone(self, name: tuple[str, str]) -> float:
        """The same where the forms of the other terms may err: what none of these can take up."""
        return _growth(*self._alone(name), forms_err=True)

    def _alone(self, name: tuple[str, str]) -> tuple[Scored, Scored | None]:
        """The structure by which a cause is measured alone, and the same without it."""
        if gone := _without(self.without_one, name):
            return self.likeliest, gone
        return self.best, self.without_cause(name)

    def without_cause(self, name: tuple[str, str]) -> Scored | None:
        """The structure without all terms of a cause, refitted; None where it has none."""
        return _without(self.without, name)


def _without(found: Sequence[Without], name: tuple[str, str]) -> Scored | None:
    return next((one.scored for one in found if one.name == name), None)


def _growth(whole: Scored, less: Scored | None, forms_err: bool) -> float:
    """By what share the square of what is not predicted is larger in ``less``; 0 where there is none."""
    return _share_of(less.likelihood(forms_err) - whole.likelihood(forms_err), whole) if less else 0.0


def _share_of(nats: float, whole: Scored) -> float:
    """The share by which so many nats are a larger square, 0 where they are a smaller one."""
    with np.errstate(over="ignore"):  # infinite, where no error of another form comes near it
        return float(np.expm1(2.0 * max(nats, 0.0) / float(whole.samples.sum())))
