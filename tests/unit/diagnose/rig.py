"""Small measurements with known laws, by closed forms and sample by sample; they share nothing with the elements."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from dashpot.contract.cause import Cause
from dashpot.contract.registry import load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.diagnose.refit import Refitter
from dashpot.diagnose.term import Model, first_model
from dashpot.fit.api import Setting, fit_prepared, prepare, silent
from dashpot.model.reading import parse_network

REGISTRY = load_registry()
STEP, SAMPLES = 2e-3, 1000
TIME = STEP * np.arange(SAMPLES)
STIFFNESS, DAMPING, NOISE = 200e3, 400.0, 5.0
UNITS = {"temperature": "K", "warm_up": "s"}  # of settings and channels, besides those of the motion
NETWORK = """\
format: dashpot-network/1
name: plain
branches:
  stiffness: {element: spring, stiffness: {start: 150 N/mm}}
  damping: {element: damper, damping: {start: 200 N*s/m}}
"""

Array = np.ndarray
Law = Callable[["Motion"], Array]


class Made(Cause):
    """A cause for tests."""

    word, kind, about, shows = "made", "specimen", "made for a test", "in no way"

    def suspects(self, view, network):
        """None of its own."""
        return ()


@dataclass(frozen=True)
class Motion:
    """A sweep about a preload, m, m/s at any time in s."""

    amplitude: float
    preload: float
    fastest: float = 12.0

    def phase(self, time: Array = TIME) -> Array:
        """The angle (n,)."""
        return 2.0 * np.pi * (time + 0.5 * (self.fastest - 1.0) * time**2 / TIME[-1])

    def x(self, time: Array = TIME) -> Array:
        """The deflection (n,) in m."""
        return self.preload + self.amplitude * np.sin(self.phase(time))

    def v(self, time: Array = TIME) -> Array:
        """The velocity (n,) in m/s."""
        rate = 2.0 * np.pi * (1.0 + (self.fastest - 1.0) * time / TIME[-1])
        return self.amplitude * np.cos(self.phase(time)) * rate


MOTIONS = {f"a{a:g}_p{p:g}": Motion(1e-3 * a, 1e-3 * p) for p in (5, 8, 11) for a in (1, 3)}


def plain(motion: Motion, time: Array = TIME) -> Array:
    """Spring and dashpot (n,) N."""
    return STIFFNESS * motion.x(time) + DAMPING * motion.v(time)


def friction(motion: Motion, limit: float = 40.0, travel: float = 0.2e-3) -> Array:
    """A spring behind a dry slider (n,) N, stepped through a time ten times as fine."""
    fine = motion.x(np.linspace(0.0, TIME[-1], 10 * (SAMPLES - 1) + 1))
    force = np.zeros(fine.size)
    for k in range(1, fine.size):
        force[k] = np.clip(force[k - 1] + limit / travel * (fine[k] - fine[k - 1]), -limit, limit)
    return force[::10]


def relaxation(motion: Motion, stiffness: float = 40e3, time: float = 30e-3) -> Array:
    """A spring in series with a dashpot (n,) N, for a force that is linear between fine steps."""
    step = TIME[-1] / (10 * (SAMPLES - 1))
    fine = motion.x(np.linspace(0.0, TIME[-1], 10 * (SAMPLES - 1) + 1))
    keep, force = np.exp(-step / time), np.zeros(fine.size)
    for k in range(1, fine.size):
        force[k] = keep * force[k - 1] + stiffness * time * (1.0 - keep) * (fine[k] - fine[k - 1]) / step
    return force[::10]


def line(frequency: float, amplitude: float, phase: float) -> Array:
    """A line (n,) N."""
    return amplitude * np.sin(2.0 * np.pi * frequency * TIME + phase)


def dataset(
    law: Callable[[Motion], Array] = plain,
    seed: int = 0,
    motions: Mapping[str, Motion] = MOTIONS,
    repeats: Mapping[str, str] | None = None,
    held_out: tuple[str, ...] = (),
    fault: Mapping[str, Callable[[Array], Array]] | None = None,
    noise: float = NOISE,
    settings: Mapping[str, Mapping[str, float]] | None = None,
    channels: Mapping[str, Mapping[str, Array]] | None = None,
    kind: str = "sweep",
) -> Dataset:
    """Runs in memory; ``repeats`` names what a run repeats, ``fault`` changes what the channel of a run shows.

    Further ``settings`` and ``channels`` are those of runs by name.
    """
    rng, runs, faults = np.random.default_rng(seed), [], fault or {}
    again = repeats or {}
    for number, (name, motion) in enumerate((motions | {new: motions[old] for new, old in again.items()}).items()):
        force = faults.get(name, lambda force: force)(law(motion)) + noise * rng.standard_normal(SAMPLES)
        shown = {"displacement": motion.x(), "force": force, **(channels or {}).get(name, {})}
        conditions = {"amplitude": motion.amplitude, "preload": motion.preload, **(settings or {}).get(name, {})}
        runs.append(
            Run(
                name,
                kind,
                TIME,
                shown,
                conditions,
                again.get(name),
                again.get(name, name),
                held_out=name in held_out,
                order=number,
            )
        )
    return Dataset("made", tuple(runs))


def with_force(data: Dataset, forces: Mapping[str, Array]) -> Dataset:
    """The dataset with other forces in some runs."""
    runs = [replace(run, channels={**run.channels, "force": forces.get(run.name, run.force)}) for run in data.runs]
    return replace(data, runs=tuple(runs))


@dataclass(frozen=True)
class Bench:
    """A network fitted to the training runs of a dataset."""

    setting: Setting
    refitter: Refitter
    model: Model
    groups: Mapping[str, str]
    data: Dataset


def bench(data: Dataset, text: str = NETWORK) -> Bench:
    """A network fitted to a dataset."""
    setting = prepare(data, 0)
    fit = fit_prepared(parse_network(text, REGISTRY.elements), setting, None, 0, 1, silent)
    refitter = Refitter(setting.train, REGISTRY.elements, noise=setting.floor.value or np.inf)
    groups = {run.name: run.cluster for run in data.runs}
    return Bench(setting, refitter, first_model(fit.declared, fit.fitted), groups, data)


def causes(*words: str) -> list[type[Cause]]:
    """Built-in causes by word."""
    return [REGISTRY.causes[word] for word in words]


def write(data: Dataset, folder: Path, sheet: str = "") -> Path:
    """The dataset as files: a table for each run, and ``dataset.yaml``.

    Channels beside motion and force are written as they are, ``sheet`` as the data sheet of the force channel.
    """
    folder.mkdir(parents=True, exist_ok=True)
    further = [name for name in data.runs[0].channels if name not in ("displacement", "force")]
    lines = [
        "format: dashpot-dataset/1",
        f"name: {data.name}",
        *([f"sensors: {{force: {sheet}}}"] if sheet else []),
        "defaults:",
        "  channels:",
        "    time: {column: time, unit: s}",
        "    displacement: {column: x, unit: mm}",
        "    force: {column: F, unit: N}",
        *(f"    {name}: {{column: {name}, unit: {UNITS[name]}}}" for name in further),
        "runs:",
    ]
    for run in data.runs:
        rows = [run.time, 1e3 * run.displacement, run.force, *(run.channels[name] for name in further)]
        header = ",".join(["time", "x", "F", *further])
        np.savetxt(folder / f"{run.name}.csv", np.column_stack(rows), "%.9g", ",", header=header, comments="")
        entry = f"  - {{name: {run.name}, file: {run.name}.csv, kind: {run.kind}"
        settings = ", ".join(f"{key}: {told(key, value)}" for key, value in run.settings.items())
        entry += f", settings: {{{settings}}}"
        entry += f", repeats: {run.repeats}" if run.repeats else ""
        entry += ", held_out: true" if run.held_out else ""
        lines.append(entry + "}")
    (folder / "dataset.yaml").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return folder / "dataset.yaml"


def told(setting: str, value: float) -> str:
    """A setting of a run with its unit; those of the motion in mm."""
    return f"{value:g} {UNITS[setting]}" if setting in UNITS else f"{1e3 * value:g} mm"
