"""Looking again at what was accepted, once a later cause is there: some owed their place to what was still missing."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from dashpot.assess import reasons
from dashpot.assess.accepted import Accepted
from dashpot.assess.contest import Model, admitted, measured_from
from dashpot.assess.court import REFIT_MAY_DOUBLE, SHARE_OF_FORM, Court, within_form
from dashpot.assess.finalists import TIE, choose_finalists, cost, imitates, makes_up
from dashpot.assess.instead import simplified
from dashpot.assess.screen import Finding
from dashpot.assess.suspicion import Look

MOST_OTHERS = 2
MOST_PLACES = 8  # of a fault of single runs: to look at each of more is too long a search
MOST_EXCHANGED = 3  # beside more causes than these an exchange is too long a search for too little


@dataclass(frozen=True, eq=False)
class Revision:
    """Revises accepted causes before a court; ``first`` is the model without any of them.

    ``contest(look, explained)`` accepts the best of all that a look has found beside what is explained, or nothing.
    """

    court: Court
    first: Model
    contest: Callable[[Look, float], Sequence[Accepted]]

    def revise(self, accepted: list[Accepted], look: Look) -> tuple[list[Accepted], Look]:
        """The causes that stay, or others in their places, and a look at the model with them."""
        accepted, look = self.part(accepted, look)
        settled, look = self.reconsider(*self.merge(accepted, look))
        newest = next((entry for entry in settled if not any(entry is other for other in accepted)), None)
        return self.exchange(*self.prune(settled, look), newest)

    def part(self, accepted: list[Accepted], look: Look) -> tuple[list[Accepted], Look]:
        """Put another cause in the place of the last one in one run of several, if it is a fault of single runs."""
        entry = accepted[-1]
        places = range(len(entry.finding.atoms))
        for place in places if entry.finding.candidate.suspect.local and 1 < len(places) <= MOST_PLACES else ():
            if self.court.effort.spent:
                break
            others = [other for other in places if other != place]
            rest = replace(entry, finding=entry.finding.keeping(others))
            mends = [mend.keeping(rest.finding, others) if mend.finding is entry.finding else mend
                     for mend in look.model.mends]  # fmt: skip
            model = self.court.bench.fit(look.model.declared, look.model.fitted, look.noise, mends)
            instead = self.better_than(entry, model, look, [rest])
            if instead is not None and instead.finding.candidate.suspect.local:
                return [*accepted[:-1], rest, instead], self.court.look(instead.trial.model, look.noise)
        return accepted, look

    def merge(self, accepted: list[Accepted], look: Look) -> tuple[list[Accepted], Look]:
        """Put a rival of the first law that can make up this law in the place of both, where it explains as much.

        Faults of the measurement stay.
        """
        laws = [entry for entry in accepted if not entry.finding.candidate.suspect.mends]
        for trial in laws[0].others if len(laws) == 2 and laws[1] is accepted[-1] else ():
            if imitates(trial.finding, laws[0].finding):
                one = replace(laws[0], finding=trial.finding, trial=trial, rivals=(), others=(), simpler=())
                merged = [one if entry is laws[0] else entry for entry in accepted[:-1]]
                model = self.court.rebuild(merged, look.model, self.first, look.noise)
                if succeeds(model, look, lead=-TIE):
                    self.court.reject(laws[0].finding, reasons.ONE_LAW, None, None)
                    alone = model if len(merged) == 1 else trial.model
                    gain = self.court.gain_of(one.base, alone) if one.base else None
                    entry = replace(one, trial=replace(trial, model=model), gain=gain)
                    return [entry if each is one else each for each in merged], self.court.look(model, look.noise)
        return accepted, look

    def prune(self, accepted: list[Accepted], look: Look) -> tuple[list[Accepted], Look]:
        """Drop an earlier cause that the last one made superfluous, or its opposite: that takes its place in the order.

        It is superfluous, too, where it explains no more than the others may be wrong by in their form, unless one of
        these would no longer be what it says. The form that was dropped does not come back. Where the last one only
        makes up the law of the earlier one, it is the last one that goes. What turned into another cause gets its name.
        """
        last = accepted[-1]
        for number, entry in enumerate(accepted[:-1]):
            kept = [*accepted[:number], *accepted[number + 1 :]]
            model = self.court.rebuild(kept, look.model, self.first, look.noise)
            superfluous = self.is_superfluous(kept, model, look)
            if superfluous and last.base and makes_up(last.finding, entry.finding, last.trial.gain, self.fall_to(look)):
                self.court.bar_imitation(last, entry)
                return accepted[:-1], self.court.look(last.base, look.noise)
            opposite = not admitted(entry.trial, entry.base, look.model)
            turned = opposite and not superfluous and not self.court.effort.spent
            renamed = self.renamed(entry, accepted, model, look) if turned else None
            if renamed:
                self.court.swap(entry, reasons.OPPOSITE)
                changed = [*accepted[:number], renamed, *accepted[number + 1 :]]
                return self.prune(changed, self.court.look(renamed.trial.model, look.noise))
            if superfluous or opposite:
                self.court.bar(entry, reasons.SUPERFLUOUS if superfluous else reasons.OPPOSITE)
                kept = [*accepted[:number], last, *accepted[number + 1 : -1]]
                return self.prune(kept, self.court.look(model, look.noise))
        return accepted, look

    def fall_to(self, look: Look) -> float:
        """The fall of chi square from the first model to that of a look."""
        return self.first.chi_square - look.model.chi_square

    def is_superfluous(self, kept: Sequence[Accepted], model: Model, look: Look) -> bool:
        """Whether the ``model`` with what is ``kept`` does nearly as well as that of a look and holds what it says."""
        fall = model.chi_square - look.model.chi_square
        cheaper = cost(model, look) < cost(look.model, look) + look.screen.threshold
        little = cheaper or within_form(fall, model.chi_square, self.fall_to(look))
        return little and all(admitted(other.trial, other.base, model, self.first) for other in kept)

    def renamed(self, entry: Accepted, accepted: Sequence[Accepted], model: Model, look: Look) -> Accepted | None:
        """The cause that a cause has become by its numbers: one that does as well beside those as they stand, or None.

        ``model`` is that of all others that are accepted.
        """
        reduced = self.court.glance(self.court.reduced(accepted, entry, look, self.first), look)
        found = choose_finalists(self.court.admissible(reduced, exchange=True), reduced)
        for finding in (one for one in found if one.candidate.name != entry.finding.candidate.name):
            trial = self.court.try_out(finding, reduced)
            if not trial.failure and succeeds(trial.model, look, lead=-TIE):
                foreseen, gain = self.court.foresee(finding, reduced), self.court.gain_of(model, trial.model)
                return Accepted(finding, measured_from(model, trial), foreseen, gain, (), base=model)
        return None

    def reconsider(self, accepted: list[Accepted], look: Look) -> tuple[list[Accepted], Look]:
        """Put a simpler cause in the place of an earlier one that owed its lead to what a later one explains."""
        for number, entry in enumerate(accepted[:-1]):
            for trial in entry.simpler:
                instead = replace(entry, finding=trial.finding, trial=trial, rivals=(), others=(), simpler=())
                changed = [*accepted[:number], instead, *accepted[number + 1 :]]
                model = self.court.rebuild(changed, look.model, self.first, look.noise)
                alike = cost(model, look) < cost(look.model, look) + TIE
                if alike and admitted(trial, entry.base, model, self.first):
                    self.court.reject(entry.finding, reasons.SIMPLER_WILL_DO, None, None)
                    return changed, self.court.look(model, look.noise)
        return accepted, look

    def exchange(
        self, accepted: list[Accepted], look: Look, newest: Accepted | None = None
    ) -> tuple[list[Accepted], Look]:
        """Put another cause in the place of one that won only because the ``newest`` one was still missing.

        Without a newest one it is the last; what was put in is the newest to the others. Where it explains less than
        the newest one did, it comes last. One of two of a kind may only make up what the form of the other one misses.
        """
        newest = next((entry for entry in accepted if entry is newest), accepted[-1])
        older = [entry for entry in accepted if entry is not newest]
        for entry in older if len(accepted) <= MOST_EXCHANGED and not self.court.effort.spent else ():
            kept = [other for other in accepted if other is not entry]
            model = self.court.rebuild(kept, look.model, self.first, look.noise)
            twice = _names([entry]) & _names(kept)
            least = SHARE_OF_FORM * self.fall_to(look) if twice else -np.inf
            instead = self.better_than(entry, model, look, kept, least)
            if instead is not None:
                self.court.swap(entry, reasons.BETTER_BESIDE_THE_LATER)
                weak = instead.trial.gain < newest.trial.gain
                changed = [*kept, instead] if weak else [instead if other is entry else other for other in accepted]
                return self.exchange(changed, self.court.look(instead.trial.model, look.noise), instead)
        return accepted, look

    def better_than(
        self, entry: Accepted, model: Model, look: Look, kept: Sequence[Accepted], least: float = -np.inf
    ) -> Accepted | None:
        """Another cause that does better than an accepted one beside those that are ``kept``, the ``model``, or None.

        Where there is one, the best of all takes the place, with its rivals, unless that is the cause which was there:
        what does better only imitates it. ``least`` is the least fall of chi square that it has to bring.
        """
        glance = self.court.glance(model, look)
        for finding in self.others_than(entry, glance, model.chi_square - look.model.chi_square):
            trial = self.court.try_out(finding, glance)
            if trial.failure:
                continue
            trial = simplified(self.court, trial, glance)
            gain = self.court.gain_of(look.model, trial.model)
            enough = succeeds(trial.model, look) and look.model.chi_square - trial.model.chi_square > least
            if enough and (gain is None or gain.value >= -self.court.relevance):
                found = Accepted(trial.finding, trial, self.court.foresee(finding, glance), gain, (), base=model)
                explained = max(self.first.chi_square - model.chi_square, 0.0) if kept else 0.0
                winners = self.contest(glance, explained)
                better = [one for one in winners if succeeds(one.trial.model, look)]
                if len(better) == 1:
                    return better[0]
                return None if _names([entry]) & (_names(winners) - _names(kept)) else found
        return None

    def others_than(self, entry: Accepted, look: Look, fall: float) -> list[Finding]:
        """The few findings of other causes that promise most of a fall of chi square."""
        name = entry.finding.candidate.name
        found = choose_finalists(self.court.admissible(look, exchange=True), look)
        return [one for one in found if one.candidate.name != name and one.gain > REFIT_MAY_DOUBLE * fall][:MOST_OTHERS]


def _names(accepted: Sequence[Accepted]) -> set[tuple[str, str]]:
    return {entry.finding.candidate.name for entry in accepted}


def succeeds(model: Model, look: Look, lead: float = TIE) -> bool:
    """Whether a model fits better than that of a look by its numbers' price and a ``lead``, or ties with fewer."""
    found = cost(look.model, look) - cost(model, look)
    return bool(found >= (-TIE if model.numbers < look.model.numbers else lead))
