"""Which findings become finalists, and which of their trials are alike."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from dashpot.assess.contest import Model, Trial
from dashpot.assess.screen import Finding
from dashpot.assess.suspicion import Look

Form = tuple[str, str, str]

FINALISTS = 5
MOST_FORMS = 3  # of one cause
FEWEST_FINALISTS = 3
COMES_NEAR = 0.4  # of the best fall of chi square
TIE = 10.0
TIE_SHARE = 5e-4
NEARLY = 0.95
IMITATED = 0.02  # of a fall of chi square: what the form of a single law may be wrong by
DOUBTFUL = 0.005  # of it: what such a form mostly is wrong by


def form_of(finding: Finding) -> Form:
    """The word of the cause, the words of its site, and its form."""
    return (*finding.candidate.name, finding.candidate.suspect.form)


def choose_finalists(findings: Iterable[Finding], look: Look) -> list[Finding]:
    """The best form of each significant cause, and a few further forms that come near it; best first.

    Beyond the third only those whose fall of chi square comes near that of the best.
    """
    significant = [finding for finding in findings if finding.merit > look.screen.threshold]
    forms: dict[tuple[str, str], list[float]] = {}
    chosen = []
    for finding in significant:
        gains = forms.setdefault(finding.candidate.name, [])
        if not gains or (len(gains) < MOST_FORMS and finding.gain > 0.9 * gains[0]):
            gains.append(finding.gain)
            chosen.append(finding)
    near = [finding for finding in chosen[FEWEST_FINALISTS:] if finding.gain > COMES_NEAR * chosen[0].gain]
    return [*chosen[:FEWEST_FINALISTS], *near][:FINALISTS]


def alike(trial: Trial, ranked: Sequence[Trial]) -> list[Trial]:
    """The trials, best first, that fit the training runs as well as the best of them."""
    return [other for other in ranked if other.merit > trial.merit - tie_width(trial) and not other.failure]


def imitated(trial: Trial, others: Iterable[Trial]) -> list[Trial]:
    """The trials whose law another one makes up, though they come as near with fewer numbers."""
    return [
        other for other in others
        if imitates(trial.finding, other.finding) and not other.failure
        and other.model.numbers < trial.model.numbers and other.gain > (1.0 - IMITATED) * trial.gain
    ]  # fmt: skip


def makes_up(finding: Finding, other: Finding, more: float, explained: float) -> bool:
    """Whether a finding can take another one's place because its many numbers make up the law of that.

    ``more`` is the fall of chi square that it adds to what is ``explained`` with the other one.
    """
    same_site = finding.candidate.site == other.candidate.site
    return imitates(finding, other) and same_site and more < IMITATED * explained


def in_doubt(imitation: Trial, chosen: Trial) -> bool:
    """Whether a law that another one makes up may be more than that: it leads by more than forms mostly err."""
    leads = (1.0 - DOUBTFUL) * imitation.gain > chosen.gain and imitation.merit > chosen.merit + TIE
    return leads and imitates(imitation.finding, chosen.finding)


def settle_ties(near: Sequence[Trial]) -> tuple[Trial, tuple[Trial, ...]]:
    """Among trials that fit alike the one with fewest numbers; the best of every other cause or place is its rival."""
    chosen = min(near, key=lambda other: (other.model.numbers, unusual(other.finding), -other.merit))
    best: dict[tuple[str, str], Trial] = {}
    for other in near:
        if not idles(other, chosen) and not contains(other, chosen):
            best.setdefault(other.finding.candidate.name, other)
    best.pop(chosen.finding.candidate.name)
    return chosen, tuple(best.values())


def unusual(finding: Finding) -> bool:
    """Whether a strength is negative where they are mostly positive, as that of a force that comes too early."""
    return bool(finding.candidate.suspect.usual and np.any(finding.strengths < 0.0))


def simpler(chosen: Trial, ranked: Sequence[Trial]) -> tuple[Trial, ...]:
    """Trials of other causes with fewer numbers that explain nearly as much as the chosen one."""
    return tuple(
        other for other in ranked
        if other.finding.candidate.name != chosen.finding.candidate.name
        and other.model.numbers < chosen.model.numbers and other.gain > NEARLY * chosen.gain
    )  # fmt: skip


def plainer(chosen: Trial, ranked: Sequence[Trial]) -> tuple[Trial, ...]:
    """Trials of other forms of the chosen cause with fewer numbers that explain nearly as much."""
    return tuple(
        other for other in ranked
        if other.finding.candidate.name == chosen.finding.candidate.name
        and other.model.numbers < chosen.model.numbers and other.gain > NEARLY * chosen.gain
    )  # fmt: skip


def to_beat(trials: Sequence[Trial], finding: Finding, look: Look) -> float:
    """The chi square from which on the refit of a finding comes near the best trial so far.

    Of two laws one of which may imitate the other both are refitted as long as they may come near enough for that.
    """
    best = max(trials, key=lambda trial: trial.merit, default=None)
    if best is None or best.failure:
        return np.inf
    related = imitates(finding, best.finding) or imitates(best.finding, finding)
    return look.model.chi_square - best.merit + max(tie_width(best), 2.0 * IMITATED * best.gain * related)


def parts_of(finding: Finding, findings: Iterable[Finding], less: Finding | None = None) -> list[Finding]:
    """The findings at the site of another one of the causes whose laws that makes up, less one of these causes."""
    return [
        other for other in findings
        if imitates(finding, other) and other.candidate.site == finding.candidate.site
        and not (less and other.candidate.name == less.candidate.name)
    ]  # fmt: skip


def imitates(finding: Finding, other: Finding) -> bool:
    """Whether a finding may make up the law of another one."""
    return other.candidate.cause.word in finding.candidate.suspect.imitates


def idles(other: Trial, chosen: Trial) -> bool:
    """Whether a trial at the site of the chosen one has more numbers in vain: it is the same thing, elaborated."""
    site = other.finding.candidate.site
    same = site is not None and site == chosen.finding.candidate.site
    return same and other.model.numbers > chosen.model.numbers and other.merit <= chosen.merit


def contains(other: Trial, chosen: Trial) -> bool:
    """Whether a trial makes up the law of the chosen one with more numbers, and hardly fits better for them."""
    hardly_better = (1.0 - DOUBTFUL) * other.gain <= chosen.gain
    return imitates(other.finding, chosen.finding) and other.model.numbers > chosen.model.numbers and hardly_better


def cost(model: Model, look: Look) -> float:
    """Chi square with the price of the numbers, by which models on the runs of a look compare."""
    return float(model.chi_square + model.numbers * np.log(look.screen.samples))


def tie_width(trial: Trial | Finding) -> float:
    """How near two merits may be without saying which cause it is."""
    return max(TIE, TIE_SHARE * trial.gain)
