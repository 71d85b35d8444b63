"""Finding causes one after the other: screen, refit the finalists, accept the best, look again, revise.

A cause is accepted when its refitted model is better by more than its parameters cost and by more than pure noise could
fake, and when it makes runs better that nobody fitted.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise

import numpy as np

from dashpot.assess import reasons
from dashpot.assess.accepted import Accepted, Rejection, certain_faults, likely_fault, without_doubt
from dashpot.assess.contest import Model, Trial, admitted
from dashpot.assess.court import BEYOND_FORM, FORM_ERROR, SMALLEST_LATER_GAIN, Court
from dashpot.assess.erring import beyond_sensors
from dashpot.assess.finalists import (
    TIE,
    alike,
    choose_finalists,
    cost,
    form_of,
    imitated,
    in_doubt,
    settle_ties,
    simpler,
    to_beat,
)
from dashpot.assess.gain import Gain
from dashpot.assess.instead import of_all_runs, of_usual_sign, part_of, plainer_form, simplified, with_the_next
from dashpot.assess.misfits import balanced, plainly_strong
from dashpot.assess.revision import Revision
from dashpot.assess.screen import Finding
from dashpot.assess.suspicion import Look
from dashpot.assess.unseen import Jury, known_directions
from dashpot.fit.refine import Outcome

MOST_CAUSES = 5
MOST_STARTS = 3  # of a search for two other causes


@dataclass(frozen=True, eq=False)
class Pursuit:
    """The way from the first look to the last one.

    ``ladder`` holds the first model and the model after each accepted cause, refitted to the plain error in N.
    ``least_force`` is the RMS in N that a cause has to add to the last model to be of interest. ``cut_short`` says that
    the search ended after so many looks that more than one way to explain the data may be left untried.
    """

    first: Look
    last: Look
    accepted: tuple[Accepted, ...]
    rejected: tuple[Rejection, ...]
    tried: int
    ladder: tuple[Model, ...]
    least_force: float
    cut_short: bool = False

    @property
    def explained(self) -> float:
        """The RMS of what the accepted causes explain on the training runs, in units of the noise."""
        falls = sum(entry.trial.gain for entry in self.accepted if entry.base is not None)
        return float(np.sqrt(max(falls, 0.0) / self.last.screen.samples))


@dataclass(eq=False)
class Pursuer:
    """Runs a pursuit before a court; ``tried`` counts the candidates."""

    court: Court
    watch: Callable[[str, float], None]
    tried: int = 0

    def run(self, model: Model) -> Pursuit:
        """Accept causes until nothing significant is left."""
        court = self.court
        self.watch("first look", 0.0)
        first = look = court.first_look(model)
        accepted, look = self.other_two(*self.another_way(*self.pursue([], look, first), first), first)
        accepted, look, ladder = self.settle_gains(accepted, look, first)
        while opposite := [entry for entry in accepted if not admitted(entry.trial, entry.base, ladder[-1])]:
            court.bar(opposite[-1], reasons.OPPOSITE)
            court.readmit_imitations(opposite[-1])
            kept = [entry for entry in accepted if entry.base and entry is not opposite[-1]]
            look = court.look(court.rebuild(kept, look.model, first.model, look.noise), look.noise)
            accepted, look = (kept, look) if court.effort.spent else self.pursue(kept, look, first)
            accepted, look, ladder = self.settle_gains(accepted, look, first)
        left = [look.columns.residual[run.name] for run in court.bench.runs]
        error = balanced(beyond_sensors(left, court.bench.runs, court.bench.sensors))
        least_force = float(np.sqrt(1.0 - (1.0 - court.relevance) ** 2) * error)
        named = {entry.finding.candidate.name for entry in accepted}
        rejected = tuple(one for one in court.rejected if (one.cause, one.place or "") not in named)
        return Pursuit(first, look, tuple(accepted), rejected, self.tried, tuple(ladder), least_force,
                       court.effort.spent)  # fmt: skip

    def pursue(
        self, accepted: list[Accepted], look: Look, first: Look, most: int = MOST_CAUSES
    ) -> tuple[list[Accepted], Look]:
        """Add causes to those that are accepted, as long as there are any that hold, and no more than ``most``."""
        revision = Revision(self.court, first.model, partial(self.best_trial, exchange=True))
        while len(accepted) < most and not (accepted and self.court.effort.spent):
            self.tried += len(look.screen.findings)
            explained = first.model.chi_square - look.model.chi_square if accepted else 0.0
            self.court.made_up = {word for entry in accepted for word in entry.finding.candidate.suspect.imitates}
            winners = self.best_trial(look, max(explained, 0.0))
            self.court.made_up = set()
            if not winners:
                break
            words = " and ".join(winner.finding.candidate.cause.word for winner in winners)
            self.watch(f"accepted {words}", (len(accepted) + len(winners)) / MOST_CAUSES)
            model = winners[-1].trial.model
            look = self.court.look_after(model, look, max(first.model.chi_square - model.chi_square, 0.0))
            accepted, look = revision.revise([*accepted, *winners], look)
        return accepted, look

    def another_way(self, accepted: list[Accepted], look: Look, first: Look) -> tuple[list[Accepted], Look]:
        """What is found without a cause that was accepted twice, if it is better: two of a kind may imitate others."""
        twice = needed_twice(accepted)
        if not twice or self.court.effort.spent:
            return accepted, look
        forms = {form_of(finding) for finding in first.screen.findings if finding.candidate.name in twice}
        court = replace(self.court, rejected=[], barred=self.court.barred | forms, exchanged=set())
        other = Pursuer(court, self.watch)
        instead, seen = other.pursue([], first, first, len(accepted))
        self.tried += other.tried
        if needed_twice(instead) or cost(seen.model, look) + TIE > cost(look.model, look):
            return accepted, look
        for entry in (entry for entry in accepted if entry.finding.candidate.name in twice):
            self.court.bar(entry, reasons.BETTER_WITHOUT)
        self.court.barred |= forms
        self.court.rejected.extend(other.court.rejected)
        return instead, seen

    def other_two(self, accepted: list[Accepted], look: Look, first: Look) -> tuple[list[Accepted], Look]:
        """Two other causes, if they explain more than the two accepted ones by what forms may be wrong by.

        What explains most alone need not be one of the two that explain most together.
        """
        court = self.court
        if len(accepted) != 2 or court.effort.spent:
            return accepted, look
        own = court.bench.as_it_stands(look.model.declared, look.model.fitted, first.noise, look.model.mends)
        lead = max(TIE, BEYOND_FORM * (first.model.chi_square - own.chi_square))
        best = min(self.pairs_without(accepted[0], first), key=lambda pair: cost(pair[1].model, first), default=None)
        if best is None or cost(best[1].model, first) + lead > cost(own, first):
            return accepted, look
        trial = best[0]
        gain = court.gain_of(first.model, trial.model)
        entry = Accepted(trial.finding, trial, court.foresee(trial.finding, first), gain, (), base=first.model)
        instead, seen = self.pursue([entry], court.look(trial.model, first.noise), first, 2)
        after = court.bench.as_it_stands(seen.model.declared, seen.model.fitted, first.noise, seen.model.mends)
        if len(instead) != 2 or cost(after, first) + lead > cost(own, first):
            return accepted, look
        for one in (one for one in accepted if not _named_in(one, instead)):
            court.reject(one.finding, reasons.OTHER_TWO, one.expected_gain, None)
        return instead, seen

    def pairs_without(self, entry: Accepted, look: Look) -> list[tuple[Trial, Trial]]:
        """The best finalists of a look but for the cause of an entry, each beside the best next causes."""
        court, name = self.court, entry.finding.candidate.name
        others = [one for one in choose_finalists(court.admissible(look), look) if one.candidate.name != name]
        trials = [court.try_out(one, look) for one in others[:MOST_STARTS]]
        sound = [trial for trial in trials if not trial.failure]
        return [(trial, both) for trial in sound for both in with_the_next(court, trial, look)]

    def faults_of_held_out(
        self, look: Look, last: Model, explained: float, known: Collection[str] = ()
    ) -> list[Accepted]:
        """Faults of held-out runs as further causes, each with the last model less all faults so far.

        They have to make these runs better for certain, by as much as any cause after the first, and by more than what
        is ``explained`` already (the fall of chi square) may be wrong by in its form. Of faults alike it is one whose
        word is ``known`` of other runs.
        """
        court, found = self.court, []
        if not court.held_out:
            return []
        least = max(court.relevance, SMALLEST_LATER_GAIN)
        expected = explained * sum(run.samples for run in court.held_out) / look.screen.samples
        directions = known_directions(court.bench, look.model, look.noise)
        jury = Jury(replace(court.bench, runs=court.held_out, unseen=()), directions, court.causes, court.seed)
        for _ in court.held_out:
            fault = jury.faulty(replace(look.model, mends=last.mends), known)
            if fault is None:
                break
            finding, mend, rivals = fault
            model = replace(last, mends=(*last.mends, plainly_strong(mend, last, court.held_out)))
            gain = court.gain_of(last, model)
            if gain is None or gain.interval[0] <= 0.0 or gain.value < least:
                break
            if gain.value < FORM_ERROR and finding.gain < BEYOND_FORM * expected:
                break
            trial = Trial(finding, model, finding.gain, finding.merit)
            found.append(Accepted(finding, trial, gain.value, gain, rivals))
            last = model
        return found

    def settle_gains(
        self, accepted: list[Accepted], look: Look, first: Look
    ) -> tuple[list[Accepted], Look, list[Model]]:
        """The gain of every cause in plain error; one that gains nothing on held-out runs goes, the last one first.

        The first cause has to hold there, a further one to gain what is of interest at all, be it as the last of all;
        faults of the held-out runs themselves come last.
        """
        court = self.court
        ladder = self.polish_ladder(first.model, accepted, look)
        explained = max(first.model.chi_square - look.model.chi_square, 0.0) if accepted else 0.0
        likely = certain_faults(accepted) or likely_fault(accepted)
        faults = self.faults_of_held_out(look, ladder[-1], explained, likely)
        known = certain_faults([*accepted, *faults])
        if agreed := court.agreed(accepted, known or likely, look):
            return self.settle_gains(*agreed, first)
        gains = [court.gain_beside(faults, before, after) for before, after in pairwise(ladder)]
        for number in self.useless(gains):
            gains[number] = self.gain_of_last(number, accepted, look, ladder) or gains[number]
        useless = self.useless(gains)
        if useless == [0] and court.holds(first.model, accepted[0].trial.model, gains[0]):
            useless = []
        if not useless:
            proved = [replace(entry, gain=gain) for entry, gain in zip(accepted, gains, strict=True)]
            return without_doubt([*proved, *faults], known), look, [*ladder, *(fault.trial.model for fault in faults)]
        entry = accepted[useless[-1]]
        court.reject(entry.finding, reasons.NOT_SUPPORTED, entry.expected_gain, gains[useless[-1]])
        kept = [other for other in accepted if other is not entry]
        return self.settle_gains(kept, court.look_without(entry, kept, look, first.model), first)

    def useless(self, gains: Sequence[Gain | None]) -> list[int]:
        """The numbers of the gains that are too small to be of interest."""
        return [number for number, gain in enumerate(gains) if gain is not None and gain.value <= self.court.relevance]

    def gain_of_last(
        self, number: int, accepted: Sequence[Accepted], look: Look, ladder: Sequence[Model]
    ) -> Gain | None:
        """The gain of a cause beside all others, if it is of interest."""
        others = [*accepted[:number], *accepted[number + 1 :]]
        if not others:
            return None
        without = self.court.rebuild(others, look.model, ladder[0], None)
        gain = self.court.gain_of(without, ladder[len(accepted)])
        return gain if gain and gain.value > self.court.relevance else None

    def polish_ladder(self, first: Model, accepted: Sequence[Accepted], last: Look) -> list[Model]:
        """The first model and the one after each cause, all fitted to the plain error, so that their gains compare."""
        self.watch("final refits", 0.0)
        models = [self.court.rebuild(accepted[:count], last.model, first, None) for count in range(1, len(accepted))]
        steps = [first, *models, last.model] if accepted else [first]
        return [self.court.bench.fit(step.declared, step.fitted, None, step.mends) for step in steps]

    def best_trial(self, look: Look, explained: float, exchange: bool = False) -> list[Accepted]:
        """The best finalist that holds on runs that took no part, else two that hold together, else none.

        In ``exchange`` for another cause those may come back that were themselves exchanged.
        """
        court, trials = self.court, self.refit_finalists(look, explained, exchange)
        imitations: list[Trial] = []
        unsupported: list[Trial] = []
        while trials:
            trial, *rest = ranked = sorted(trials, key=lambda trial: -trial.merit)
            if trial.model.outcome is Outcome.LEFT_BEHIND:
                trials = [court.try_out(each.finding, look) for each in ranked]
                continue
            gain, reason = self.examine(trial, look, explained)
            if reason:
                court.reject(trial.finding, reason, court.foresee(trial.finding, look), gain)
                unsupported += [trial] * (reason == reasons.NOT_SUPPORTED)
            elif any(not court.examine(other, look, explained)[1] for other in imitated(trial, rest)):
                imitations.append(trial)
            else:
                return [self.accept(ranked, imitations, gain, look)]
            trials = rest
        return self.best_pair(unsupported[0], look, explained) if unsupported else []

    def examine(self, trial: Trial, look: Look, explained: float) -> tuple[Gain | None, str]:
        """The gain of a trial and why it may not be accepted; faults of the held-out runs alone do not refuse it."""
        gain, reason = self.court.examine(trial, look, explained)
        if reason != reasons.NOT_SUPPORTED or trial.finding.candidate.suspect.local:
            return gain, reason
        faults = self.faults_of_held_out(replace(look, model=trial.model), trial.model, explained + trial.gain)
        beside = self.court.gain_beside(faults, look.model, trial.model)
        return (beside, "") if beside and beside.value > self.court.relevance else (gain, reason)

    def best_pair(self, trial: Trial, look: Look, explained: float) -> list[Accepted]:
        """A trial that does not hold alone and the best one beside it, if together they make unseen runs better.

        Where two causes are hidden, the numbers of the model may stand in for one of them all the worse on unseen runs,
        once the other one is taken out.
        """
        court, beside = self.court, self.court.look(trial.model, look.noise)
        explained += trial.gain
        ranked = sorted(self.refit_finalists(beside, explained), key=lambda other: -other.merit)
        for number, other in enumerate(ranked):
            gain = court.gain_of(look.model, other.model)
            change = court.share_of_change(beside.model, other.model)
            if gain is not None and not court.objection(other, gain, change, beside, explained):
                first = Accepted(trial.finding, trial, court.foresee(trial.finding, look), None, (), base=look.model)
                return [first, self.accept(ranked[number:], (), gain, beside)]
        return []

    def accept(self, ranked: Sequence[Trial], imitations: Sequence[Trial], gain: Gain | None, look: Look) -> Accepted:
        """The first of the ``ranked`` trials, which holds and has this gain, or a simpler one alike; its rivals."""
        court, trial = self.court, ranked[0]
        level = alike(trial, ranked)
        near = [other for other in level if court.holds_as_well(other, trial, gain, look)]
        chosen, others = settle_ties(near)
        doubtful = tuple(other for other in imitations if in_doubt(other, chosen))
        for other in (other for other in (*ranked, *imitations) if other not in (*near, *doubtful)):
            court.reject(other.finding, _why_not(other, level, imitations), None, None)
        part = part_of(court, chosen, look) or plainer_form(court, chosen, ranked, look)
        part = part or of_all_runs(court, chosen, ranked, look) or of_usual_sign(court, chosen, ranked, look)
        chosen, others = (part, ()) if part else (simplified(court, chosen, look), (*others, *doubtful))
        chosen = court.brought_back(chosen, look)
        rivals = tuple(dict.fromkeys(other.finding.candidate.cause.word for other in others))
        foreseen = court.foresee(chosen.finding if part else finding_of(trial, look), look)
        gain = court.gain_of(look.model, chosen.model)
        return Accepted(chosen.finding, chosen, foreseen, gain, rivals, others, look.model, simpler(chosen, ranked))

    def refit_finalists(self, look: Look, explained: float, exchange: bool = False) -> list[Trial]:
        """The best findings of a look as refitted models; later causes only where they may be worth a name."""
        court = self.court
        trials: list[Trial] = []
        for finding in choose_finalists(court.admissible(look, exchange), look):
            if explained and not court.worth_a_refit(finding, look, explained):
                reason = reasons.TOO_LITTLE.format(least=court.least_later_gain(finding, look, explained))
                court.reject(finding, reason, court.foresee(finding, look), None)
                continue
            self.watch(f"refit with {' '.join(finding.candidate.name).strip()}", 0.0)
            trials.append(court.try_out(finding, look, to_beat(trials, finding, look)))
        return trials if explained or exchange else self.refit_put_back(trials, look)

    def refit_put_back(self, trials: list[Trial], look: Look) -> list[Trial]:
        """The best trial of each form, from the present numbers or with those that went astray put back first.

        Numbers that a strong effect has driven far away do not always find their way back beside its cause, and do not
        let the screen see it. Where a trial leaves no more than noise there is nothing else to see.
        """
        court, astray = self.court, look.model.astray
        best = {form_of(trial.finding): trial for trial in trials}
        if not (astray and trials and all(court.leaves_room(trial.model, look) for trial in trials)):
            return trials
        back = court.put_back(look, astray)
        for finding in choose_finalists(court.admissible(back), back):
            self.watch(f"refit with {' '.join(finding.candidate.name).strip()}", 0.0)
            trial = court.try_out_from(finding, back, look, to_beat(list(best.values()), finding, look))
            form = form_of(finding)
            best[form] = max(trial, best.get(form, trial), key=lambda each: each.merit)
        return list(best.values())


def _why_not(trial: Trial, level: Sequence[Trial], imitations: Sequence[Trial]) -> str:
    if trial in imitations:
        return reasons.IMITATES
    return reasons.LOSES_ON_HELD_OUT if trial in level else reasons.EXPLAINS_LESS


def _named_in(entry: Accepted, others: Sequence[Accepted]) -> bool:
    return any(entry.finding.candidate.name == other.finding.candidate.name for other in others)


def finding_of(trial: Trial, look: Look) -> Finding:
    """What a look says of the form of a trial, or the finding of the trial itself if that is none of the look."""
    form = form_of(trial.finding)
    return next((found for found in look.screen.findings if form_of(found) == form), trial.finding)


def needed_twice(accepted: Sequence[Accepted]) -> set[tuple[str, str]]:
    """Names that were accepted again, for more than a form may be wrong by."""
    falls: dict[tuple[str, str], list[float]] = {}
    for entry in accepted:
        falls.setdefault(entry.finding.candidate.name, []).append(entry.trial.gain)
    ordered = {name: sorted(gains, reverse=True) for name, gains in falls.items() if len(gains) > 1}
    return {name for name, (most, second, *_) in ordered.items() if second > BEYOND_FORM * most}
