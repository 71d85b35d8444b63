"""A blind axle from one seed: two wheels on a rig, something hidden inside or in the channels, the label sealed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline

from .axle import Inner, Numbers, draw_inner, platform_forces
from .label import Hidden, Truth
from .motion import SAMPLING, STEPS_PER_SAMPLE, Motion, sweep
from .noise import Noise

INNER = ("friction", "quadratic_damping", "relaxation")
CHANNEL = ("gain", "offset", "delay")
AXLE_KINDS = (*INNER, *CHANNEL)
SWAY, ROLL, LEFT = (1.0, 1.0), (1.0, -1.0), (1.0, 0.0)
ENDS = ("platform_left", "platform_right")
THINNED = 2
EVERY = THINNED * STEPS_PER_SAMPLE
START, STOP, DURATION = 1.0, 18.0, 4.0
ROUNDS = 8

_HEAD = """\
format: dashpot-dataset/1
name: blind axle {seed}
defaults:
  channels:
    time: {{column: t, unit: s}}
    displacement@platform_left: {{column: xl, unit: mm}}
    displacement@platform_right: {{column: xr, unit: mm}}
    force@platform_left: {{column: Fl, unit: N}}
    force@platform_right: {{column: Fr, unit: N}}
runs:
"""

Forces = list[np.ndarray]


@dataclass(frozen=True)
class Drive:
    """One run: both platforms in phase, against each other, or the left one alone; ``repeats`` names its model."""

    name: str
    amplitude: float
    sides: tuple[float, float]
    repeats: str | None = None

    @property
    def motion(self) -> Motion:
        return sweep(self.amplitude, 0.0, START, STOP, DURATION)


DRIVES = (
    Drive("in_2", 2e-3, SWAY),
    Drive("in_4", 4e-3, SWAY),
    Drive("in_6", 6e-3, SWAY),
    Drive("anti_2", 2e-3, ROLL),
    Drive("anti_4", 4e-3, ROLL),
    Drive("left_3", 3e-3, LEFT),
    Drive("in_4_b", 4e-3, SWAY, "in_4"),
    Drive("anti_2_b", 2e-3, ROLL, "anti_2"),
)


def draw_axle(seed: int, kinds: list[str], strengths: list[float], rng: np.random.Generator, folder: Path) -> Truth:
    """Draw numbers, noise and what is hidden; write the dataset. ValueError for what an axle does not have."""
    if unknown := [kind for kind in kinds if kind not in AXLE_KINDS]:
        raise ValueError(f"kind: expected one of {', '.join(AXLE_KINDS)}, got '{unknown[0]}'")
    numbers, noise = Numbers.draw(rng), Noise.draw(rng)
    bare = [_simulate(numbers, drive) for drive in DRIVES]
    moves = [
        [changed - force for changed, force in zip(map(_with(one), DRIVES), bare, strict=True)]
        for one in numbers.changed()
    ]
    tangents = np.stack([_flat(move) for move in moves], axis=1)
    forces, effects = bare, []
    for kind, strength in zip(kinds, strengths, strict=True):
        aim = strength * noise.rms
        if kind in INNER:
            form, place, size, after = _inside(kind, numbers, bare, forces, aim, rng)
        else:
            form, place, size, after = _in_channel(kind, forces, aim, rng)
        added = _flat([new - old for new, old in zip(after, forces, strict=True)])
        left = added - tangents @ np.linalg.lstsq(tangents, added, rcond=None)[0]
        rms = {drive.name: _rms(new - old) for drive, new, old in zip(DRIVES, after, forces, strict=True)}
        effects.append(Hidden(kind, form, size, "", {"place": place}, strength, _rms(left) / noise.rms, rms))
        forces = after
    noise_rms = _write(folder, seed, forces, noise)
    return Truth(seed, "axle", asdict(numbers), asdict(noise), noise_rms, tuple(effects))


def _with(numbers: Numbers) -> Callable[[Drive], np.ndarray]:
    return lambda drive: _simulate(numbers, drive)


def _simulate(numbers: Numbers, drive: Drive, inner: Inner | None = None) -> np.ndarray:
    """Forces on both platforms at the sample times, shape (2, samples)."""
    return platform_forces(numbers, drive.motion, drive.sides, inner)[:, ::EVERY]


def _inside(
    kind: str, numbers: Numbers, bare: Forces, forces: Forces, aim: float, rng: np.random.Generator
) -> tuple[str, str, float, Forces]:
    """Form, place and size of a law that changes the bare forces by ``aim`` [N], and the forces with that change.

    Two laws are so weak that neither feels the other.
    """
    law, size = draw_inner(kind, rng), 1.0
    for _ in range(ROUNDS):
        changes = [
            _simulate(numbers, drive, law.sized(size)) - force for drive, force in zip(DRIVES, bare, strict=True)
        ]
        reached = _rms(_flat(changes))
        if abs(reached / aim - 1.0) < 0.01:
            break
        size *= aim / reached
    return law.form, law.place, size, [force + change for force, change in zip(forces, changes, strict=True)]


def _in_channel(kind: str, forces: Forces, aim: float, rng: np.random.Generator) -> tuple[str, str, float, Forces]:
    """The same for a fault of one channel in one run, or for a delay of all."""
    run, end = int(rng.integers(len(DRIVES))), int(rng.integers(2))
    place = "" if kind == "delay" else f"{DRIVES[run].name}@{ENDS[end]}"

    def spoiled(size: float) -> Forces:
        if kind == "delay":
            return [np.array([_late(force, size) for force in pair]) for pair in forces]
        after = [pair.copy() for pair in forces]
        after[run][end] = (1.0 + size) * after[run][end] if kind == "gain" else after[run][end] + size
        return after

    size = 1e-5
    for _ in range(ROUNDS):
        changed = _rms(_flat([new - old for new, old in zip(spoiled(size), forces, strict=True)]))
        size *= aim / changed
    return kind, place, size, spoiled(size)


def _late(force: np.ndarray, delay: float) -> np.ndarray:
    time = np.arange(force.size) * THINNED / SAMPLING
    return CubicSpline(time, force)(np.maximum(time - delay, 0.0))


def _write(folder: Path, seed: int, forces: Forces, noise: Noise) -> dict[str, float]:
    """Write the runs with noise, and the dataset that explains them; the noise of each run."""
    folder.mkdir(parents=True, exist_ok=True)
    rng, realised = np.random.default_rng([seed, 1]), {}
    for drive, pair in zip(DRIVES, forces, strict=True):
        columns = {"t": np.arange(pair.shape[1]) * THINNED / SAMPLING}
        for side, end, letter, force in zip(drive.sides, ENDS, "lr", pair, strict=True):
            jitter = 2e-6 * rng.standard_normal(force.size)
            error = noise.sample(rng, force.size)
            columns[f"x{letter}"] = (side * drive.motion.displacement[::EVERY] + jitter) * 1e3
            columns[f"F{letter}"] = force + error
            realised[f"{drive.name}@{end}"] = _rms(error)
        np.savez(folder / f"{drive.name}.npz", **columns)
    (folder / "dataset.yaml").write_text(_HEAD.format(seed=seed) + "".join(map(_entry, DRIVES)), encoding="utf-8")
    return realised


def _entry(drive: Drive) -> str:
    again = f", repeats: {drive.repeats}" if drive.repeats else ""
    settings = f"amplitude: {drive.amplitude * 1e3:g} mm, start: {START:g} Hz, stop: {STOP:g} Hz"
    return f"  - {{name: {drive.name}, file: {drive.name}.npz, kind: sweep, settings: {{{settings}}}{again}}}\n"


def _flat(pairs: Forces) -> np.ndarray:
    return np.concatenate([pair.ravel() for pair in pairs])


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))
