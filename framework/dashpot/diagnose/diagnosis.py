"""A diagnosis as it is told: the causes with their evidence, the verdict, and the result file."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from dashpot.compare.provenance import history_of, provenance_of, warnings_of
from dashpot.compare.shapes import shapes_of
from dashpot.compare.signals import signal_evidence
from dashpot.contract.cause import Cause
from dashpot.diagnose.evidence import told
from dashpot.diagnose.findings import Findings
from dashpot.diagnose.front import FORM_ERROR
from dashpot.diagnose.gain import measure_gain
from dashpot.diagnose.limits import Limit, find_limits
from dashpot.diagnose.named import STANDINGS, NamedCause, about_of, slots_of
from dashpot.diagnose.next_run import measurement_between
from dashpot.fit.result import Errors, floor_of
from dashpot.model.network import NetworkSpec
from dashpot.triage.fault import Fault


@dataclass(frozen=True, eq=False)
class Diagnosis(Findings):
    """What was found, told; ``as_dict`` is the result file, ``evidence`` what the report shows besides."""

    @property
    def named(self) -> tuple[NamedCause, ...]:
        """The accepted causes."""
        return tuple(cause for cause in self.terms if cause.accepted)

    @cached_property
    def terms(self) -> tuple[NamedCause, ...]:
        """All that was added to the files, one entry a word and place: by its standing, then by what it predicts."""
        names = dict.fromkeys(self.pursuit.best.model.names)
        found = [self._named(name) for name in names] + self._faults_of_runs()
        return tuple(sorted(found, key=lambda one: (STANDINGS.index(one.standing), -one.nats)))

    def _named(self, name: tuple[str, str]) -> NamedCause:
        pursuit, best, model = self.pursuit, self.pursuit.best, self.pursuit.best.model
        mine = [number for number, term in enumerate(model.terms) if term.name == name]
        terms = tuple(term for term in model.causes if term.name == name)
        without = pursuit.without_cause(name) or best
        cause, probability = terms[0].cause, self.probability(name)
        evidence_of = cause.evidence_of if cause.kind == "measurement" else None
        gain, removal = self._worth(next((one.network for one in self.removals if one.name == name), None))
        rivals = tuple(dict.fromkeys(word for word, _ in pursuit.replacements(name, self.unexplained)))
        return NamedCause(
            cause,
            terms,
            slots_of(self.written, [path for number in mine for path in model.owned[number]]),
            (),
            probability,
            self.presence(terms[0]),
            without.likelihood(forms_err=False) - best.likelihood(forms_err=False),
            (int(np.sum(without.exact > best.exact)), best.exact.size),
            gain,
            removal,
            rivals,
            evidence_of,
            told(terms[0]) if evidence_of else "",
            about_of(model, name, self.written),
        )

    def _worth(self, without: NetworkSpec | None) -> tuple[Any, float | None]:
        """What the final network gains by a cause over one ``without``, and by how much the error grows there."""
        held_out = self.setting.split.held_out
        if without is None:
            return None, None
        cut = {run.name: run.first for run in self.after_setting.scored.values()}
        before, after = (
            {
                run: values[cut[run] :]
                for run, values in self.residuals(network, self.after_setting).items()
                if run in held_out
            }
            for network in (without, self.written)
        )
        paths = {run: self.setting.scored[run].drive.displacement[cut[run] :] for run in held_out}
        groups = {run.name: run.cluster for run in self.setting.dataset.runs}
        gain = measure_gain(before, after, groups, paths, "held-out runs", self.seed)
        return gain, (1.0 / (1.0 - gain.value) - 1.0 if gain else None)

    def _faults_of_runs(self) -> list[NamedCause]:
        words = dict.fromkeys(one.kind.cause.word for one in self.accused)
        found = []
        for word in words:
            mine = tuple(one for one in self.accused if one.kind.cause.word == word)
            proof, sure = "; ".join(dict.fromkeys(one.words for one in mine)), max(one.probability for one in mine)
            found.append(
                NamedCause(
                    mine[0].kind.cause,
                    (),
                    {},
                    mine,
                    sure,
                    sure,
                    sum(one.nats for one in mine),
                    (0, 0),
                    None,
                    None,
                    (),
                    mine[0].evidence_of,
                    proof,
                    mine[0].kind.cause.about,
                )
            )
        return found

    @cached_property
    def verdict(self) -> str:
        """One of the verdict words of the result file."""
        if self.triage.faults:
            return "bad_data"
        left = self.leftover.notable() and not self._at_floor or self.leftover.line
        open_ends = left or bool(self.apart) or self._far_above_attainable or self._beyond_noise or self.fails_held_out
        if open_ends:
            return "partly_explained" if self.named else "unexplained"
        if any(named.rivals for named in self.named):
            return "ambiguous"
        if self.named:
            return "explained"
        return "ambiguous" if self.terms else "nothing_missing"

    @property
    def _far_above_attainable(self) -> bool:
        return self._unseen > (1.0 + FORM_ERROR) * self._attainable

    # the result

    def as_dict(self) -> dict[str, Any]:
        """The result as in ``diagnosis.json``."""
        dataset = self.setting.dataset
        return {
            "format": "dashpot-diagnosis/1",
            "model": {"name": self.model.name, "digest": digest_of(self.model)},
            "dataset": {"name": dataset.name, "digest": dataset.digest},
            "verdict": self.verdict,
            "noise_floor": floor_of(self.setting.floor),
            "explainable": self.explainable.as_dict(),
            "left_out": self.left_out,
            "rmse": {"before": _pair(self.before), "after": _pair(self.after)},
            "misfit": [{"what": m.what, "share": m.share, "where": dict(m.where)} for m in self.misfit],
            "causes": self._all_causes(),
            "faults": [vars(fault) for fault in self.triage.faults],
            "fitted_model": self.fitted_name,
            "extended_model": self.extended_name,
            "corrected_dataset": self.corrected_name,
            "triaged_dataset": self.triaged_name,
            "held_out": list(self.setting.split.held_out),
            "tried": len(self.pursuit.look.candidates),
            "structures": self._structures(),
            "rejected": self._rejected(),
            "limits": self.limits(),
            "leftover": vars(self.leftover),
            "apart": list(self.apart),
            "may_go": list(self.spare),
            "remarks": self.remarks,
            "seed": self.seed,
        }

    def _all_causes(self) -> list[dict[str, Any]]:
        """Faults found by triage first, then what was searched."""
        groups = [
            (cause, faults)
            for cause in self.causes.values()
            if (faults := [fault for fault in self.triage.faults if fault.kind in cause.faults])
        ]
        found = [_cause_of_faults(rank, cause, faults) for rank, (cause, faults) in enumerate(groups, 1)]
        return found + [self._cause(rank, named) for rank, named in enumerate(self.terms, len(found) + 1)]

    def _cause(self, rank: int, named: NamedCause) -> dict[str, Any]:
        measurements = self._next_for(named)
        return {
            "cause": named.cause.word,
            "class": named.cause.kind,
            "title": named.about,
            "place": named.site.words if named.site else None,
            "rank": rank,
            "accepted": named.accepted,
            "standing": named.standing,
            "branch": named.branch,
            "evidence": named.evidence,
            "evidence_of": named.evidence_of,
            "probability": named.probability,
            "presence": named.presence,
            "expected_gain": None,
            "gain": named.gain.value if named.gain else None,
            "gain_interval": list(named.gain.interval) if named.gain else None,
            "removal": {"held_out": named.removal},
            "parameters": named.parameters(),
            "indistinguishable_from": list(named.rivals),
            "rivals": [{"cause": word, "class": self._kind_of(word)} for word in named.rivals],
            "alternatives": [],
            "next_measurement": measurements[0] if measurements else None,
        }

    def _kind_of(self, word: str) -> str | None:
        """Whether a cause is of the specimen or of the measurement; None for a rival that no plugin provides."""
        return self.causes[word].kind if word in self.causes else None

    def _next_for(self, named: NamedCause) -> list[str]:
        """What to measure next about a cause: a run that was simulated, else what its plugin knows, else its cure."""
        found = []
        for rival in named.rivals:
            advice = measurement_between(named.cause, rival, self.causes)
            run = self.next_runs.get((named.cause.word, rival))
            found.append("; or ".join(text for text in (run.words if run else "", advice) if text))
        return [text for text in found if text] or ([named.cause.cure] if named.cause.cure else [])

    def _structures(self) -> list[dict[str, Any]]:
        """The structures that were compared at the end, by score in nats below the best."""
        pursuit = self.pursuit
        pool = [pursuit.best, *(one.scored for one in pursuit.without), *(rival for _, rival in pursuit.rivals)]
        found = [
            {
                "causes": sorted(word for word, _ in one.model.names),
                "may_go": [given.branch for given in one.model.gone],
                "score": one.score - pursuit.best.score,
            }
            for one in pool
        ]
        return sorted(found, key=lambda one: one["score"])

    def _rejected(self) -> list[dict[str, Any]]:
        """The causes that were refitted in the place of accepted ones."""
        found = []
        for term, rival in self.pursuit.rivals:
            new = [other for other in rival.model.causes if other.name not in self.pursuit.best.model.names]
            share = float(np.mean(rival.drawn(self.pursuit.weights) < self.pursuit.best.drawn(self.pursuit.weights)))
            found += [
                {
                    "cause": other.cause.word,
                    "title": other.title,
                    "place": other.site.words if other.site else None,
                    "reason": f"in place of {term.title} it is better in {share:.0%} of the draws of runs",
                    "expected_gain": None,
                    "gain": None,
                }
                for other in new
            ]
        return found

    def limits(self) -> list[dict[str, Any]]:
        """The detection limits of all causes; nothing where the RMSE of the model, seen or left out, is no noise."""
        if not self._leaves_noise:
            return []
        return [
            _limit(candidate.cause.word, candidate.cause.about, candidate.site.words if candidate.site else None, limit)
            for candidate, limit in find_limits(self.pursuit.look, self.relevance)
        ]

    # the report

    def evidence(self) -> dict[str, Any]:
        """Arrays and texts for the report; see ``report.evidence.Evidence``."""
        residuals = {"before": self.residuals(self.written_before, self.setting)}
        if self.terms:
            residuals["after"] = self.residuals(self.written, self.after_setting)
        triage = [*self.triage.sentences, *self.remarks]
        untried = [f"The cause '{word}' could not be tried: {reason}" for word, reason in self.pursuit.look.unavailable]
        signals = signal_evidence(self.setting.dataset.runs, residuals)
        return {
            **signals,
            "shapes": shapes_of(self.setting.dataset.runs, signals["loops"]["simulated"], self.setting.split.held_out),
            "patch": self.patch(),
            "rejected": self._rejected(),
            "tried": len(self.pursuit.look.candidates),
            "limits": self.limits(),
            "warnings": [*triage, *warnings_of(self.setting, [self.fit]), *untried],
            "history": {self.fit.declared.name: history_of(self.fit)},
            "provenance": provenance_of(self.setting, self.fit.seed),
            "next_measurement": self._next_measurements(),
        }

    def patch(self) -> dict[str, str]:
        """Texts and names of the network before and after; empty without an extended network."""
        if self.extended_text is None or self.extended_name is None:
            return {}
        return {
            "before": self.model.text,
            "after": self.extended_text,
            "before_name": self.fitted_name,
            "after_name": self.extended_name,
        }

    def _next_measurements(self) -> list[str]:
        found = []
        for named in (term for term in self.terms if term.standing != "resembles"):
            words = [
                self.causes[word].about if word in self.causes else word.replace("_", " ") for word in named.rivals
            ]
            about = f"{named.title} or {' or '.join(words)}" if words else named.title
            found += [f"{about}: {text}" for text in self._next_for(named)]
        return found


def _limit(word: str, about: str, place: str | None, limit: Limit | None) -> dict[str, Any]:
    found: dict[str, Any] = {"cause": word, "title": about, "place": place}
    if limit is None:
        return {
            **found,
            "quantity": "would not show beside the parameters of the model",
            "value": None,
            "unit": None,
            "force": None,
            "left": None,
        }
    suspect = limit.candidate.suspect
    return {
        **found,
        "quantity": " as ".join(dict.fromkeys([suspect.quantity, suspect.form])),
        "value": limit.strength if suspect.unit else limit.force,
        "unit": suspect.unit or "N",
        "force": limit.force,
        "left": limit.left,
    }


def _cause_of_faults(rank: int, cause: type[Cause], faults: Sequence[Fault]) -> dict[str, Any]:
    return {
        "cause": cause.word,
        "class": "measurement",
        "title": cause.about,
        "place": None,
        "rank": rank,
        "accepted": True,
        "standing": "accepted",
        "branch": None,
        "evidence": "; ".join(f"run '{fault.run}': {fault.evidence}" for fault in faults),
        "evidence_of": faults[0].evidence_of,
        "probability": 1.0,
        "presence": 1.0,
        "expected_gain": None,
        "gain": None,
        "gain_interval": None,
        "removal": {"held_out": None},
        "parameters": {
            fault.run: {"value": 1.0 / fault.factor, "unit": "1", "interval": None, "determined": None}
            for fault in faults
            if fault.factor is not None
        },
        "indistinguishable_from": [],
        "rivals": [],
        "alternatives": [],
        "next_measurement": faults[0].cure,
    }


def digest_of(spec: NetworkSpec) -> str:
    """sha256 of a network's text."""
    return hashlib.sha256(spec.text.encode()).hexdigest()


def _pair(errors: Errors) -> dict[str, float | None]:
    return {"train": errors.train, "held_out": errors.held_out}
