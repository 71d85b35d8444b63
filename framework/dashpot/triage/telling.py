"""Faults of runs in sentences, each told once: what many runs have alike stands in one of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from dashpot.text.problem import RUNS_ALIKE
from dashpot.triage.fault import Fault


class Told(NamedTuple):
    """Which runs, what is at fault with them, and the cure."""

    runs: str
    what: str
    cure: str

    @property
    def sentence(self) -> str:
        """For a list of warnings."""
        return f"{self.runs[0].upper()}{self.runs[1:]}: {self.what}. {self.cure}."


def told_once(faults: Sequence[Fault], measured: int) -> Iterator[Told]:
    """The faults of one evidence together, and those of many runs that are cured alike, of which the first is told.

    ``measured``: how many runs there are, so that all of them need no names.
    """
    kinds: dict[tuple[object, ...], list[Fault]] = {}
    for fault in faults:
        kinds.setdefault((fault.kind, fault.channel, fault.factor, fault.cure), []).append(fault)
    for alike in kinds.values():
        same: dict[str, list[Fault]] = {}
        for fault in alike:
            same.setdefault(fault.evidence, []).append(fault)
        if len(same) > 1 and len(alike) >= RUNS_ALIKE:
            first = alike[0]
            told = f"they are at fault alike; of run '{first.run}': {first.evidence}; {first.done}"
            yield Told(named(alike, measured), told, first.cure)
        else:
            for first, *others in same.values():
                yield Told(named([first, *others], measured), f"{first.evidence}; {first.done}", first.cure)


def named(faults: Sequence[Fault], measured: int) -> str:
    """The runs of faults by their names, or how many where they are all that there are."""
    if 1 < len(faults) == measured:
        return f"all {measured} runs"
    names = ", ".join(f"'{fault.run}'" for fault in faults)
    return f"runs {names}" if len(faults) > 1 else f"run {names}"
