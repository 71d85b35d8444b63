"""A hydraulic engine mount on a single-axis rig: slow loops and 1-30 Hz sweeps from 0.1 to 2 mm."""

from __future__ import annotations

from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING

from dashpot.contract.specimen import Specimen

if TYPE_CHECKING:
    from numpy.random import Generator

    from dashpot_specimens.rig_log import Record
    from dashpot_specimens.tire_path import DrivenPath

AMPLITUDES = (0.1e-3, 0.3e-3, 1e-3, 2e-3)
PRELOADS = (3e-3, 5e-3)
REPEATED = ((0.1e-3, 3e-3), (1e-3, 3e-3), (2e-3, 5e-3))
LOOP_DEPTH, LOOP_DURATION, LOOPS = 8e-3, 60.0, 3
SWEEP_DURATION, START, STOP = 12.0, 1.0, 30.0

HEAD = """\
# seed {seed}
format: dashpot-dataset/1
name: hydraulic test mount, single-axis rig (virtual)
defaults:
  channels:
    time: {{column: t, unit: s}}
    displacement: {{column: x, unit: mm}}
    force: {{column: F, unit: N}}
  sensors:
    displacement: {{noise: 0.2 um}}
    force: {{gain: 0.2 %, zero: 1 N, delay: 50 us, noise: 1 N}}
runs:
"""


class MountOnRig(Specimen):
    """Fluid with inertia, turbulence at the ends of its track and a plate with free travel, in chambers that bulge."""

    word = "test_mount"
    about = "a hydraulic engine mount: inertia track, turbulent losses, a plate with free travel, bulging rubber"
    networks = ("kelvin_voigt", "ubs", "eub", "engine_mount")
    suspect = "ubs"

    def measure(self, folder: Path, seed: int) -> Path:
        """Drive every run and write it down: a megabyte, in some seconds.

        Raises FileExistsError where the folder holds a dataset of something else.
        """
        from dashpot_specimens.rig_log import is_measured

        head = HEAD.format(seed=seed)
        known = is_measured(folder, head, f"the test mount of seed {seed}")
        return folder / "dataset.yaml" if known else _measure(folder, head, seed)


def _measure(folder: Path, head: str, seed: int) -> Path:
    import numpy as np

    from dashpot_specimens.rig_log import sweep_name, write_records

    rng = np.random.default_rng(seed)
    plans = [(sweep_name(*at), *at, "") for at in product(AMPLITUDES, PRELOADS)]
    repeats = [(f"{sweep_name(*at)}_b", *at, f", repeats: {sweep_name(*at)}") for at in REPEATED]
    return write_records(folder, head, [_loops(rng), *(_sweep(rng, *plan) for plan in plans + repeats)])


def _loops(rng: Generator) -> Record:
    from dashpot_specimens import tire_path

    path = tire_path.loops(LOOP_DEPTH, LOOP_DURATION, LOOPS)
    return _record(rng, path, 80, "qs.npz", "  - {name: qs, file: qs.npz, kind: quasi_static}\n")


def _sweep(rng: Generator, name: str, amplitude: float, preload: float, repeats: str) -> Record:
    from dashpot_specimens import tire_path
    from dashpot_specimens.rig_log import sweep_settings

    path = tire_path.sweep(amplitude, preload, START, STOP, SWEEP_DURATION)
    settings = sweep_settings(amplitude, preload, START, STOP)
    entry = f"  - {{name: {name}, file: {name}.npz, kind: sweep, settings: {settings}{repeats}}}\n"
    return _record(rng, path, 8, f"{name}.npz", entry)


def _record(rng: Generator, path: DrivenPath, every: int, file: str, entry: str) -> Record:
    """What the rig logs of a path at every so many steps."""
    import numpy as np

    from dashpot_specimens.mount_laws import Mount
    from dashpot_specimens.rig_log import Record, coloured_noise
    from dashpot_specimens.tire_path import STEP

    force = Mount().force(path)[::every]
    force = force + coloured_noise(rng, force.size, 1.0)
    displacement = path.deflection[::every] + 0.2e-6 * rng.standard_normal(force.size)
    return Record(file, entry, np.arange(force.size) * every * STEP, displacement, force)
