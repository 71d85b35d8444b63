"""What a trial is accepted as: with fewer places, as one of two simpler causes that it makes up, in a plainer form,
as a cause of all runs in place of faults of many, or as one of a usual sign.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from dashpot.assess.contest import Trial
from dashpot.assess.court import Court
from dashpot.assess.finalists import TIE, choose_finalists, cost, parts_of, plainer, unusual
from dashpot.assess.suspicion import Look
from dashpot.fit.refine import Outcome

MOST_NEXT = 2
COMES_NEAR = 0.8  # of a fall of chi square
MANY_RUNS = 4  # with a fault of their own: what acts in all runs may look so


def simplified(court: Court, trial: Trial, look: Look) -> Trial:
    """The trial with fewer places of the grid, as long as the refit does not miss the last one."""
    atoms = trial.finding.atoms
    if trial.finding.candidate.suspect.joint or len(atoms) < 2:
        return trial
    simpler = court.try_out(trial.finding.without_last(), look)
    return simplified(court, simpler, look) if simpler.merit > trial.merit else trial


def part_of(court: Court, trial: Trial, look: Look) -> Trial | None:
    """The stronger one of two causes whose laws a trial makes up, if both explain more: with more numbers what matters.

    The weaker one is found as the next.
    """
    parts = parts_of(trial.finding, court.admissible(look))
    if len({part.candidate.name for part in parts}) < 2:
        return None
    alone = court.try_out(parts[0], look)
    beside = court.glance(alone.model, look)
    rest = parts_of(trial.finding, court.admissible(beside), parts[0])
    both = court.try_out(rest[0], beside) if rest else alone
    return alone if _outdoes(court, both, trial, look) and not alone.failure else None


def plainer_form(court: Court, trial: Trial, ranked: Sequence[Trial], look: Look) -> Trial | None:
    """Another form of the same cause with fewer numbers that explains more beside one more cause.

    More than the trial alone, by what is of interest at all, and more than that beside its own next cause.
    """
    for other in plainer(trial, ranked) if court.leaves_room(trial.model, look) else ():
        form = court.try_out(other.finding, look) if other.model.outcome is Outcome.LEFT_BEHIND else other
        relevant = trial.model.chi_square * (1.0 - court.relevance) ** 2
        better = [both for both in with_the_next(court, form, look) if both.model.chi_square < relevant]
        if better and not form.failure:
            both = max(better, key=_by_merit)
            same = max(with_the_next(court, trial, look), key=_by_merit, default=trial)
            if cost(both.model, look) + TIE <= cost(same.model, look):
                return form
    return None


def of_all_runs(court: Court, trial: Trial, ranked: Sequence[Trial], look: Look) -> Trial | None:
    """A cause of all runs that comes near a fault of many single ones, if it explains more beside its next cause."""
    if not trial.finding.candidate.suspect.local or len(trial.finding.atoms) < MANY_RUNS:
        return None
    return _near([other for other in ranked if not other.finding.candidate.suspect.local], court, trial, look)


def of_usual_sign(court: Court, trial: Trial, ranked: Sequence[Trial], look: Look) -> Trial | None:
    """A cause that comes near one of an unusual sign, if it explains more beside its next cause."""
    if not unusual(trial.finding) or not court.leaves_room(trial.model, look):
        return None
    return _near([other for other in ranked if not unusual(other.finding)], court, trial, look)


def _near(others: Sequence[Trial], court: Court, trial: Trial, look: Look) -> Trial | None:
    sound = [other for other in others if not other.failure]
    for other in [other for other in sound if other.gain > COMES_NEAR * trial.gain][:1]:
        form = court.try_out(other.finding, look) if other.model.outcome is Outcome.LEFT_BEHIND else other
        if any(_outdoes(court, both, trial, look) for both in with_the_next(court, form, look)):
            return form
    return None


def with_the_next(court: Court, trial: Trial, look: Look) -> list[Trial]:
    """A trial beside each of the best other causes of a glance at it, where they hold what they say."""
    beside = court.glance(trial.model, look)
    found = choose_finalists(court.admissible(beside), beside)
    others = [one for one in found if one.candidate.name != trial.finding.candidate.name][:MOST_NEXT]
    return [each for each in (court.try_out(one, beside) for one in others) if not each.failure]


def _outdoes(court: Court, both: Trial, trial: Trial, look: Look) -> bool:
    """Whether the model with two causes fits better than that of a trial; with more numbers by what is of interest."""
    more = both.model.numbers - trial.model.numbers
    least = TIE + max(more, 0) * np.log(look.screen.samples)
    needed = (1.0 - court.relevance) ** 2 if more > 0 else 1.0
    better = both.model.chi_square <= min(trial.model.chi_square - least, needed * trial.model.chi_square)
    return better and not both.failure


def _by_merit(trial: Trial) -> float:
    return trial.merit
