"""The diagnosis of a network on a dataset: what is wrong, why, the extended network, the gain."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import dashpot
from dashpot.assess.contest import Bench, Model
from dashpot.assess.evidence import gather_evidence
from dashpot.assess.gain import Gain
from dashpot.assess.leftover import Leftover, look_for_leftover
from dashpot.assess.misfit import Misfit, describe_misfit
from dashpot.assess.named import NamedCause, name_causes
from dashpot.assess.pursuit import Pursuer, Pursuit, residuals_of
from dashpot.assess.suspicion import linear_view
from dashpot.assess.verdict import give_verdict
from dashpot.contract.registry import Registry
from dashpot.data.dataset import Dataset
from dashpot.fit.algebra import single_threaded_algebra
from dashpot.fit.api import Progress, Setting, fit_prepared, measure_errors, prepare, silent
from dashpot.fit.coordinates import search_coordinates
from dashpot.fit.objective import Objective
from dashpot.fit.refine import Outcome
from dashpot.fit.result import Errors, FitResult, floor_of, with_intervals
from dashpot.fit.uncertainty import assess_uncertainty
from dashpot.kernel.network import compile_network
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import fill_numbers, rename
from dashpot.text.quantity import pretty


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """Everything that was found; ``as_dict`` is the result file, ``evidence`` what the report shows besides."""

    setting: Setting
    fit: FitResult
    pursuit: Pursuit
    final: NetworkSpec
    before: Errors
    after: Errors
    misfit: tuple[Misfit, ...]
    leftover: Leftover
    verdict: str
    causes: Mapping[str, Any]
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
        head += [f"cause: {named.cause.about}; {_gain_words(named.gain)}" for named in self.named]
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
            "causes": [self._cause(rank, named) for rank, named in enumerate(self.named, 1)],
            "extended_model": self.extended_name,
            "held_out": list(self.setting.split.held_out),
            "tried": self.pursuit.tried,
            "rejected": [vars(rejection) for rejection in self.pursuit.rejected],
            "leftover": {"score": self.leftover.score, "size": self.leftover.size},
            "seed": self.seed,
        }

    def evidence(self) -> dict[str, Any]:
        """Arrays and texts for the report."""
        return gather_evidence(self)

    def _cause(self, rank: int, named: NamedCause) -> dict[str, Any]:
        telling = [text for rival in named.rivals if (text := self.measurement_between(named.cause.word, rival))]
        return {
            "cause": named.cause.word,
            "class": named.cause.kind,
            "title": named.cause.about,
            "rank": rank,
            "accepted": True,
            "branch": named.branch,
            "evidence": named.evidence,
            "expected_gain": named.steps[0].expected_gain,
            "gain": named.gain.value if named.gain else None,
            "gain_interval": list(named.gain.interval) if named.gain else None,
            "parameters": named.parameters(),
            "indistinguishable_from": list(named.rivals),
            "next_measurement": telling[0] if telling else None,
        }

    def measurement_between(self, word: str, rival: str) -> str:
        """The measurement that tells two causes apart, or an empty text when neither of them says."""
        return self.causes[word].confused_with.get(rival) or self.causes[rival].confused_with.get(word, "")


@single_threaded_algebra
def diagnose(
    spec: NetworkSpec,
    dataset: Dataset,
    *,
    optimizer: str | None = None,
    options: Mapping[str, Any] | None = None,
    seed: int = 0,
    jobs: int = 1,
    registry: Registry,
    progress: Progress | None = None,
) -> Diagnosis:
    """Fit, look at what is left, pursue its causes, and say how sure that is.

    Raises InputError for a network that does not compile on these data.
    """
    progress = progress or silent
    setting = prepare(dataset, seed)
    method = registry.optimizers[optimizer](**(options or {})) if optimizer else None
    fit = fit_prepared(spec, setting, method, seed, jobs, progress)
    causes = {word: registry.causes[word] for word in sorted(registry.causes)}
    bench = Bench(setting.train, registry.elements, force_sensors(dataset), jobs)
    pursuer = Pursuer(bench, setting.held_out, list(causes.values()), seed, _watch(progress, spec.name))
    pursuit = pursuer.run(model_of(fit))
    final = known_to(bench, pursuit)
    first = pursuit.ladder[0]
    misfit = describe_misfit(dataset.runs, residuals_of(first, setting.scored))
    runs = [run for run in dataset.runs if run.name in setting.split.train]
    last = pursuit.last
    leftover = look_for_leftover(*linear_view(bench, last.model), last.noise, runs)
    return Diagnosis(
        setting=setting,
        fit=fit,
        pursuit=pursuit,
        final=final,
        before=measure_errors(first.fitted, setting, jobs),
        after=measure_errors(final, setting, jobs),
        misfit=tuple(misfit),
        leftover=leftover,
        verdict=give_verdict(pursuit, leftover),
        causes=causes,
        seed=seed,
    )


def model_of(fit: FitResult) -> Model:
    """A fitted network as the start of a pursuit."""
    coordinates = search_coordinates(fit.fitted)
    return Model(fit.declared, fit.fitted, coordinates, coordinates.start, float("nan"), Outcome.CONVERGED)


def known_to(bench: Bench, pursuit: Pursuit) -> NetworkSpec:
    """The final network with the intervals of its numbers."""
    model = pursuit.ladder[-1]
    objective = Objective(compile_network(model.fitted), bench.runs, bench.jobs)
    known = assess_uncertainty(objective, model.coordinates, model.point)
    return with_intervals(model.fitted, dict(zip(model.coordinates.paths, known.intervals, strict=True)))


def force_sensors(dataset: Dataset) -> dict[str, Mapping[str, float]]:
    """What the dataset says of the force channel, by run."""
    return {run.name: run.sensors.get("force", {}) for run in dataset.runs}


def digest_of(spec: NetworkSpec) -> str:
    """sha256 of a network's text."""
    return hashlib.sha256(spec.document.text.encode()).hexdigest()


def _pair(errors: Errors) -> dict[str, float | None]:
    return {"train": errors.train, "held_out": errors.held_out}


def _watch(progress: Progress, name: str) -> Callable[[str, float], None]:
    return lambda what, done: progress(f"{name}: {what}", done or None, None, None)


def _gain_words(gain: Gain | None) -> str:
    if gain is None:
        return "gain not measured, no run could be held out"
    low, high = gain.interval
    return f"gain on held-out runs {gain.value:.1%} [{low:.1%}, {high:.1%}]"
