"""Faults of single runs, beside the structure that was found or beside the one without the laws that they imitate."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from dashpot.data.correction import Correction
from dashpot.diagnose.channel import Accused
from dashpot.diagnose.leftover import look_for_leftover
from dashpot.diagnose.look import Look, look_at
from dashpot.diagnose.pursue import Pursuer
from dashpot.diagnose.pursuit import NAMED, Pursuit, Scored, Without
from dashpot.diagnose.refit import Kept, Refitter
from dashpot.diagnose.score import Odds, nats
from dashpot.diagnose.term import Model, Term
from dashpot.fit.scored import ScoredRun

ROUNDS = 3  # of faults and fits; the same faults come back in the second one


@dataclass(frozen=True)
class Explained:
    """A model and the faults of single runs beside it, which together explain the data."""

    model: Model
    accused: tuple[Accused, ...]


def explained_with_runs(
    pursuer: Pursuer,
    pursuit: Pursuit,
    pairs: Sequence[tuple[str, str]],
    accuse_beside: Callable[[Look], list[Accused]],
) -> Explained:
    """The structure found with the faults of runs beside it, or what is more likely than both.

    A law that one group of runs alone shows is not tested by any other, and a fault of these runs does the same. So
    the structure without such laws, with the faults beside it, is their rival.
    """
    look, refitter = pursuit.look, pursuer.refitter
    found = [Explained(pursuit.best.model, faults_beside(refitter, look, pairs, accuse_beside))]
    for rest in without_untested(pursuer, pursuit):
        bare = look_at(refitter, rest.model, (), look.folds)
        accused = faults_beside(refitter, replace(look, model=rest.model, view=bare.view), pairs, accuse_beside)
        found += [Explained(rest.model, accused)] if accused else []
    return min(found, key=lambda one: _score(pursuer, look, one)) if len(found) > 1 else found[0]


def faults_beside(
    refitter: Refitter,
    look: Look,
    pairs: Sequence[tuple[str, str]],
    accuse_beside: Callable[[Look], list[Accused]],
) -> tuple[Accused, ...]:
    """The faults of single runs beside a model that they do not bend, those that are sure enough to be named.

    The model was fitted to the runs as they are. It is fitted to the corrected ones, and the faults are found again
    beside it, until the same ones come back.
    """
    accused = accuse_beside(look)
    if not accused:
        return ()
    for _ in range(ROUNDS):
        right = put_right(refitter, accused)
        beside = look_at(right, right.fit(look.model, look.noise), (), look.folds)
        before, accused = accused, accuse_beside(beside)
        if {(one.run, one.kind) for one in before} == {(one.run, one.kind) for one in accused}:
            break
    right = put_right(refitter, accused)
    left = look_for_leftover(right, replace(look, model=right.fit(look.model, look.noise)), pairs)
    return tuple(one for one in (each.judged(left.share) for each in accused) if one.probability >= NAMED)


def without_untested(pursuer: Pursuer, pursuit: Pursuit) -> Iterator[Scored]:
    """The structures without the laws that a single group of runs shows, for each such group, refitted."""
    odds = Odds(pursuit.look.layout.bank)
    terms: dict[frozenset[int], list[Term]] = {}
    for one in pursuit.without:
        group = _shown_by_one(one, pursuit)
        if group:
            terms.setdefault(group, []).extend(one.terms)
    for gone in terms.values():
        yield pursuer.without(pursuit.look, pursuit.best, tuple(gone), odds).scored


def _shown_by_one(without: Without, pursuit: Pursuit) -> frozenset[int]:
    """The folds of the group of runs that alone shows a cause; none where others show it, too.

    They show it where it is worth its prior odds without that group.
    """
    best, rest = pursuit.best, without.scored
    costs = best.samples * (rest.exact - best.exact)
    groups = pursuit.look.folds.together()
    most = max(groups, key=lambda group: float(costs[list(group)].sum()))
    weights = np.ones(costs.size)
    weights[list(most)] = 0.0
    if not weights.any():
        return frozenset()
    samples = weights * best.samples
    shown = float(nats(rest.exact, samples) - nats(best.exact, samples))
    return frozenset() if shown > best.price - rest.price else most


def _score(pursuer: Pursuer, look: Look, one: Explained) -> float:
    """Minus the log of likelihood and prior, of model and faults together, under the noise of a look."""
    right, odds = put_right(pursuer.refitter, one.accused), Odds(look.layout.bank)
    model = right.fit(one.model, look.noise)
    faults = sum(odds.price("measurement", each.strengths.size) for each in one.accused)
    return replace(pursuer, refitter=right, doubted=()).scored(look, model, odds).score + faults


def put_right(refitter: Refitter, accused: Sequence[Accused]) -> Refitter:
    """A refitter of the corrected runs."""
    return replace(refitter, runs=[corrected(run, accused) for run in refitter.runs], reduced=Kept())


def corrected(run: ScoredRun, accused: Sequence[Accused]) -> ScoredRun:
    """A run without its faults."""
    correction = correction_of(run.name, accused)
    return replace(run, force=correction.apply(run.force, run.drive.dt)) if correction else run


def correction_of(run: str, accused: Sequence[Accused]) -> Correction | None:
    """What puts a run right; None for a sound one."""
    found = None
    for one in (one for one in accused if one.run == run):
        found = found.then(one.correction) if found else one.correction
    return found
