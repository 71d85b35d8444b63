"""Terms that exclude each other: a number of a network follows one setting or channel, and no other beside it."""

from __future__ import annotations

from collections.abc import Iterator

from dashpot.diagnose.score import Scores, Structure
from dashpot.diagnose.term import Model, Part, Term


def dependent_numbers(scores: Scores, structure: Structure) -> frozenset[str]:
    """The numbers that follow something in a structure: in the diagnosed network, by terms that stay or that join."""
    return frozenset().union(*_each(scores, structure))


def can_be_beside(scores: Scores, structure: Structure) -> bool:
    """Whether no number follows two things in a structure."""
    return sum(map(len, _each(scores, structure))) == len(dependent_numbers(scores, structure))


def without_rivals(model: Model, term: Term) -> list[Part]:
    """The terms of a model beside which a new one can be: they make none of its numbers follow something else."""
    return [one for one in model.terms if not (isinstance(one, Term) and one.dependent & term.dependent)]


def _each(scores: Scores, structure: Structure) -> Iterator[frozenset[str]]:
    model, candidates = scores.look.model, scores.look.candidates
    yield frozenset(slot.path for slot in model.base.slots() if slot.value.over)
    yield from (
        term.dependent
        for number, term in enumerate(model.terms)
        if isinstance(term, Term) and number not in structure.dropped
    )
    for k, places in structure.added:
        each = candidates[k].suspect.each_dependent
        yield frozenset(each[place] for place in places) - {""}
