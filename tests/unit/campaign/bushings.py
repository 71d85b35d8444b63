"""A virtual population of bushings with known truth; it shares nothing with dashpot.

Each bushing is a standard linear solid: the force is k x + k1 (x - y) with T y' = x - y, solved exactly for motions
that are straight between samples. Its three numbers scatter log-normally about means that depend on temperature.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

Runs = Sequence[tuple[float, float]]

PATHS = ("rubber.stiffness", "slow.stiffness", "slow.relaxation_time")
MEAN = np.log([220e3, 60e3, 0.02])
SCATTER = np.array([0.04, 0.06, 0.05])
CORRELATION = np.array([[1.0, 0.5, 0.0], [0.5, 1.0, 0.0], [0.0, 0.0, 1.0]])
TREND = np.array([-0.006, -0.010, -0.005])  # of the logarithms, per K
ROOM = 25.0  # degC at which the means are MEAN
BATCH = 5
NOISE = 2.0  # N
TIME = np.arange(1200) / 600.0
RUNS = ((1.0e-3, 20.0), (0.6e-3, 25.0), (1.4e-3, 15.0), (0.8e-3, 22.0))  # amplitude in m, highest frequency in Hz

MODEL = """\
format: dashpot-network/1
name: solid
branches:
  rubber: {element: spring, stiffness: {start: 150 N/mm}}
  slow: {element: maxwell, stiffness: {start: 90 N/mm}, relaxation_time: {start: 50 ms, bounds: [1 ms, 1 s]}}
"""
DATASET = """\
format: dashpot-dataset/1
name: bushing
defaults:
  kind: sweep
  channels: {time: {column: t, unit: s}, displacement: {column: x, unit: mm}, force: {column: F, unit: N}}
runs:
"""
CAMPAIGN = """\
format: dashpot-campaign/1
name: bushings
about: "A virtual population."
specimens: specimens.csv
models: [solid.yaml]
"""


@dataclass(frozen=True)
class Fault:
    """What is wrong with a bushing or its test: factors on its numbers, play in m, a factor on the measured force."""

    factors: tuple[float, float, float] = (1.0, 1.0, 1.0)
    play: float = 0.0
    gain: float = 1.0


FAULTS = {
    3: Fault(factors=(0.65, 1.0, 1.0)),  # torn
    17: Fault(factors=(1.0, 1.8, 1.0)),  # too much carbon black
    22: Fault(play=0.15e-3),  # wrongly mounted: loose
    12: Fault(gain=1.5),  # the load cell of another range
}
DAMAGED, LOOSE, WRONG_GAIN = ("b03", "b17"), "b22", "b12"


@dataclass(frozen=True)
class Population:
    """The truth: ``numbers`` (n, 3) of the sound bushings before any fault, their ``temperatures`` (n,) in degC."""

    numbers: np.ndarray
    temperatures: np.ndarray
    faults: Mapping[int, Fault] = field(default_factory=dict)


def draw_population(seed: int, count: int, faults: Mapping[int, Fault] = FAULTS) -> Population:
    """Numbers of ``count`` bushings."""
    rng = np.random.default_rng(seed)
    temperatures = rng.uniform(5.0, 45.0, count)
    covariance = CORRELATION * np.outer(SCATTER, SCATTER)
    scatter = rng.multivariate_normal(np.zeros(3), covariance, count)
    logs = MEAN + np.outer(temperatures - ROOM, TREND) + scatter
    return Population(np.exp(logs), temperatures, {k: fault for k, fault in faults.items() if k < count})


def write_population(
    folder: Path, population: Population, seed: int, campaign: str = CAMPAIGN, runs: Runs = RUNS
) -> Path:
    """The bushings, measured in some ``runs``, as folders with a table; the path of the campaign file."""
    rng = np.random.default_rng([seed, 1])
    folder.mkdir(parents=True, exist_ok=True)
    lines = ["specimen,data,temperature,batch"]
    for k, (numbers, temperature) in enumerate(zip(population.numbers, population.temperatures, strict=True)):
        _write_bushing(folder / f"b{k:02d}", numbers, population.faults.get(k, Fault()), rng, runs)
        lines.append(f"b{k:02d},b{k:02d},{float(temperature)!r},B{k // BATCH + 1}")
    (folder / "specimens.csv").write_text("\n".join(lines) + "\n")
    (folder / "solid.yaml").write_text(MODEL)
    (folder / "campaign.yaml").write_text(campaign)
    return folder / "campaign.yaml"


def force_of(x: np.ndarray, dt: float, k: float, k1: float, relaxation: float) -> np.ndarray:
    """The force (n,) in N of a standard linear solid along a path (n,) in m, straight between samples."""
    fade = np.exp(-dt / relaxation)
    slope = np.diff(x) / dt
    branch = np.zeros_like(x)
    for i, rate in enumerate(slope):
        branch[i + 1] = fade * branch[i] + k1 * relaxation * rate * (1.0 - fade)
    return k * x + branch


def _write_bushing(folder: Path, numbers: np.ndarray, fault: Fault, rng: np.random.Generator, runs: Runs) -> None:
    folder.mkdir(exist_ok=True)
    text = DATASET
    for number, (amplitude, top) in enumerate(runs):
        phase = 2.0 * np.pi * (1.0 * TIME + (top - 1.0) * TIME**2 / (2.0 * TIME[-1]))
        x = amplitude * np.sin(phase)
        felt = np.sign(x) * np.maximum(np.abs(x) - 0.5 * fault.play, 0.0)
        force = fault.gain * force_of(felt, TIME[1], *(numbers * fault.factors)) + rng.normal(0.0, NOISE, x.size)
        np.savez(folder / f"r{number}.npz", t=TIME, x=1e3 * x, F=force)
        text += f"  - {{name: r{number}, file: r{number}.npz, settings: {{amplitude: {1e3 * amplitude:g} mm}}}}\n"
    (folder / "dataset.yaml").write_text(text)
