"""Runs of known specimens, integrated here sample by sample."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from dashpot.data.dataset import Dataset
from dashpot.data.run import Run

DT, SAMPLES = 1e-3, 3000
STIFFNESS, DAMPING, LIMIT, YIELD, NOISE = 200e3, 900.0, 60.0, 0.3e-3, 10.0

Law = Callable[[np.ndarray, dict[str, float]], np.ndarray]


def slide(x: np.ndarray, limit: float = LIMIT, travel: float = YIELD) -> np.ndarray:
    """The force (n,) N of a spring behind a dry slider."""
    force = np.zeros(x.size)
    for k in range(1, x.size):
        force[k] = np.clip(force[k - 1] + limit / travel * (x[k] - x[k - 1]), -limit, limit)
    return force


def with_friction(x: np.ndarray, settings: dict[str, float]) -> np.ndarray:
    """Spring, damper and slider; its limit grows with the setting `pressure`, if there is one."""
    level = 1.0 + settings.get("pressure", 0.0)
    return STIFFNESS * x + DAMPING * np.gradient(x, DT) + slide(x, level * LIMIT)


def sweep(amplitude: float, preload: float, fastest: float = 20.0) -> np.ndarray:
    """A sweep (n,) m from 1 Hz up."""
    time = DT * np.arange(SAMPLES)
    return preload + amplitude * np.sin(2.0 * np.pi * (time + (fastest - 1.0) * time**2 / (2.0 * time[-1])))


def run(
    name: str,
    x: np.ndarray,
    force: np.ndarray,
    kind: str = "sweep",
    repeats: str | None = None,
    order: int = 0,
    **settings: float,
) -> Run:
    """A run in memory."""
    channels = {"displacement": x, "force": force}
    return Run(name, kind, DT * np.arange(x.size), channels, settings, repeats, repeats or name, order=order)


def sweeps(law: Law = with_friction, seed: int = 3, noise: float = NOISE, pressures: tuple[float, ...] = ()) -> Dataset:
    """Sweeps at three amplitudes and three preloads, with white noise on the force."""
    rng = np.random.default_rng(seed)
    runs = []
    for number, (amplitude, preload) in enumerate([(a, p) for a in (0.5e-3, 1e-3, 3e-3) for p in (5e-3, 10e-3, 15e-3)]):
        settings = {"amplitude": amplitude, "preload": preload}
        if pressures:
            settings["pressure"] = pressures[(number + number // 3) % len(pressures)]
        x = sweep(amplitude, preload)
        force = law(x, settings) + noise * rng.standard_normal(x.size)
        runs.append(run(f"a{1e3 * amplitude:g}_p{1e3 * preload:g}", x, force, order=number, **settings))
    return Dataset("sweeps", tuple(runs))


def with_forces(dataset: Dataset, forces: dict[str, np.ndarray]) -> Dataset:
    """The dataset with other forces in some runs."""
    runs = [
        replace(each, channels={**each.channels, "force": forces.get(each.name, each.force)}) for each in dataset.runs
    ]
    return Dataset(dataset.name, tuple(runs))
