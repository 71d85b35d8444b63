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


def posterior(**changes: Any) -> dict[str, Any]:
    """The posterior of two of the parameters."""
    known = {"r_hat": 1.01, "effective_draws": 1700.0, "autocorrelation_time": 9.5}
    return {
        "sampler": "emcee",
        "converged": True,
        "sentence": "the posterior converged: 1700 effective draws",
        "walkers": 32,
        "steps": 500,
        "discarded": 100,
        "acceptance": 0.3,
        "error": 12.0,
        "held": [],
        "parameters": {
            "maxwell.stiffness": {"median": 45.2e3, "interval": [43e3, 47e3], "unit": "N/m", **known},
            "maxwell.relaxation_time": {"median": 0.15, "interval": [0.1, 0.2], "unit": "s", **known},
        },
    } | changes
