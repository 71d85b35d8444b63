"""What becomes of the candidates that were refitted: causes with their proof, and those that did not hold."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace
from itertools import combinations

from dashpot.assess.contest import Model, Trial
from dashpot.assess.gain import Gain
from dashpot.assess.screen import Finding


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


def certain_faults(accepted: Iterable[Accepted]) -> set[str]:
    """The words of the faults of single runs that look like nothing else, or of which two have but one in common."""
    local = [entry for entry in accepted if entry.finding.candidate.suspect.local]
    words = [{entry.finding.candidate.cause.word, *entry.rivals} for entry in local]
    common = (one & other for one, other in combinations(words, 2))
    return {word for found in (*words, *common) if len(found) == 1 for word in found}


def likely_fault(accepted: Iterable[Accepted]) -> set[str]:
    """The word of the fault of single runs that explains most, if all other such faults may be that as well."""
    local = sorted(
        (entry for entry in accepted if entry.finding.candidate.suspect.local), key=lambda one: -one.trial.gain
    )
    words = [{entry.finding.candidate.cause.word, *entry.rivals} for entry in local]
    first = {entry.finding.candidate.cause.word for entry in local[:1]}
    return first if all(first <= found for found in words) else set()


def without_doubt(accepted: Iterable[Accepted], known: Collection[str]) -> list[Accepted]:
    """The causes; faults of single runs whose word is ``known`` for certain have no rivals."""
    return [
        replace(entry, rivals=(), others=())
        if entry.finding.candidate.suspect.local and entry.finding.candidate.cause.word in known
        else entry
        for entry in accepted
    ]


@dataclass(frozen=True)
class Rejection:
    """A candidate that was refitted and did not hold."""

    cause: str
    form: str
    reason: str
    expected_gain: float | None = None
    gain: float | None = None
    place: str | None = None
