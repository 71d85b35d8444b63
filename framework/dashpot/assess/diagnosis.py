"""What a diagnosis found, and how it is written down."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import dashpot
from dashpot.assess.evidence import detection_limits, gather_evidence, telling_measurement
from dashpot.assess.gain import Gain
from dashpot.assess.leftover import Leftover
from dashpot.assess.misfit import Misfit
from dashpot.assess.named import NamedCause, name_causes
from dashpot.assess.pursuit import Pursuit
from dashpot.assess.telling import Telling
from dashpot.assess.triage.examine import Triage
from dashpot.assess.triage.fault import Fault
from dashpot.assess.verdict import stands_in
from dashpot.contract.cause import Cause
from dashpot.fit.api import Setting
from dashpot.fit.result import Errors, FitResult, floor_of
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import fill_numbers, rename
from dashpot.text.quantity import pretty


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """Everything that was found; ``as_dict`` is the result file, ``evidence`` what the report shows besides."""

    setting: Setting
    triage: Triage
    fit: FitResult
    pursuit: Pursuit
    final: NetworkSpec
    before: Errors
    after: Errors
    misfit: tuple[Misfit, ...]
    leftover: Leftover
    next_runs: Mapping[tuple[str, str], Telling]
    verdict: str
    causes: Mapping[str, type[Cause]]
    seed: int

    @property
    def model(self) -> NetworkSpec:
        """The network that was diagnosed."""
        return self.fit.declared

    @cached_property
    def named(self) -> tuple[NamedCause, ...]:
        """The accepted causes, one entry a word."""
        return tuple(name_causes(self.pursuit, self.final))

    @property
    def extended_name(self) -> str | None:
        """File name of the extended network, None without an accepted cause."""
        words = [named.cause.word for named in self.named]
        return f"{self.model.name}+{'+'.join(words)}.yaml" if words else None

    @cached_property
    def extended_text(self) -> str | None:
        """The extended network with its numbers, comments of the original intact."""
        if self.extended_name is None:
            return None
        declared = self.pursuit.ladder[-1].declared
        record = {
            "data": self.setting.dataset.digest[:16],
            "seed": str(self.seed),
            "version": dashpot.__version__,
            "rmse": pretty(self.after.train, "N", 4),
            "predecessor": self.model.name,
        }
        head = [f"{self.model.name}, extended by a diagnosis."]
        head += [f"cause: {named.title}; {_gain_words(named.gain)}" for named in self.named]
        head.append(f"predecessor: {self.model.name}")
        return rename(fill_numbers(declared, self.final, record), self.extended_name.removesuffix(".yaml"), head)

    def as_dict(self) -> dict[str, Any]:
        """The result as in ``diagnosis.json``."""
        dataset = self.setting.dataset
        return {
            "format": "dashpot-diagnosis/1",
            "model": {"name": self.model.name, "digest": digest_of(self.model)},
            "dataset": {"name": dataset.name, "digest": dataset.digest},
            "verdict": self.verdict,
            "noise_floor": floor_of(self.setting.floor),
            "rmse": {"before": _pair(self.before), "after": _pair(self.after)},
            "misfit": [{"what": m.what, "share": m.share, "where": dict(m.where)} for m in self.misfit],
            "causes": self._all_causes(),
            "faults": [vars(fault) for fault in self.triage.faults],
            "extended_model": self.extended_name,
            "held_out": list(self.setting.split.held_out),
            "tried": self.pursuit.tried,
            "rejected": [vars(rejection) for rejection in self.pursuit.rejected],
            "limits": detection_limits(self.pursuit),
            "leftover": vars(self.leftover),
            "seed": self.seed,
        }

    def evidence(self) -> dict[str, Any]:
        """Arrays and texts for the report."""
        triage = [*(fault.sentence for fault in self.triage.faults), *self.triage.remarks]
        return {
            **gather_evidence(self.setting, self.fit, self.pursuit, self.causes, self.patch(), triage),
            "next_measurement": self._next_measurements(),
        }

    def patch(self) -> dict[str, str]:
        """Texts and names of the network before and after; empty without an accepted cause."""
        if self.extended_text is None or self.extended_name is None:
            return {}
        before, after = f"{self.model.name}.yaml", self.extended_name
        return {
            "before": self.model.text,
            "after": self.extended_text,
            "before_name": before,
            "after_name": after,
        }

    def _telling(self, named: NamedCause) -> list[str]:
        """What to measure next about a cause: a run that was simulated, else what its plugin knows, else its cure."""
        word = named.cause.word
        if (word, "") in self.next_runs:
            return [f"to be sure of it, {self.next_runs[word, ''].words}"]
        found = []
        for rival in named.rivals:
            known = telling_measurement(named.cause, rival, self.causes)
            run = self.next_runs.get((word, rival))
            found.append("; or ".join(text for text in (run.words if run else "", known) if text))
        return [text for text in found if text] or ([named.cause.cure] if named.cause.cure else [])

    def _about(self, word: str) -> str:
        return self.causes[word].about if word in self.causes else word.replace("_", " ")

    def _next_measurements(self) -> list[str]:
        """The same for the report, each with the names it is about."""
        found = []
        for named in self.named:
            others = [other.title for other in named.alternatives]
            rivals = " or ".join(others or [self._about(word) for word in named.rivals])
            about = f"{named.title} or {rivals}" if rivals else named.title
            found += [f"{about}: {text}" for text in self._telling(named)]
        return found

    def _all_causes(self) -> list[dict[str, Any]]:
        """Faults of the measurement first, then what was pursued."""
        groups = [
            (cause, faults)
            for cause in self.causes.values()
            if (faults := [fault for fault in self.triage.faults if fault.kind in cause.faults])
        ]
        found = [_cause_of_faults(rank, cause, faults) for rank, (cause, faults) in enumerate(groups, 1)]
        return found + [self._cause(rank, named) for rank, named in enumerate(self.named, len(found) + 1)]

    def _cause(self, rank: int, named: NamedCause) -> dict[str, Any]:
        telling = self._telling(named)
        return {
            "cause": named.cause.word,
            "class": named.cause.kind,
            "title": named.cause.about,
            "place": named.site.words if named.site else None,
            "rank": rank,
            "accepted": True,
            "branch": named.branch,
            "evidence": named.evidence,
            "expected_gain": named.expected_gain,
            "gain": named.gain.value if named.gain else None,
            "gain_interval": list(named.gain.interval) if named.gain else None,
            "parameters": named.parameters(),
            "indistinguishable_from": list(named.rivals),
            "alternatives": [other.told() for other in named.alternatives],
            "stands_in": named.name in stands_in(self.pursuit.accepted),
            "next_measurement": telling[0] if telling else None,
        }


def _cause_of_faults(rank: int, cause: type[Cause], faults: Sequence[Fault]) -> dict[str, Any]:
    return {
        "cause": cause.word,
        "class": "measurement",
        "title": cause.about,
        "place": None,
        "rank": rank,
        "accepted": True,
        "branch": None,
        "evidence": "; ".join(f"run '{fault.run}': {fault.evidence}" for fault in faults),
        "expected_gain": None,
        "gain": None,
        "gain_interval": None,
        "parameters": {fault.run: {"value": 1.0 / fault.factor, "unit": "1", "interval": None}
                       for fault in faults if fault.factor is not None},
        "indistinguishable_from": [],
        "alternatives": [],
        "next_measurement": faults[0].cure,
    }  # fmt: skip


def digest_of(spec: NetworkSpec) -> str:
    """sha256 of a network's text."""
    return hashlib.sha256(spec.text.encode()).hexdigest()


def _pair(errors: Errors) -> dict[str, float | None]:
    return {"train": errors.train, "held_out": errors.held_out}


def _gain_words(gain: Gain | None) -> str:
    if gain is None:
        return "gain not measured, no run that shows it could be held out"
    low, high = gain.interval
    return f"gain on {gain.runs} {gain.value:.1%} [{low:.1%}, {high:.1%}]"
