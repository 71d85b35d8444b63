"""The result of a campaign in plain values, as in ``campaign.json``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

import dashpot
from dashpot.campaign.causes import causes_found
from dashpot.campaign.declaration import Job, Measured
from dashpot.campaign.job import Outcome
from dashpot.campaign.named import Named, named_by_causes, named_by_error, named_by_faults, named_by_numbers
from dashpot.campaign.numbers import depending, errors_of_model, models_of, numbers_of
from dashpot.campaign.population import FEWEST, Population, population_of
from dashpot.campaign.run import CampaignResult
from dashpot.campaign.sharing import Shared
from dashpot.campaign.unlike import unlike


def campaign_content(result: CampaignResult) -> dict[str, Any]:
    """The content of ``campaign.json``: specimens, populations of every model, named specimens, causes, failures."""
    campaign = result.campaign
    fits = {model.name: models_of(result.outcomes, model.name) for model in campaign.models}
    numbers = {model: numbers_of(found) for model, found in fits.items() if len(found) >= FEWEST}
    causes = causes_found(result.outcomes)
    misfits = [*_badly_described(fits), *named_by_causes(causes)]
    told = {
        model: population_of(
            *depending(each, campaign), campaign, {one.specimen for one in misfits if one.model == model}
        )
        for model, each in numbers.items()
        if each.paths
    }
    return {
        "format": "dashpot-campaign-result/1",
        "version": dashpot.__version__,
        "campaign": {
            **{key: getattr(campaign, key) for key in ("name", "about", "seed", "batch")},
            "verbs": list(campaign.verbs),
            "models": [model.name for model in campaign.models],
        },
        "specimens": [_specimen(one, result, fits, told) for one in campaign.specimens],
        "populations": [
            {"model": model, **each.as_dict(), "shared": _shared(model, result.shared.get(model), result.outcomes)}
            for model, each in told.items()
        ],
        "named": [vars(one) for one in _named(result, told, misfits)],
        "causes": causes,
        "failures": [{"job": job.name, "specimen": job.specimen, "reason": reason} for job, reason in _failed(result)],
    }


def _failed(result: CampaignResult) -> Iterator[tuple[Job, str]]:
    """The jobs that failed, and those of whose models some could not be fitted."""
    yield from result.failures.items()
    for job, outcome in result.outcomes.items():
        yield from ((job, f"{model}: {reason}") for model, reason in outcome.get("failures", {}).items())


def _specimen(
    one: Measured, result: CampaignResult, fits: Mapping[str, Mapping[str, Outcome]], told: Mapping[str, Population]
) -> dict[str, Any]:
    mine = {job: outcome for job, outcome in result.outcomes.items() if job.specimen == one.name}
    digests = [outcome["digest"] for outcome in mine.values()]
    return {
        "specimen": one.name,
        "data": one.data,
        "digest": digests[0] if digests else None,
        "properties": dict(one.properties),
        "models": {
            model: _fit(one.name, found[one.name], told.get(model))
            for model, found in fits.items()
            if one.name in found
        },
        "verdicts": {job.models[0]: outcome["verdict"] for job, outcome in mine.items() if "verdict" in outcome},
        "reports": [job.name for job, outcome in mine.items() if outcome["report"]],
        "remarks": list(dict.fromkeys(remark for outcome in mine.values() for remark in outcome["remarks"])),
    }


def _fit(specimen: str, fit: Outcome, population: Population | None) -> dict[str, Any]:
    numbers = {
        path: {key: number[key] for key in ("value", "unit", "interval")} for path, number in fit["numbers"].items()
    }
    place = {"unlike": None, "group": None} if population is None else population.place_of(specimen)
    return {"numbers": numbers, **{key: fit[key] for key in ("rmse", "noise_floor", "ending")}, **place}


def _badly_described(fits: Mapping[str, Mapping[str, Outcome]]) -> Iterator[Named]:
    for model, some in fits.items():
        if len(some) >= FEWEST:
            errors = errors_of_model(some)
            yield from named_by_error(model, errors, unlike(errors))


def _named(result: CampaignResult, told: Mapping[str, Population], misfits: Sequence[Named]) -> Sequence[Named]:
    """The surest first; a specimen may be named for several reasons."""
    found = [one for model, each in told.items() for one in named_by_numbers(model, each.numbers, each.judged)]
    remarks: dict[str, list[str]] = {}
    for job, outcome in result.outcomes.items():
        remarks.setdefault(job.specimen, []).extend(outcome["remarks"])
    faults = named_by_faults(remarks, [(job.specimen, outcome) for job, outcome in result.outcomes.items()])
    return sorted([*found, *misfits, *faults], key=lambda one: -one.probability)


def _shared(model: str, shared: Shared | None, outcomes: Mapping[Job, Outcome]) -> dict[str, Any] | None:
    """The parameters in common, and what each specimen comes to with them."""
    if shared is None:
        return None
    again = {
        job.specimen: outcome["models"][0] for job, outcome in outcomes.items() if job.held and job.models == (model,)
    }
    free = models_of(outcomes, model)
    ratios = [again[name]["rmse"]["train"] / free[name]["rmse"]["train"] for name in again]
    return {
        "numbers": {
            path: {"value": value, "interval": list(shared.intervals[path])} for path, value in shared.values.items()
        },
        "probability": shared.probability,
        "error_ratio": float(np.sqrt(np.mean(np.square(ratios)))) if ratios else None,
        "specimens": {
            name: {
                "rmse": fit["rmse"],
                "numbers": {
                    path: {key: number[key] for key in ("value", "interval")} for path, number in fit["numbers"].items()
                },
            }
            for name, fit in again.items()
        },
    }
