"""Judging the refitted candidates: on the runs that were fitted, and on those that nobody fitted."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np

from dashpot.assess import reasons
from dashpot.assess.accepted import Accepted, Rejection
from dashpot.assess.contest import Bench, Model, Trial, admitted, measured_from, try_finding, with_numbers_of
from dashpot.assess.erring import less_sensor_errors
from dashpot.assess.finalists import TIE, Form, choose_finalists, cost, form_of, tie_width
from dashpot.assess.foresight import foreseen_gain
from dashpot.assess.gain import HELD_OUT, Gain, measure_gain
from dashpot.assess.misfits import misfits_of, pooled, share_of_change
from dashpot.assess.noise import NoiseModel, learn_noise
from dashpot.assess.own import at_its_best
from dashpot.assess.screen import Finding
from dashpot.assess.suspicion import Look, expected_gain, glance_at, look_at, resolution
from dashpot.assess.turns import gain_in_turns, gain_on_pieces, runs_that_show
from dashpot.contract.cause import Cause
from dashpot.fit.scored import ScoredRun
from dashpot.model.network import NetworkSpec, Value
from dashpot.model.reading import parse_network

SHARE_OF_FORM = 5e-3  # of what is explained already: forms are never quite right
FORM_ERROR = 0.05
SMALLEST_GAIN = 1.5e-3  # an effect of 0.055 of the noise: forms that are never quite right stay below
SMALLEST_LATER_GAIN = 0.01  # what is left once a cause is found is partly its own form, not a further cause
BEYOND_FORM = 0.03  # of what is explained already: no form is that wrong
ALL_BUT_NOISE = 0.98  # of what all suspects together explain: no form leaves just what a single other law makes
CLEAR = 1e3  # a fall of chi square of hundreds of suspects that noise hardly changes
ALL_OF_IT = 0.8  # of what all suspects together explain: what a form leaves is shared out among many
BEYOND_FORM_ALONE = 0.007
ROOM = 2.0  # times what is of interest
REFIT_MAY_DOUBLE = 0.5
LESS_FAULTS = "held-out runs, their own faults taken out"
LESS_ERRORS = "held-out runs, less all that errors of their sensors could have made"
MOST_LOOKS = 24  # two effects take about eight
REMEMBERED = 2  # looks: one holds all suspects on all runs
FAINT = 0.05  # of chi square
HARMLESS = 0.05  # a loss on held-out runs that coloured noise may make


@dataclass
class Effort:
    """How often all suspects were weighed on all runs, by a look or a glance, and after how often a search ends."""

    most: int = MOST_LOOKS
    looks: int = 0

    @property
    def spent(self) -> bool:
        """Whether no further cause is to be looked for."""
        return self.looks >= self.most


@dataclass(eq=False)
class Court:
    """Refits candidates and judges them; knows what was turned down.

    ``relevance`` is the share by which a cause has to make the training error smaller to be of interest; ``groups``
    says by run which runs repeat one another. Forms that are ``barred`` do not come back, those that were ``exchanged``
    only in exchange for another one, ``imitations`` of a form when that is gone. ``made_up`` are words of causes whose
    law an accepted one can make up: they may be no more than what its form is wrong by.
    """

    bench: Bench
    held_out: Sequence[ScoredRun]
    causes: Sequence[type[Cause]]
    seed: int
    relevance: float = SMALLEST_GAIN
    groups: Mapping[str, str] = field(default_factory=dict)
    rejected: list[Rejection] = field(default_factory=list)
    barred: set[Form] = field(default_factory=set)
    imitations: dict[Form, set[Form]] = field(default_factory=dict)
    exchanged: set[Form] = field(default_factory=set)
    made_up: set[str] = field(default_factory=set)
    latest: list[Look] = field(default_factory=list)
    effort: Effort = field(default_factory=Effort)

    def look(self, model: Model, noise: NoiseModel | None) -> Look:
        """What is left of a model, and every suspect against it. The latest looks are remembered."""
        found = next((look for look in self.latest if look.model is model), None)
        if found is None:
            self.effort.looks += 1
            found = look_at(self.bench, model, self.causes, noise, self.seed)
            self.latest[:] = [*self.latest, found][-REMEMBERED:]
        return found

    def first_look(self, model: Model) -> Look:
        """A look at a model before any cause; where it sees little, at the best that the model can do.

        In plain errors, beside sensors that may err, its fit may have ended elsewhere, and a cause would be named for
        what its own branches can do.
        """
        look = self.look(model, None)
        seen = look.screen.best
        if seen is None or seen.gain > FAINT * look.model.chi_square:
            return look
        best = at_its_best(self.bench, look)
        return self.glance(best, look) if look.model.chi_square - best.chi_square > TIE else look

    def look_after(self, model: Model, look: Look, explained: float) -> Look:
        """What is left of a model that a cause of a look has made; ``explained`` is the fall of chi square to it.

        A glance, where the model leaves no room for a further cause and none is seen.
        """
        if self.leaves_room(model, look):
            return self.look(model, look.noise)
        glance = self.glance(model, look)
        seen = choose_finalists(self.admissible(glance), glance)
        doubtful = any(self.worth_a_refit(finding, glance, explained) for finding in seen)
        return self.look(model, look.noise) if doubtful else glance

    def look_without(self, entry: Accepted, kept: Sequence[Accepted], look: Look, first: Model) -> Look:
        """A look at the model with what is ``kept``, without an accepted cause.

        It is the one in which the cause was found, where that is remembered and saw just what is kept.
        """
        for before in (one for one in self.latest if one.model is entry.base):
            mending = [mend.finding for mend in before.model.mends]
            if _parts(before.model.declared) == _parts(self.extended(kept, first)) and mending == _mending(kept):
                return before
        return self.look(self.rebuild(kept, look.model, first, look.noise), look.noise)

    def glance(self, model: Model, look: Look) -> Look:
        """Every suspect against another model, by the noise and the columns of a look."""
        self.effort.looks += 1
        return glance_at(self.bench, model, look, self.seed)

    def admissible(self, look: Look, exchange: bool = False) -> list[Finding]:
        """What a look has found to be added, or to be put in exchange."""
        out = self.barred if exchange else self.barred | self.exchanged
        return [finding for finding in look.screen.findings if form_of(finding) not in out]

    def bar(self, entry: Accepted, reason: str) -> None:
        """Take back what was accepted, for good."""
        self.reject(entry.finding, reason, None, None)
        self.barred.add(form_of(entry.finding))

    def bar_imitation(self, entry: Accepted, of: Accepted) -> None:
        """Take back what only makes up the law of another one that was accepted."""
        self.bar(entry, reasons.IMITATES)
        self.imitations.setdefault(form_of(of.finding), set()).add(form_of(entry.finding))

    def readmit_imitations(self, entry: Accepted) -> None:
        """What was taken back because it imitates a cause that is gone itself may come again."""
        self.barred -= self.imitations.pop(form_of(entry.finding), set())

    def swap(self, entry: Accepted, reason: str) -> None:
        """Take back what was accepted, in exchange for another cause."""
        self.reject(entry.finding, reason, None, None)
        self.exchanged.add(form_of(entry.finding))

    def try_out(self, finding: Finding, look: Look, beat: float = np.inf) -> Trial:
        """A finding as a refitted model; its refit may stop where it will not come down to a chi square to ``beat``."""
        return try_finding(self.bench, look.model, finding, look.noise, look.screen.samples, beat)

    def put_back(self, look: Look, numbers: Mapping[str, Value]) -> Look:
        """Every suspect against the model of a look with some numbers as they stand in its file."""
        return self.glance(self.bench.put_back(look.model, numbers, look.noise), look)

    def try_out_from(self, finding: Finding, back: Look, look: Look, beat: float) -> Trial:
        """A finding of a look with other numbers as a refitted model, measured by the model of ``look``."""
        return measured_from(look.model, self.try_out(finding, back, beat))

    def brought_back(self, trial: Trial, look: Look) -> Trial:
        """A trial of a look, or a better one: numbers that its cause had driven far away from the file start there."""
        if trial.failure or not self.leaves_room(trial.model, look):
            return trial
        model = self.bench.revive(trial.model, trial.model.astray, look.noise)
        fall = trial.model.chi_square - model.chi_square
        better = fall > tie_width(trial) and admitted(trial, look.model, model)
        return replace(trial, model=model, gain=trial.gain + fall, merit=trial.merit + fall) if better else trial

    def rebuild(self, kept: Sequence[Accepted], model: Model, first: Model, noise: NoiseModel | None) -> Model:
        """The first model with the patches of some causes, refitted from the present numbers, or from earlier ones.

        Present numbers that wandered with a cause that is gone may be worse than those of the first model or those with
        which a cause was accepted.
        """
        declared = self.extended(kept, first)
        known = [entry.finding for entry in kept]
        mends = [mend for mend in model.mends if any(mend.finding is finding for finding in known)]
        earlier = [first.fitted, *(entry.trial.model.fitted for entry in kept)]
        starts = [self.bench.start_from(declared, numbers) for numbers in (model.fitted, *earlier)]
        return self.bench.fit(declared, starts[self.bench.nearest(starts, noise, mends)], noise, mends)

    def reduced(self, accepted: Sequence[Accepted], less: Accepted, look: Look, first: Model) -> Model:
        """The model of a look, the first one with the patches of what is ``accepted``, without one of these.

        Its numbers are as they are, whatever the names of their branches without that cause.
        """
        kept = [entry for entry in accepted if entry is not less]
        findings = [entry.finding for entry in kept]
        mends = [mend for mend in look.model.mends if any(mend.finding is finding for finding in findings)]
        declared = self.extended(kept, first)
        start = self.bench.start_from(declared, look.model.fitted)
        now = {id(entry): names for entry, names in zip(accepted, self.branches(accepted, first), strict=True)}
        before = {new: old for entry, names in zip(kept, self.branches(kept, first), strict=True)
                  for new, old in zip(names, now[id(entry)], strict=True)}  # fmt: skip
        start = with_numbers_of(start, look.model.fitted, before)
        return self.bench.as_it_stands(declared, start, look.noise, mends)

    def branches(self, accepted: Sequence[Accepted], first: Model) -> list[list[str]]:
        """The names of the branches that each cause adds to the first model, one after the other."""
        names = [{leaf.name: None for leaf in self.extended(accepted[:count], first).leaves()}
                 for count in range(len(accepted) + 1)]  # fmt: skip
        return [[name for name in after if name not in before] for before, after in pairwise(names)]

    def agreed(
        self, accepted: Sequence[Accepted], known: Collection[str], look: Look
    ) -> tuple[list[Accepted], Look] | None:
        """The causes with a fault alike two under the word that is ``known`` of other faults, and a look at that.

        It is still alike in the runs that the fault has kept.
        """
        for number, entry in enumerate(accepted):
            faults = [other for other in entry.others if other.finding.candidate.suspect.local]
            same = [other for other in faults if other.finding.candidate.cause.word in known]
            now = [mend for mend in look.model.mends if mend.finding is entry.finding and mend.local]
            if same and now and entry.finding.candidate.cause.word not in known:
                own = same[0].model.mends[-1].within(now[0].shapes)
                mends = [own if mend is now[0] else mend for mend in look.model.mends]
                model = self.bench.fit(look.model.declared, look.model.fitted, look.noise, mends)
                if cost(model, look) <= cost(look.model, look) + tie_width(entry.trial):
                    instead = replace(entry, finding=own.finding, trial=same[0], rivals=(), others=())
                    return [*accepted[:number], instead, *accepted[number + 1 :]], self.look(model, look.noise)
        return None

    def extended(self, kept: Sequence[Accepted], first: Model) -> NetworkSpec:
        """The first model's network with the patches of some causes, as a file declares it."""
        text = first.declared.text
        for entry in kept:
            text = entry.finding.candidate.suspect.extend(text, entry.finding.atoms)
        return parse_network(text, self.bench.elements, first.declared.file)

    def examine(self, trial: Trial, look: Look, explained: float) -> tuple[Gain | None, str]:
        """The gain of a trial on held-out runs, and why it may not be accepted, or an empty text."""
        gain = self.gain_of(look.model, trial.model)
        change = self.share_of_change(look.model, trial.model)
        return gain, self.objection(trial, gain, change, look, explained)

    def leaves_room(self, model: Model, look: Look) -> bool:
        """Whether all suspects of a look together could make the error of a model smaller by twice what is of interest.

        Together they explain more than any one of them. The floor of the look holds to first order: where it lies above
        the model by what is of interest, nothing is known.
        """
        low, high = (1.0 - ROOM * self.relevance) ** 2, (1.0 + self.relevance) ** 2
        return not low * model.chi_square <= look.floor <= high * model.chi_square

    def share_of_change(self, before: Model, after: Model) -> float:
        """What the change from one model to another makes of the plain error on the training runs."""
        return share_of_change(before, after, self.bench.runs, self.bench.sensors)

    def objection(self, trial: Trial, gain: Gain | None, change: float, look: Look, explained: float) -> str:
        """Why a trial may not be accepted, or an empty text.

        ``change`` is what it makes of the plain error, ``explained`` the fall of chi square so far. A first cause may
        show more in the held-out runs than in those that were fitted, and a further one that makes these better by more
        than forms err is none of their errors.
        """
        if trial.failure:
            return trial.failure
        if trial.merit <= look.screen.threshold:
            return "after the refit it explains no more than its own parameters would by chance"
        fall = 1.0 - np.sqrt(trial.model.chi_square / look.model.chi_square)
        least_unseen = gain.interval[0] if gain is not None and gain.runs == HELD_OUT else -np.inf
        beyond = least_unseen > FORM_ERROR
        form = not beyond and within_form(trial.gain, look.model.chi_square, explained)
        if form and trial.gain < ALL_BUT_NOISE * max(look.screen.together, CLEAR):
            return reasons.WITHIN_FORM
        if trial.gain < BEYOND_FORM * explained and trial.finding.candidate.cause.word in self.made_up:
            return reasons.WITHIN_FORM
        if change < self.relevance and (explained or least_unseen <= self.relevance):
            return f"makes the training runs better by less than {self.relevance:.2%}: of no practical relevance"
        doubtful = explained and not beyond
        if doubtful and max(fall, change) < (least := self.least_later_gain(trial, look, explained)):
            return reasons.TOO_LITTLE.format(least=least)
        if not self.holds(look.model, trial.model, gain):
            return reasons.NOT_SUPPORTED
        weak = bool(explained) and max(fall, change) < SMALLEST_LATER_GAIN
        return reasons.FURTHER_NOT_SUPPORTED if weak and gain and gain.value <= 0.0 else ""

    def least_later_gain(self, found: Finding | Trial, look: Look, explained: float) -> float:
        """The share by which a later cause has to make the error smaller to be worth a name.

        Where much is ``explained`` (fall of chi square) its form may be wrong by as much; where little is, it can not,
        nor where one suspect explains nearly all that is left, as it is ``found`` by the look or by its refit.
        """
        alone = found.gain > ALL_OF_IT * look.screen.together
        beyond = (BEYOND_FORM_ALONE if alone else BEYOND_FORM) * explained / look.model.chi_square
        return max(self.relevance, min(SMALLEST_LATER_GAIN, float(1.0 - np.sqrt(max(1.0 - beyond, 0.0)))))

    def worth_a_refit(self, finding: Finding, look: Look, explained: float) -> bool:
        """Whether a refit may make a later cause worth a name: by its fall of chi square or by that of the error."""
        least = self.least_later_gain(finding, look, explained)
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
        first, second = (misfits_of(one.model, self.held_out) for one in (trial, other))
        loss = measure_gain(first, second, steps, self.seed)
        return loss is None or loss.interval[1] > -self.relevance

    def gain_of(self, before: Model, after: Model) -> Gain | None:
        """The gain on the held-out runs; that of a fault of single runs on pieces of these that did not find it.

        Where held-out runs show the cause but weakly, runs that show it take turns in being held out, then, if it is a
        fault, pieces of them; they may only speak for it, as what is left without them may not be enough to find it.
        """
        new = [mend for mend in after.mends if not any(mend.finding is old.finding for old in before.mends)]
        if local := [mend for mend in new if mend.local]:
            seen = any(run.name in mend.shapes for mend in local for run in self.bench.runs)
            return gain_on_pieces(before, after, self.bench.runs if seen else self.held_out, local, self.seed)
        gain = self.gain_on_held_out(before, after)
        if gain is None or not -HARMLESS < gain.value <= self.relevance:
            return gain
        shown = runs_that_show(before, after, self.bench)
        other = gain_in_turns(self.bench, before, after, shown, self.groups, self.seed) if shown else None
        if shown and new and not (other and other.value > self.relevance):
            other = gain_on_pieces(before, after, [run for run in self.bench.runs if run.name in shown], new, self.seed)
        return other if other and other.value > self.relevance else gain

    def gain_on_held_out(self, before: Model, after: Model) -> Gain | None:
        """The gain on the held-out runs; where errors of their sensors may hide it, in the rest."""
        steps = [run.drive.dt for run in self.held_out]
        first, second = (misfits_of(model, self.held_out) for model in (before, after))
        gain = measure_gain(first, second, steps, self.seed)
        known = any(self.bench.sensors.get(run.name) for run in self.held_out)
        if gain is None or gain.value > self.relevance or not known:
            return gain
        first, second = (less_sensor_errors(misfits, self.held_out, self.bench.sensors) for misfits in (first, second))
        other = measure_gain(first, second, steps, self.seed)
        return replace(other, runs=LESS_ERRORS) if other and other.value > gain.value else gain

    def gain_beside(self, faults: Sequence[Accepted], before: Model, after: Model) -> Gain | None:
        """The gain on the held-out runs; where their own ``faults`` hide it, the gain once these are taken out."""
        gain = self.gain_of(before, after)
        if gain is None or gain.value > self.relevance or not faults:
            return gain
        mends = faults[-1].trial.model.mends[-len(faults) :]
        other = self.gain_of(*(replace(model, mends=(*model.mends, *mends)) for model in (before, after)))
        return replace(other, runs=LESS_FAULTS) if other and other.value > self.relevance else gain

    def holds(self, before: Model, after: Model, gain: Gain | None) -> bool:
        """Whether held-out runs get better; where coloured noise hides it, whether they do once it is made white."""
        if gain is None or gain.value > 0.0:
            return True
        if gain.value < -HARMLESS or not self.held_out:
            return False
        first, second = misfits_of(before, self.held_out), misfits_of(after, self.held_out)
        names = [run.name for run in self.held_out]
        noise = learn_noise(dict(zip(names, first, strict=True)), resolution(replace(self.bench, runs=self.held_out)))
        white = [pooled(map(noise.whiten, names, misfits)) for misfits in (first, second)]
        return white[1] < white[0]

    def foresee(self, finding: Finding, look: Look) -> float:
        """The gain on held-out runs that a finding promises; where these hardly show it, that on training runs."""
        gain = foreseen_gain(self.bench, self.held_out, finding, look)
        return gain if gain > self.relevance else expected_gain(look.columns, finding)

    def reject(self, finding: Finding, reason: str, foreseen: float | None, gain: Gain | None) -> None:
        """Note a candidate that did not hold, with the reason."""
        candidate = finding.candidate
        value, place = gain.value if gain else None, candidate.site.words if candidate.site else None
        self.rejected.append(Rejection(candidate.cause.word, candidate.suspect.form, reason, foreseen, value, place))


def _parts(network: NetworkSpec) -> list[tuple[str, ...]]:
    leaves = [(leaf.name, leaf.element.word) for leaf in network.leaves()]
    return [*leaves, *((slot.path,) for slot in network.slots())]


def _mending(kept: Sequence[Accepted]) -> list[Finding]:
    return [entry.finding for entry in kept if entry.finding.candidate.suspect.mends]


def within_form(gain: float, before: float, explained: float) -> bool:
    """Whether a fall of chi square ``before`` is no more than what is ``explained`` may be wrong by in its form."""
    return 1.0 - np.sqrt(1.0 - gain / before) < FORM_ERROR and gain < SHARE_OF_FORM * explained
