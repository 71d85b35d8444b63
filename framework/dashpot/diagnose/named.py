"""What was added to the files as it is told: one entry a cause and place, with how sure it is."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from dashpot.contract.cause import Cause
from dashpot.diagnose.channel import Accused
from dashpot.diagnose.evidence import DECADES
from dashpot.diagnose.gain import Gain
from dashpot.diagnose.pursuit import NAMED
from dashpot.diagnose.term import Model, Term
from dashpot.model.network import NetworkSpec, Value
from dashpot.model.sites import Site
from dashpot.model.slopes import RUN, per_run

STANDINGS = ("accepted", "probable", "resembles")


def standing_of(presence: float) -> str:
    """What is said of a cause: ``accepted``, ``probable``, or that the force ``resembles`` it.

    Accepted is what has a probability of NAMED and more: of ten names nine are to be right. Probable is what is more
    likely than not. What resembles a cause describes a part of the force, and its cause is open.
    """
    if presence >= NAMED:
        return "accepted"
    return "probable" if presence > 1.0 - presence else "resembles"


def about_of(model: Model, name: tuple[str, str], network: NetworkSpec) -> str:
    """What a cause of a structure is, with what of its network depends on which settings where that is what it is."""
    mine = [number for number, term in enumerate(model.terms) if term.name == name]
    first = next(term for term in model.causes if term.name == name)
    paths = {path for number in mine for path in model.owned[number]}
    return (first.cause.changes_numbers and dependence(network, paths)) or first.about


def dependence(network: NetworkSpec, paths: Collection[str]) -> str:
    """What depends on which settings by numbers at some paths; nothing where these are of no dependence.

    A branch is called by its name; what the same paths brought along with its dependence, by what it is.
    """
    things: dict[str, list[str]] = {}
    for slot in network.slots():
        over = slot.value.over
        if over and any(f"{slot.path}{ending}" in paths for ending in over.endings):
            branch, _, key = slot.path.rpartition(".")
            thing = key if slot.path in paths else branch.rpartition(".")[2]
            things.setdefault(over.word, []).append(thing.replace("_", " "))
    told = [f"{_and(list(dict.fromkeys(each)))} on {setting.replace('_', ' ')}" for setting, each in things.items()]
    return f"dependence of {_and(told)}" if told else ""


def _and(words: Sequence[str]) -> str:
    *head, tail = words
    return f"{', '.join(head)} and {tail}" if head else tail


@dataclass(frozen=True, eq=False)
class NamedCause:
    """A cause with the parameters that it brought, by path, or with the faults of single runs that it stands for.

    ``probability`` is that of its name, ``presence`` counts draws with a rival in its place as well; both are the same
    for a fault of the measurement.
    ``gain`` is what the final files gain by it, ``removal`` the share by which the error grows where it is taken out
    and the rest refitted, both on runs that took no part; ``nats`` is what it predicts of training runs left out,
    ``rivals`` the words of what may stand in its place, ``about`` what it is.
    """

    cause: type[Cause]
    terms: tuple[Term, ...]
    slots: Mapping[str, Value]
    accused: tuple[Accused, ...]
    probability: float
    presence: float
    nats: float
    groups: tuple[int, int]
    gain: Gain | None
    removal: float | None
    rivals: tuple[str, ...]
    evidence_of: str | None
    proof: str
    about: str

    @property
    def accepted(self) -> bool:
        """Whether it is named."""
        return self.standing == "accepted"

    @property
    def standing(self) -> str:
        """``accepted``, ``probable`` or ``resembles``."""
        return standing_of(self.presence)

    @property
    def site(self) -> Site | None:
        """Where it is in a network with nodes; None at the rig and in a network with two ends."""
        return self.terms[0].site if self.terms else None

    @property
    def title(self) -> str:
        """What it is, and where."""
        return f"{self.about} {self.site.words}" if self.site else self.about

    @property
    def branch(self) -> str | None:
        """The first branch it added; None for a fault of single runs."""
        return next(iter(self.slots)).partition(".")[0] if self.slots else None

    @property
    def evidence(self) -> str:
        """How it shows, and how sure that is."""
        forms = list(
            dict.fromkeys([*(term.suspect.form for term in self.terms), *(one.kind.fault.form for one in self.accused)])
        )
        shown = f"{self.cause.shows}. As {', then '.join(forms)} it has a probability of {self.probability:.2g}"
        better, parts = self.groups
        where = f" and predicts {better} of {parts} parts of the data better, each left out in turn" if parts else ""
        return f"{shown}{where}{f'; {self.proof}' if self.proof else ''}"

    def parameters(self) -> dict[str, Any]:
        """The numbers as they stand in result files: by their own name in the first branch, by path in further ones."""
        found: dict[str, Any] = {}
        for one in self.accused:
            known = bool(np.all(np.isfinite(one.interval)))
            found[f"{one.kind.fault.quantity} of {one.run}"] = {
                "value": one.size,
                "unit": one.kind.fault.unit,
                "interval": list(one.interval) if known else None,
                "determined": is_known(one.interval) if known else None,
            }
        slopes = per_run(self.slots)
        for path, value in self.slots.items():
            branch, _, name = path.partition(".")
            found[name if branch == self.branch else path] = {
                "value": value.number,
                "unit": value.unit,
                "interval": list(value.interval) if value.interval else None,
                "determined": is_known(value.interval) if value.interval else None,
                **({"per": RUN} if path in slopes else {}),
            }
        return found


def is_known(interval: tuple[float, float]) -> bool:
    """Whether a 95 % interval tells sign and size of a number: it holds no zero and spans less than DECADES."""
    least, largest = sorted(map(abs, interval))
    return interval[0] * interval[1] > 0.0 and largest < least * 10.0**DECADES


def slots_of(network: NetworkSpec, paths: Sequence[str]) -> dict[str, Value]:
    """The parameters of a network at some paths, in the order of the text."""
    found = [slot for slot in network.slots() if slot.path in set(paths)]
    return {slot.path: slot.value for slot in sorted(found, key=lambda slot: slot.value.place)}
