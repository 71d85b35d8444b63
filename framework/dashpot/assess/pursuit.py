"""Finding causes one after the other: screen, refit the finalists, accept the best, look again, prune.

A cause is accepted when its refitted model is better by more than its parameters cost and by more than pure noise could
fake, and when it makes runs better that nobody fitted.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from dashpot.assess import reasons
from dashpot.assess.contest import Bench, Model, Trial, admitted, try_finding
from dashpot.assess.finalists import TIE, alike, choose_finalists, form_of, settle_ties, simpler, to_beat
from dashpot.assess.gain import Gain, measure_gain
from dashpot.assess.misfits import crossed_misfits, misfits_of, plainly_strong, pooled, share_of_change
from dashpot.assess.noise import NoiseModel, learn_noise
from dashpot.assess.screen import Finding
from dashpot.assess.suspicion import Look, expected_gain, look_at, resolution
from dashpot.assess.turns import gain_in_turns, runs_that_show
from dashpot.assess.unseen import Jury, known_directions
from dashpot.contract.cause import Cause
from dashpot.fit.refine import Outcome
from dashpot.fit.scored import ScoredRun
from dashpot.model.reading import parse_network

Array = NDArray[np.float64]

MOST_CAUSES = 5
SHARE_OF_FORM = 5e-3  # of what is explained already: forms are never quite right
FORM_ERROR = 0.05
SMALLEST_GAIN = 2.5e-3  # an effect of 0.07 of the noise: forms that are never quite right stay below
SMALLEST_LATER_GAIN = 0.01  # what is left once a cause is found is partly its own form, not a further cause
BEYOND_FORM = 0.03  # of what is explained already: no form is that wrong
REFIT_MAY_DOUBLE = 0.5
HARMLESS = 0.05  # a loss on held-out runs that coloured noise may make
MOST_OTHERS = 2


@dataclass(frozen=True, eq=False)
class Accepted:
    """A cause with its proof: the model after it, the gain on held-out runs, what could not be told from it.

    ``others`` are the trials of its rivals, ``base`` the model before it, ``simpler`` the trials of causes with fewer
    numbers that came near.
    """

    finding: Finding
    trial: Trial
    expected_gain: float
    gain: Gain | None
    rivals: tuple[str, ...]
    others: tuple[Trial, ...] = ()
    base: Model | None = None
    simpler: tuple[Trial, ...] = ()


@dataclass(frozen=True)
class Rejection:
    """A candidate that was refitted and did not hold."""

    cause: str
    form: str
    reason: str
    expected_gain: float | None = None
    gain: float | None = None
    place: str | None = None


@dataclass(frozen=True, eq=False)
class Pursuit:
    """The way from the first look to the last one.

    ``ladder`` holds the first model and the model after each accepted cause, refitted to the plain error in N.
    ``least_force`` is the RMS in N that a cause has to add to the last model to be of interest.
    """

    first: Look
    last: Look
    accepted: tuple[Accepted, ...]
    rejected: tuple[Rejection, ...]
    tried: int
    ladder: tuple[Model, ...]
    least_force: float


@dataclass(eq=False)
class Pursuer:
    """Runs a pursuit; holds what all rounds share.

    ``relevance`` is the share by which a cause has to make the training error smaller to be of interest; ``groups``
    says by run which runs repeat one another.
    """

    bench: Bench
    held_out: Sequence[ScoredRun]
    causes: Sequence[type[Cause]]
    seed: int
    watch: Callable[[str, float], None]
    relevance: float = SMALLEST_GAIN
    groups: Mapping[str, str] = field(default_factory=dict)
    rejected: list[Rejection] = field(default_factory=list)
    pruned: set[tuple[str, str, str]] = field(default_factory=set)
    tried: int = 0

    def run(self, model: Model) -> Pursuit:
        """Accept causes until nothing significant is left."""
        self.watch("first look", 0.0)
        first = look = look_at(self.bench, model, self.causes, None, self.seed)
        accepted, look = self.pursue([], look, first)
        accepted, look, ladder = self.settle_gains(accepted, look, first)
        while opposite := [entry for entry in accepted if not admitted(entry.trial, entry.base, ladder[-1])]:
            self.reject(opposite[-1].finding, reasons.OPPOSITE, None, None)
            self.pruned.add(form_of(opposite[-1].finding))
            kept = [entry for entry in accepted if entry is not opposite[-1]]
            model = self.rebuild(kept, look.model, first.model, look.noise)
            look = look_at(self.bench, model, self.causes, look.noise, self.seed)
            accepted, look, ladder = self.settle_gains(*self.pursue(kept, look, first), first)
        self.judge_the_jury(accepted, look, ladder)
        least_force = float(np.sqrt(1.0 - (1.0 - self.relevance) ** 2) * pooled(look.columns.residual.values()))
        named = {entry.finding.candidate.name for entry in accepted}
        rejected = tuple(one for one in self.rejected if (one.cause, one.place or "") not in named)
        return Pursuit(first, look, tuple(accepted), rejected, self.tried, tuple(ladder), least_force)

    def pursue(self, accepted: list[Accepted], look: Look, first: Look) -> tuple[list[Accepted], Look]:
        """Add causes to those that are accepted, as long as there are any that hold."""
        while len(accepted) < MOST_CAUSES:
            self.tried += len(look.screen.findings)
            winner = self.best_trial(look, sum(entry.trial.gain for entry in accepted))
            if winner is None:
                break
            accepted = [*accepted, winner]
            self.watch(f"accepted {winner.finding.candidate.cause.word}", len(accepted) / MOST_CAUSES)
            look = look_at(self.bench, winner.trial.model, self.causes, look.noise, self.seed)
            accepted, look = self.prune(*self.reconsider(accepted, look, first), first)
            accepted, look = self.exchange(accepted, look, first)
        return accepted, look

    def judge_the_jury(self, accepted: list[Accepted], look: Look, ladder: list[Model]) -> None:
        """Faults of held-out runs join the accepted causes, each with a model that has the fault taken out.

        They have to make these runs better for certain, and by as much as any cause after the first; where there are
        causes already, by more than the forms of these may be wrong.
        """
        if not self.held_out:
            return
        least = FORM_ERROR if accepted else max(self.relevance, SMALLEST_LATER_GAIN)
        directions = known_directions(self.bench, look.model, look.noise)
        jury = Jury(replace(self.bench, runs=self.held_out, unseen=()), directions, self.causes, self.seed)
        for _ in self.held_out:
            found = jury.faulty(replace(look.model, mends=ladder[-1].mends))
            if found is None:
                return
            finding, mend = found
            mend = plainly_strong(mend, ladder[-1], self.held_out)
            model = replace(ladder[-1], mends=(*ladder[-1].mends, mend))
            gain = self.gain_of(ladder[-1], model)
            if gain is None or gain.interval[0] <= 0.0 or gain.value < least:
                return
            trial = Trial(finding, model, finding.gain, finding.merit)
            accepted.append(Accepted(finding, trial, gain.value, gain, ()))
            ladder.append(model)

    def settle_gains(
        self, accepted: list[Accepted], look: Look, first: Look
    ) -> tuple[list[Accepted], Look, list[Model]]:
        """The gain of every cause in plain error; one that gains nothing on held-out runs goes, the last one first.

        The first cause has to hold there, a further one to gain what is of interest at all.
        """
        ladder = self.polish_ladder(first.model, accepted, look)
        gains = [self.gain_of(before, after) for before, after in pairwise(ladder)]
        useless = [number for number, gain in enumerate(gains) if gain is not None and gain.value <= self.relevance]
        if useless == [0] and self.holds(first.model, accepted[0].trial.model, gains[0]):
            useless = []
        if not useless:
            return [replace(entry, gain=gain) for entry, gain in zip(accepted, gains, strict=True)], look, ladder
        entry = accepted[useless[-1]]
        self.reject(entry.finding, reasons.NOT_SUPPORTED, entry.expected_gain, gains[useless[-1]])
        kept = [other for other in accepted if other is not entry]
        model = self.rebuild(kept, look.model, first.model, look.noise)
        return self.settle_gains(kept, look_at(self.bench, model, self.causes, look.noise, self.seed), first)

    def polish_ladder(self, first: Model, accepted: Sequence[Accepted], last: Look) -> list[Model]:
        """The first model and the one after each cause, all fitted to the plain error, so that their gains compare."""
        self.watch("final refits", 0.0)
        models = [self.rebuild(accepted[:count], last.model, first, None) for count in range(1, len(accepted))]
        steps = [first, *models, last.model] if accepted else [first]
        return [self.bench.fit(step.declared, step.fitted, None, step.mends) for step in steps]

    def best_trial(self, look: Look, explained: float) -> Accepted | None:
        """The best finalist that holds on runs that took no part, or None."""
        finalists = choose_finalists([one for one in look.screen.findings if form_of(one) not in self.pruned], look)
        trials = []
        for finding in finalists:
            if explained and not self.worth_a_refit(finding, look, explained):
                reason = reasons.TOO_LITTLE.format(least=self.least_later_gain(look, explained))
                self.reject(finding, reason, expected_gain(look.columns, finding), None)
                continue
            self.watch(f"refit with {' '.join(finding.candidate.name).strip()}", 0.0)
            trials.append(self.try_out(finding, look, to_beat(trials, look)))
        while trials:
            trial, *rest = ranked = sorted(trials, key=lambda trial: -trial.merit)
            if trial.model.outcome is Outcome.LEFT_BEHIND:
                trials = [self.try_out(each.finding, look) for each in ranked]
                continue
            foreseen = expected_gain(look.columns, trial.finding)
            gain = self.gain_of(look.model, trial.model)
            change = share_of_change(look.model, trial.model, self.bench.runs)
            reason = self.objection(trial, gain, change, look, explained)
            if reason:
                self.reject(trial.finding, reason, foreseen, gain)
                trials = rest
                continue
            level = alike(trial, ranked)
            near = [other for other in level if self.holds_as_well(other, trial, gain, look)]
            chosen, others = settle_ties(near)
            for other in (other for other in ranked if other not in near):
                why = reasons.LOSES_ON_HELD_OUT if other in level else reasons.EXPLAINS_LESS
                self.reject(other.finding, why, None, None)
            chosen = self.simplify(chosen, look)
            rivals = tuple(dict.fromkeys(other.finding.candidate.cause.word for other in others))
            gain = self.gain_of(look.model, chosen.model)
            return Accepted(chosen.finding, chosen, foreseen, gain, rivals, others, look.model, simpler(chosen, ranked))
        return None

    def least_later_gain(self, look: Look, explained: float) -> float:
        """The share by which a later cause has to make the error smaller to be worth a name.

        Where much is ``explained`` (fall of chi square) its form may be wrong by as much; where little is, it can not.
        """
        of_form = 1.0 - np.sqrt(max(1.0 - BEYOND_FORM * explained / look.model.chi_square, 0.0))
        return max(self.relevance, min(SMALLEST_LATER_GAIN, float(of_form)))

    def worth_a_refit(self, finding: Finding, look: Look, explained: float) -> bool:
        """Whether a refit may make a later cause worth a name: by its fall of chi square or by that of the error."""
        least = self.least_later_gain(look, explained)
        least_fall = REFIT_MAY_DOUBLE * (1.0 - (1.0 - least) ** 2) * look.model.chi_square
        return finding.gain > least_fall or expected_gain(look.columns, finding) > REFIT_MAY_DOUBLE * least

    def holds_as_well(self, other: Trial, trial: Trial, gain: Gain | None, look: Look) -> bool:
        """Whether a trial that fits like the best one is no worse than this on held-out runs, either.

        Faults of single runs are judged on other pieces than the rest: they do not compare.
        """
        if gain is None or any(one.finding.candidate.suspect.local for one in (other, trial)) or other is trial:
            return True
        own = self.gain_of(look.model, other.model)
        if own and own.value <= self.relevance < gain.value:
            return False
        steps = [run.drive.dt for run in self.held_out]
        pair = (misfits_of(one.model, self.held_out) for one in (trial, other))
        loss = measure_gain(*pair, steps, self.seed)
        return loss is None or loss.interval[1] > -self.relevance

    def try_out(self, finding: Finding, look: Look, beat: float = np.inf) -> Trial:
        """A finding as a refitted model; its refit may stop where it will not come down to a chi square to ``beat``."""
        return try_finding(self.bench, look.model, finding, look.noise, look.screen.samples, beat)

    def simplify(self, trial: Trial, look: Look) -> Trial:
        """The trial with fewer places of the grid, as long as the refit does not miss the last one."""
        atoms = trial.finding.atoms
        if trial.finding.candidate.suspect.joint or len(atoms) < 2:
            return trial
        fewer = trial.finding.without_last()
        simpler = self.try_out(fewer, look)
        return self.simplify(simpler, look) if simpler.merit > trial.merit else trial

    def objection(self, trial: Trial, gain: Gain | None, change: float, look: Look, explained: float) -> str:
        """Why a trial may not be accepted, or an empty text.

        ``change`` is what it makes of the plain error, ``explained`` the fall of chi square so far.
        """
        if trial.failure:
            return trial.failure
        if trial.merit <= look.screen.threshold:
            return "after the refit it explains no more than its own parameters would by chance"
        if not self.holds(look.model, trial.model, gain):
            return reasons.NOT_SUPPORTED
        fall = 1.0 - np.sqrt(trial.model.chi_square / look.model.chi_square)
        if fall < FORM_ERROR and trial.gain < SHARE_OF_FORM * explained:
            return "explains no more than the accepted causes may be wrong by in their form"
        if change < self.relevance:
            return f"makes the training runs better by less than {self.relevance:.2%}: of no practical relevance"
        if explained and max(fall, change) < (least := self.least_later_gain(look, explained)):
            return reasons.TOO_LITTLE.format(least=least)
        return ""

    def reject(self, finding: Finding, reason: str, foreseen: float | None, gain: Gain | None) -> None:
        """Note a candidate that did not hold, with the reason."""
        candidate = finding.candidate
        value, place = gain.value if gain else None, candidate.site.words if candidate.site else None
        self.rejected.append(Rejection(candidate.cause.word, candidate.suspect.form, reason, foreseen, value, place))

    def gain_of(self, before: Model, after: Model) -> Gain | None:
        """The gain on the held-out runs; that of a fault of single runs on pieces of these that did not find it.

        Where these show the cause but weakly, runs that show it take turns in being held out; they may only speak for
        it, as what is left without them may not be enough to find it.
        """
        local = [
            mend for mend in after.mends if mend.local and not any(mend.finding is old.finding for old in before.mends)
        ]
        if local:
            seen = any(run.name in mend.shapes for mend in local for run in self.bench.runs)
            runs = self.bench.runs if seen else self.held_out
            crossed = crossed_misfits(after, runs, local)
            return measure_gain(misfits_of(before, runs), crossed, [run.drive.dt for run in runs], self.seed)
        steps = [run.drive.dt for run in self.held_out]
        gain = measure_gain(misfits_of(before, self.held_out), misfits_of(after, self.held_out), steps, self.seed)
        if gain is None or not -HARMLESS < gain.value <= self.relevance:
            return gain
        shown = runs_that_show(before, after, self.bench)
        turned = gain_in_turns(self.bench, before, after, shown, self.groups, self.seed) if shown else None
        return turned if turned and turned.value > self.relevance else gain

    def holds(self, before: Model, after: Model, gain: Gain | None) -> bool:
        """Whether held-out runs get better; where coloured noise hides it, whether they do once it is made white."""
        if gain is None or gain.value > 0.0:
            return True
        if gain.value < -HARMLESS:
            return False
        first, second = misfits_of(before, self.held_out), misfits_of(after, self.held_out)
        names = [run.name for run in self.held_out]
        noise = learn_noise(dict(zip(names, first, strict=True)), resolution(replace(self.bench, runs=self.held_out)))
        white = [pooled(map(noise.whiten, names, misfits)) for misfits in (first, second)]
        return white[1] < white[0]

    def prune(self, accepted: list[Accepted], look: Look, first: Look) -> tuple[list[Accepted], Look]:
        """Drop an earlier cause that a later one made superfluous, or its opposite; its form does not come back."""
        for number in range(len(accepted) - 1):
            kept = [*accepted[:number], *accepted[number + 1 :]]
            model = self.rebuild(kept, look.model, first.model, look.noise)
            price = (look.model.numbers - model.numbers) * np.log(look.screen.samples)
            superfluous = model.chi_square - look.model.chi_square < price + look.screen.threshold
            if superfluous or not admitted(accepted[number].trial, accepted[number].base, look.model):
                why = reasons.SUPERFLUOUS if superfluous else reasons.OPPOSITE
                self.reject(accepted[number].finding, why, None, None)
                self.pruned.add(form_of(accepted[number].finding))
                return self.prune(kept, look_at(self.bench, model, self.causes, look.noise, self.seed), first)
        return accepted, look

    def reconsider(self, accepted: list[Accepted], look: Look, first: Look) -> tuple[list[Accepted], Look]:
        """Put a simpler cause in the place of an earlier one that owed its lead to what a later one explains."""
        for number, entry in enumerate(accepted[:-1]):
            for trial in entry.simpler:
                instead = replace(entry, finding=trial.finding, trial=trial, rivals=(), others=(), simpler=())
                changed = [*accepted[:number], instead, *accepted[number + 1 :]]
                model = self.rebuild(changed, look.model, first.model, look.noise)
                price = (look.model.numbers - model.numbers) * np.log(look.screen.samples)
                if model.chi_square - look.model.chi_square < price + TIE:
                    self.reject(entry.finding, reasons.SIMPLER_WILL_DO, None, None)
                    return changed, look_at(self.bench, model, self.causes, look.noise, self.seed)
        return accepted, look

    def exchange(self, accepted: list[Accepted], look: Look, first: Look) -> tuple[list[Accepted], Look]:
        """Put another cause in the place of an earlier one that won only because a later one was still missing."""
        for number, entry in enumerate(accepted[:-1]):
            kept = [*accepted[:number], *accepted[number + 1 :]]
            model = self.rebuild(kept, look.model, first.model, look.noise)
            without = look_at(self.bench, model, self.causes, look.noise, self.seed)
            fall = model.chi_square - look.model.chi_square
            for finding in self.others_than(entry, without, fall):
                trial = try_finding(self.bench, model, finding, look.noise, look.screen.samples)
                price = (trial.model.numbers - look.model.numbers) * np.log(look.screen.samples)
                if trial.failure or trial.model.chi_square + price + TIE > look.model.chi_square:
                    continue
                if (gain := self.gain_of(look.model, trial.model)) and gain.value < 0.0:
                    continue
                self.reject(entry.finding, reasons.BETTER_BESIDE_THE_LATER, None, None)
                self.pruned.add(form_of(entry.finding))
                foreseen = expected_gain(without.columns, finding)
                instead = Accepted(finding, trial, foreseen, gain, (), base=model)
                changed = [*accepted[:number], instead, *accepted[number + 1 :]]
                return changed, look_at(self.bench, trial.model, self.causes, look.noise, self.seed)
        return accepted, look

    def others_than(self, entry: Accepted, look: Look, fall: float) -> list[Finding]:
        """The few findings of other causes that promise most of a fall of chi square."""
        name = entry.finding.candidate.name
        found = [one for one in choose_finalists(look.screen.findings, look) if form_of(one) not in self.pruned]
        return [one for one in found if one.candidate.name != name and one.gain > REFIT_MAY_DOUBLE * fall][:MOST_OTHERS]

    def rebuild(self, kept: Sequence[Accepted], model: Model, first: Model, noise: NoiseModel | None) -> Model:
        """The first model with the patches of some causes, refitted from the present numbers."""
        text = first.declared.text
        for entry in kept:
            text = entry.finding.candidate.suspect.extend(text, entry.finding.atoms)
        declared = parse_network(text, self.bench.elements, first.declared.file)
        known = [entry.finding for entry in kept]
        mends = [mend for mend in model.mends if any(mend.finding is finding for finding in known)]
        return self.bench.fit(declared, self.bench.start_from(declared, model.fitted), noise, mends)
