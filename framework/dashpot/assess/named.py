"""The accepted causes as they are told: one entry a cause, with everything it added to the network."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import prod
from typing import Any

from dashpot.assess.accepted import Accepted
from dashpot.assess.gain import HELD_OUT, Gain
from dashpot.assess.mend import Mend
from dashpot.assess.pursuit import Pursuit
from dashpot.assess.screen import Candidate
from dashpot.contract.cause import Cause
from dashpot.model.network import NetworkSpec, Value
from dashpot.model.sites import Site


@dataclass(frozen=True, eq=False)
class NamedCause:
    """A cause, the steps in which it was accepted, their gains together, and the numbers it brought, by path."""

    cause: type[Cause]
    steps: tuple[Accepted, ...]
    gain: Gain | None
    slots: Mapping[str, Value]
    mends: tuple[Mend, ...] = ()

    @property
    def rivals(self) -> tuple[str, ...]:
        """Words of the causes that fit alike."""
        return tuple(dict.fromkeys(rival for step in self.steps for rival in step.rivals))

    @property
    def site(self) -> Site | None:
        """Where it is in a network with nodes; None at the rig and in a network with two ends."""
        return self.steps[0].finding.candidate.site

    @property
    def name(self) -> tuple[str, str]:
        """The word of the cause, and the words of the site."""
        return self.steps[0].finding.candidate.name

    @property
    def title(self) -> str:
        """What it is, and where."""
        return self.steps[0].finding.candidate.title

    @property
    def alternatives(self) -> tuple[Candidate, ...]:
        """What fits alike inside a network with nodes, each cause and place once."""
        others = [other.finding.candidate for step in self.steps for other in step.others]
        return tuple({other.name: other for other in others if other.site}.values())

    @property
    def branch(self) -> str | None:
        """The first branch it added; None for a cause in the measurement."""
        return next(iter(self.slots)).partition(".")[0] if self.slots else None

    @property
    def expected_gain(self) -> float:
        """What was foreseen of the gain, each step before its refit."""
        return 1.0 - prod(1.0 - step.expected_gain for step in self.steps)

    @property
    def evidence(self) -> str:
        """How it shows, and by how much the fit is better with it."""
        forms = ", then ".join(step.finding.candidate.suspect.form for step in self.steps)
        fall = sum(step.trial.gain for step in self.steps)
        price = fall - sum(step.trial.merit for step in self.steps)
        judged = f"; its gain is that on {self.gain.runs}" if self.gain and self.gain.runs != HELD_OUT else ""
        return f"{self.cause.shows}. As {forms} it lowers chi square by {fall:.4g} at a price of {price:.3g}{judged}"

    def parameters(self) -> dict[str, Any]:
        """The numbers as they stand in result files: by their own name in the first branch, by path in further ones."""
        found: dict[str, Any] = {}
        for mend in self.mends:
            for name, (number, unit, interval) in mend.told().items():
                # a fault of all runs is told by the fitted ones, which come first
                found.setdefault(name, {"value": number, "unit": unit, "interval": list(interval)})
        for path, value in self.slots.items():
            branch, _, name = path.partition(".")
            found[name if branch == self.branch else path] = {
                "value": value.number,
                "unit": value.unit,
                "interval": list(value.interval) if value.interval else None,
            }
        return found


def name_causes(pursuit: Pursuit, final: NetworkSpec) -> list[NamedCause]:
    """One entry for each accepted word and place, in the order of first acceptance."""
    steps = list(zip(pursuit.accepted, pursuit.ladder, pursuit.ladder[1:], strict=False))
    names = dict.fromkeys(entry.finding.candidate.name for entry in pursuit.accepted)
    found = []
    for name in names:
        mine = [step for step in steps if step[0].finding.candidate.name == name]
        slots: dict[str, Value] = {}
        for _, before, after in mine:
            slots |= _added(before.declared, after.declared, final)
        entries = tuple(entry for entry, *_ in mine)
        findings = [entry.finding for entry in entries]
        mends = tuple(mend for mend in pursuit.ladder[-1].mends if any(mend.finding is known for known in findings))
        found.append(NamedCause(entries[0].finding.candidate.cause, entries, _together(entries), slots, mends))
    return found


def _added(before: NetworkSpec, after: NetworkSpec, final: NetworkSpec) -> dict[str, Value]:
    known = {slot.path for slot in before.slots()} | {f"{name}.offset" for name in after.ends}
    new = {slot.path for slot in after.slots()} - known
    found = [slot for slot in final.slots() if slot.path in new]
    # in the order of the text, where a cause puts what matters first
    return {slot.path: slot.value for slot in sorted(found, key=lambda slot: slot.value.place)}


def _together(entries: Sequence[Accepted]) -> Gain | None:
    gains = [entry.gain for entry in entries if entry.gain is not None]
    if len(gains) < len(entries):
        return None
    left = prod(1.0 - gain.value for gain in gains)
    low, high = (prod(1.0 - gain.interval[side] for gain in gains) for side in (0, 1))
    runs = dict.fromkeys(gain.runs for gain in gains)
    return Gain(1.0 - left, (1.0 - low, 1.0 - high), " and ".join(runs))
