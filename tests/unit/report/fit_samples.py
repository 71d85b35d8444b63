"""A result file of a fit, and its page."""

from __future__ import annotations

from typing import Any

from unit.report.report_samples import comparison, comparison_evidence

from dashpot.report.fit import fit_page
from dashpot.report.parts import Page


def number(value: float, unit: str, interval: list[float] | None = None, role: str = "free") -> dict[str, Any]:
    return {"value": value, "unit": unit, "interval": interval, "role": role}


def fit(**changes: Any) -> dict[str, Any]:
    parameters = {
        "rubber.stiffness[0]": number(10.0, "N", [8.0, 12.0]),
        "maxwell.stiffness": number(45e3, "N/m", [44e3, 46e3]),
        "maxwell.relaxation_time": number(0.16, "s"),
        "friction.limit": number(20.0, "N", role="fixed"),
    }
    content = {
        "format": "dashpot-fit/1",
        "model": "gehmann",
        "dataset": {"name": "bench", "digest": "d" * 64},
        "parameters": parameters,
        "rmse": {"train": 37.0, "held_out": 36.0, "all": 36.8},
        "per_run": {"slow": 30.0, "a": 36.0, "b": 37.0},
        "noise_floor": {"value": 9.0, "from": "repeats"},
        "held_out": ["a"],
        "optimizer": "swarm",
        "seed": 0,
        "evaluations": 663,
        "ending": "converged",
        "at_bound": ["maxwell.relaxation_time"],
        "without_influence": [],
        "spread": [36.0, 36.1, 50.0],
    }
    return content | changes


def page_of(content: dict[str, Any], **evidence: Any) -> Page:
    alone = {**comparison(), "models": comparison()["models"][:1]}
    return fit_page(content, alone, {**comparison_evidence(), **evidence})
