"""Which causes were found in which specimens."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from dashpot.campaign.declaration import Job
from dashpot.campaign.job import Outcome
from dashpot.campaign.named import NAMED


def causes_found(outcomes: Mapping[Job, Outcome]) -> list[dict[str, Any]]:
    """For each model and cause that a diagnosis told of: ``probability`` by specimen, the most frequent cause first.

    A specimen that was diagnosed and of which the cause was not told has 0. ``certain`` holds the evidence by specimen
    where the cause was accepted with the probability from which a specimen is named.
    """
    diagnosed: dict[str, list[str]] = {}
    found: dict[tuple[str, str, str | None], dict[str, Any]] = {}
    for job, outcome in outcomes.items():
        if "causes" not in outcome:
            continue
        [model] = job.models
        diagnosed.setdefault(model, []).append(job.specimen)
        for cause in outcome["causes"]:
            key = model, cause["cause"], cause["place"]
            told = {"model": model, **{word: cause[word] for word in ("cause", "title", "place", "class")}}
            row = found.setdefault(key, {**told, "probability": {}, "certain": {}})
            probability = max(cause["probability"] or 0.0, row["probability"].get(job.specimen, 0.0))
            row["probability"][job.specimen] = probability
            if cause["accepted"] and probability >= NAMED:
                row["certain"][job.specimen] = cause["evidence"]
    for row in found.values():
        row["probability"] = {name: row["probability"].get(name, 0.0) for name in diagnosed[row["model"]]}
    return sorted(found.values(), key=lambda row: (-sum(row["probability"].values()), row["model"], row["cause"]))
