"""One job where it is done: data read where they lie, a verb, a small result."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from dashpot.campaign.address import at_hand, is_remote, state_of
from dashpot.campaign.declaration import Job
from dashpot.compare.comparison import Comparison, compare
from dashpot.contract.registry import Registry, load_registry
from dashpot.data.dataset import Dataset, read_dataset
from dashpot.diagnose.diagnose import diagnose
from dashpot.diagnose.diagnosis import Diagnosis
from dashpot.fit.api import fit_network
from dashpot.fit.result import FitResult
from dashpot.model.network import NetworkSpec, Slot
from dashpot.text.problem import InputError
from dashpot.triage.examine import examined

NORMAL = 1.959964
AT_BOUND = 100.0  # standard errors that a number has where the range ends and not the data

Outcome = dict[str, Any]
Found = FitResult | Comparison | Diagnosis
Write = Callable[[Found, str, Registry], None]


@dataclass(frozen=True)
class Work:
    """What all jobs share. ``write`` keeps a result under the name of its job."""

    models: Mapping[str, NetworkSpec]
    seed: int
    threads: int = 1
    write: Write | None = None


def run_job(work: Work, job: Job) -> Outcome:
    """The result of a job in plain values, or ``failed`` with the reason."""
    try:
        return _plain({"inputs": inputs_of(job), **_result(work, job, load_registry())})
    except InputError as error:
        return {"failed": str(error)}
    except Exception as error:
        return {"failed": f"{type(error).__name__}: {error}"}


def inputs_of(job: Job) -> dict[str, Any]:
    """What a job starts from beside the campaign: the state of its files, and the parameters that it is given."""
    return {"files": state_of(job.data), "held": dict(job.held)}


def _result(work: Work, job: Job, registry: Registry) -> Outcome:
    specs = [with_held(work.models[name], job.held) for name in job.models]
    with at_hand(job.data) as path:
        dataset = read_dataset(path, {word: reader() for word, reader in registry.formats.items()})
        found = _done(job, specs, dataset, work, registry)
        # a corrected dataset names the files that it corrects, and those of a copy are gone
        lasting = not (is_remote(job.data) and isinstance(found, Diagnosis) and found.corrected_name)
        if work.write is not None and lasting:
            work.write(found, job.name, registry)
        told = _told(found)
        remarks = [remark.replace(str(path), job.data) for remark in told["remarks"]]
    return {"digest": dataset.digest, **told, "remarks": remarks, "report": work.write is not None and lasting}


def _done(job: Job, specs: Sequence[NetworkSpec], dataset: Dataset, work: Work, registry: Registry) -> Found:
    if job.verb == "diagnose":
        return diagnose(specs[0], dataset, seed=work.seed, jobs=work.threads, registry=registry)
    sound = examined(dataset)
    if job.verb == "compare":
        return compare(specs, sound, seed=work.seed, jobs=work.threads, registry=registry)
    return fit_network(specs[0], sound, seed=work.seed, jobs=work.threads, registry=registry)


def with_held(spec: NetworkSpec, held: Mapping[str, float]) -> NetworkSpec:
    """The network with some numbers fixed at values in SI."""
    slots = {slot.path: slot.value for slot in spec.slots()}
    return spec.with_values(
        {path: replace(slots[path], number=number, expression="").as_role("fixed") for path, number in held.items()}
    )


def _told(found: Found) -> Outcome:
    if isinstance(found, Diagnosis):
        content = found.as_dict()
        kept = ("cause", "class", "title", "place", "probability", "accepted", "evidence")
        causes = [{key: cause[key] for key in kept} for cause in content["causes"]]
        remarks = found.triage.sentences
        return {"models": [_model(found.fit)], "verdict": content["verdict"], "causes": causes, "remarks": remarks}
    fits = found.fits if isinstance(found, Comparison) else (found,)
    failures = dict(found.failures) if isinstance(found, Comparison) else {}
    dataset = fits[0].dataset if fits else None
    faults = [str(problem) for problem in dataset.problems if problem.severity == "error"] if dataset else []
    return {"models": [_model(fit) for fit in fits], "failures": failures, "remarks": faults}


def _model(fit: FitResult) -> dict[str, Any]:
    """The parameters of a model that specimens can be compared by, with the correlation of their errors."""
    searched = [slot for slot in fit.fitted.slots() if slot.value.searched]
    tables = {path for path, curve in fit.fitted.curves().items() if curve.form == "table"}
    kept = [
        number for number, slot in enumerate(searched) if slot.path.partition("[")[0] not in tables and _is_known(slot)
    ]
    correlation = fit.correlation
    return {
        "name": fit.declared.name,
        "numbers": {searched[k].path: _number(searched[k], searched[k].path in fit.at_bound) for k in kept},
        "correlation": [] if correlation is None else correlation[kept][:, kept].tolist(),
        "rmse": {"train": fit.errors.train, "held_out": fit.errors.held_out},
        "noise_floor": fit.noise_floor.value,
        "ending": fit.ending,
    }


def _is_known(slot: Slot) -> bool:
    return slot.value.interval is not None and slot.value.interval[0] < slot.value.interval[1]


def _number(slot: Slot, at_bound: bool) -> dict[str, Any]:
    """A number with its standard error, in logarithms where it is searched so."""
    value, log = slot.value, slot.value.scale == "log"
    assert value.interval is not None
    ends = [math.log(end) if log else end for end in (value.number, *value.interval)]
    error = max(ends[0] - ends[1], ends[2] - ends[0]) / NORMAL * (AT_BOUND if at_bound else 1.0)
    return {"value": value.number, "unit": value.unit, "log": log, "interval": list(value.interval), "error": error}


def _plain(outcome: Outcome) -> Outcome:
    """As it will be read from its record."""
    return json.loads(json.dumps(outcome))
