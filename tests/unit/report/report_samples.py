"""A test tire with dry friction, and a model of it without: result files and evidence as a diagnosis writes them."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

STIFFNESS, DAMPING, SLIDING, YIELD = 220e3, 900.0, 41.0, 0.4e-3
AMPLITUDES, PRELOADS = (0.5e-3, 1e-3, 2e-3, 5e-3), (10e-3, 20e-3, 30e-3)
BANDS = ((1.0, 3.0), (3.0, 8.0), (8.0, 15.0), (15.0, 25.0))
DURATION, RATE, NOISE = 10.0, 1000.0, 14.0


def sweep(amplitude: float, preload: float, rng: np.random.Generator) -> dict[str, np.ndarray]:
    """A sweep from 1 to 25 Hz: measured force, and the simulated one before and after friction was added."""
    time = np.arange(int(DURATION * RATE)) / RATE
    phase = 2.0 * np.pi * (time + 24.0 / DURATION * time**2 / 2.0)
    x = preload + amplitude * np.sin(phase)
    linear = STIFFNESS * x * (1.0 + 4.0 * x) + DAMPING * np.gradient(x, time)
    friction = slide(x)
    measured = linear + friction + NOISE * rng.standard_normal(x.size)
    before = linear + 0.55 * friction.std() / amplitude * (x - preload)
    after = linear + 0.98 * friction
    velocity = np.gradient(x, time)
    return {"time": time, "displacement": x, "velocity": velocity, "force": measured, "before": before, "after": after}


def slide(x: np.ndarray) -> np.ndarray:
    force = np.zeros_like(x)
    for k in range(1, x.size):
        force[k] = np.clip(force[k - 1] + SLIDING / YIELD * (x[k] - x[k - 1]), -SLIDING, SLIDING)
    return force


@cache
def runs(seed: int = 1) -> dict[str, dict[str, np.ndarray]]:
    rng = np.random.default_rng(seed)
    return {
        f"a{1e3 * amplitude:g}_p{1e3 * preload:g}": sweep(amplitude, preload, rng)
        for preload in PRELOADS
        for amplitude in AMPLITUDES
    }


def rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(values))))


def stiffness_curve(name: str, amplitude: float, preload: float) -> dict[str, Any]:
    frequency = np.linspace(1.0, 25.0, 40)
    scale = 1.0 + 8.0 * preload
    linear = scale * STIFFNESS + 2j * np.pi * frequency * DAMPING
    friction = (SLIDING / amplitude) * (0.5 + 0.8j)
    rng = np.random.default_rng(len(name))
    noise = 1.0 + 0.004 * rng.standard_normal(frequency.size)
    return {
        "run": name,
        "amplitude": amplitude,
        "preload": preload,
        "frequency": frequency,
        "measured": response((linear + friction) * noise),
        "simulated": {"before": response(linear + 0.5 * friction.real), "after": response(linear + 0.97 * friction)},
    }


def response(complex_stiffness: np.ndarray) -> dict[str, np.ndarray]:
    return {"stiffness": np.abs(complex_stiffness), "loss_angle": np.angle(complex_stiffness)}


def misfit_rows(data: dict[str, dict[str, np.ndarray]]) -> list[dict[str, Any]]:
    return [
        {"run": name, "band": band, "rmse": {label: band_error(run, label, band) for label in ("before", "after")}}
        for name, run in data.items()
        for band in BANDS
    ]


def band_error(run: dict[str, np.ndarray], label: str, band: tuple[float, float]) -> float:
    frequency = 1.0 + 24.0 * run["time"] / DURATION
    inside = (frequency >= band[0]) & (frequency < band[1])
    return rms((run["force"] - run[label])[inside])


def evidence() -> dict[str, Any]:
    data = runs()
    conditions = [(amplitude, preload) for preload in PRELOADS for amplitude in AMPLITUDES]
    residuals = {label: {k: run["force"] - run[label] for k, run in data.items()} for label in ("before", "after")}
    return {
        "loops": {
            "measured": {
                name: {k: run[k] for k in ("time", "displacement", "velocity", "force")} for name, run in data.items()
            },
            "simulated": {label: {name: run[label] for name, run in data.items()} for label in ("before", "after")},
        },
        "residuals": {"time": {name: run["time"] for name, run in data.items()}, "residuals": residuals},
        "dynamic_stiffness": [stiffness_curve(n, a, p) for n, (a, p) in zip(data, conditions, strict=True)],
        "misfit_map": misfit_rows(data),
        "harmonics": {
            "before": {
                f"amplitude {1e3 * a:g} mm": [33.0 / (1 + i), 3.1, 17.0, 1.2, 8.0] for i, a in enumerate(AMPLITUDES)
            },
            "after": {f"amplitude {1e3 * a:g} mm": [2.0, 1.1, 1.4, 0.7, 0.9] for a in AMPLITUDES},
        },
        "history": {
            "kelvin_voigt": {"evaluations": 96 * np.arange(1, 60), "best": 60.0 + 400.0 * np.exp(-np.arange(59) / 5.0)},
            "extended": {"evaluations": 96 * np.arange(1, 90), "best": 14.3 + 80.0 * np.exp(-np.arange(89) / 9.0)},
        },
        "patch": {"before": BEFORE, "after": AFTER, "before_name": "kelvin_voigt.yaml"},
        "rejected": [
            {
                "cause": "relaxation",
                "reason": "its gain on held-out runs is not distinguishable from zero",
                "expected_gain": 0.21,
                "gain": 0.02,
            },
            {
                "cause": "moving_mass",
                "reason": "score 3.1 is below the threshold of 9.8",
                "expected_gain": 0.01,
                "gain": None,
            },
        ],
        "tried": 8,
        "limits": [
            {"cause": "relaxation", "quantity": "stiffness at 1 Hz", "value": 190.0, "unit": "N/m"},
            {"cause": "delay", "quantity": "time", "value": 45e-6, "unit": "s"},
            {"cause": "moving_mass", "quantity": "mass", "value": 0.012, "unit": "kg"},
        ],
        "provenance": {
            "dashpot": "0.1.0",
            "numpy": "2.1.0",
            "seed": 7,
            "command": "dashpot diagnose kelvin_voigt tire",
        },
    }


def diagnosis(**changes: Any) -> dict[str, Any]:
    return {
        "format": "dashpot-diagnosis/1",
        "model": {"name": "kelvin_voigt", "digest": "6b1f0c" * 10},
        "dataset": {"name": "test tire, single-axis hydropulser", "digest": "a3e94d" * 10},
        "verdict": "explained",
        "noise_floor": {"value": 14.5, "from": "repeats"},
        "rmse": {"before": {"train": 60.1, "held_out": 61.0}, "after": {"train": 14.4, "held_out": 14.6}},
        "misfit": [
            {
                "what": "loss stiffness too small at small amplitude",
                "share": 0.73,
                "where": {"amplitude": "0.5 to 1 mm", "band": "1 to 25 Hz"},
            },
            {"what": "odd harmonics missing", "share": 0.11, "where": {"amplitude": "all", "band": "below 8 Hz"}},
        ],
        "causes": [friction(), relaxation()],
        "extended_model": "kelvin_voigt+friction.yaml",
    } | changes


def friction(**changes: Any) -> dict[str, Any]:
    return {
        "cause": "friction",
        "title": "dry friction",
        "class": "specimen",
        "rank": 1,
        "accepted": True,
        "branch": "friction",
        "evidence": "third harmonic in phase with velocity, constant over frequency, falling with amplitude",
        "expected_gain": 0.70,
        "gain": 0.76,
        "gain_interval": [0.71, 0.80],
        "parameters": {
            "limit": {"value": 41.0, "interval": [38.0, 44.0], "unit": "N"},
            "stiffness": {"value": 102e3, "interval": [95e3, 109e3], "unit": "N/m"},
        },
        "indistinguishable_from": [],
        "next_measurement": None,
    } | changes


def relaxation(**changes: Any) -> dict[str, Any]:
    return {
        "cause": "relaxation",
        "class": "specimen",
        "rank": 2,
        "accepted": False,
        "branch": "relaxation",
        "evidence": "stiffness rises with frequency by 0.4 % only",
        "expected_gain": 0.21,
        "gain": 0.02,
        "gain_interval": [-0.03, 0.06],
        "parameters": {"relaxation_time": {"value": 0.16, "interval": [0.02, 0.9], "unit": "s"}},
        "indistinguishable_from": [],
        "next_measurement": "Hold 20 mm for 60 s: friction keeps its force, relaxation loses it.",
    } | changes


def comparison() -> dict[str, Any]:
    errors = {
        "spring": 131.0,
        "kelvin_voigt": 61.0,
        "gehmann": 42.0,
        "ftire": 29.5,
        "tire_model_3": 17.1,
        "tire_model_5": 14.9,
    }
    return {
        "format": "dashpot-comparison/1",
        "dataset": {"name": "test tire, single-axis hydropulser", "digest": "a3e94d" * 10},
        "noise_floor": {"value": 14.5, "from": "repeats"},
        "models": [model(name, error) for name, error in errors.items()],
    }


def model(name: str, error: float) -> dict[str, Any]:
    conditions = [f"a{a:g}_p{p:g}" for p in (10, 20, 30) for a in (0.5, 1, 2, 5)]
    return {
        "name": name,
        "parameters": {
            "tread.stiffness": {"value": 2.2e5, "unit": "N/m"},
            "tread.relaxation_time": {"value": 0.16, "unit": "s"},
        },
        "rmse": {"train": 0.97 * error, "held_out": error, "all": 0.98 * error},
        "nrmse": {"train": 0.97 * error / 900, "held_out": error / 900, "all": 0.98 * error / 900},
        "per_run": {run: error * (0.8 + 0.03 * index) for index, run in enumerate(conditions)},
        "status": "ok",
    }


def comparison_evidence() -> dict[str, Any]:
    names = {"before": "kelvin_voigt", "after": "tire_model_5"}
    full = evidence()
    renamed = {names[label]: forces for label, forces in full["loops"]["simulated"].items()}
    curves = [
        curve | {"simulated": {names[label]: each for label, each in curve["simulated"].items()}}
        for curve in full["dynamic_stiffness"]
    ]
    return {
        "loops": {"measured": full["loops"]["measured"], "simulated": renamed},
        "dynamic_stiffness": curves,
        "provenance": full["provenance"],
    }


BEFORE = """\
# a spring and a damper side by side
name: kelvin_voigt
network:
  parallel:
    tread: {spring: {stiffness: 220 N/mm}}
    damper: {damper: {viscosity: 0.9 N*s/mm}}   # linear
"""

AFTER = """\
# a spring and a damper side by side
# extended by dry friction: 76 % less error on held-out runs; predecessor kelvin_voigt.yaml
name: kelvin_voigt+friction
network:
  parallel:
    tread: {spring: {stiffness: 219 N/mm}}
    damper: {damper: {viscosity: 0.9 N*s/mm}}   # linear
    friction:
      prandtl:
        stiffness: {start: 102 N/mm, bounds: [1 N/mm, 1000 N/mm]}
        limit: {start: 41 N, bounds: [1 N, 1 kN]}
"""
