"""A tire on a single-axis rig: quasi-static loops and 1-25 Hz sweeps at several amplitudes and preloads."""

from __future__ import annotations

from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING

from dashpot.contract.specimen import Specimen

if TYPE_CHECKING:
    from numpy.random import Generator

    from dashpot_specimens.rig_log import Record
    from dashpot_specimens.tire_path import DrivenPath

AMPLITUDES = (0.5e-3, 2e-3, 5e-3)
PRELOADS = (10e-3, 17e-3, 25e-3)
REPEATED = ((0.5e-3, 17e-3), (2e-3, 17e-3), (5e-3, 10e-3), (5e-3, 25e-3))
LOOP_DEPTH, LOOP_DURATION, LOOPS = 31e-3, 60.0, 3
SWEEP_DURATION, START, STOP = 10.0, 1.0, 25.0
AS_CSV = "a2_p17"

HEAD = """\
# seed {seed}
format: dashpot-dataset/1
name: test tire, single-axis hydropulser (virtual)
defaults:
  channels:
    time: {{column: t, unit: s}}
    displacement: {{column: x, unit: mm}}
    force: {{column: F, unit: N}}
  sensors:
    displacement: {{noise: 1 um}}
    force: {{gain: 0.2 %, zero: 3 N, delay: 50 us, noise: 9 N}}
runs:
"""
CSV_CHANNELS = """
    channels:
      time: {column: Time, unit: s}
      displacement: {column: Displacement, unit: mm}
      force: {column: Force, unit: kN}
"""


class TireOnRig(Specimen):
    """A progressive carcass, Iwan's sliders, and a stretched exponential relaxation that fades with the deflection."""

    word = "test_tire"
    about = "a tire at standstill: progressive carcass, sliding and relaxing rubber, less damping at high preload"
    demo = True
    networks = ("spring", "kelvin_voigt", "gehmann", "ftire", *(f"tire_model_{number}" for number in range(1, 6)))
    suspect = "kelvin_voigt"

    def measure(self, folder: Path, seed: int) -> Path:
        """Drive every run and write it down: a megabyte or two, in about a second.

        Raises FileExistsError where the folder holds a dataset of something else.
        """
        from dashpot_specimens.rig_log import is_measured

        head = HEAD.format(seed=seed)
        known = is_measured(folder, head, f"the test tire of seed {seed}")
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
    return _record(rng, path, 40, "qs.csv", f"  - name: qs\n    file: qs.csv\n    kind: quasi_static{CSV_CHANNELS}")


def _sweep(rng: Generator, name: str, amplitude: float, preload: float, repeats: str) -> Record:
    from dashpot_specimens import tire_path
    from dashpot_specimens.rig_log import sweep_settings

    path = tire_path.sweep(amplitude, preload, START, STOP, SWEEP_DURATION)
    settings = sweep_settings(amplitude, preload, START, STOP)
    if name == AS_CSV:
        entry = f"  - name: {name}\n    file: {name}.csv\n    kind: sweep\n    settings: {settings}{CSV_CHANNELS}"
        return _record(rng, path, 8, f"{name}.csv", entry)
    entry = f"  - {{name: {name}, file: {name}.npz, kind: sweep, settings: {settings}{repeats}}}\n"
    return _record(rng, path, 8, f"{name}.npz", entry)


def _record(rng: Generator, path: DrivenPath, every: int, file: str, entry: str) -> Record:
    """What the rig logs of a path at every so many steps."""
    import numpy as np

    from dashpot_specimens.rig_log import Record, add_noise
    from dashpot_specimens.tire_laws import Tire
    from dashpot_specimens.tire_path import STEP

    force = Tire().force(path)[::every]
    displacement, force = add_noise(rng, path.deflection[::every], force)
    return Record(file, entry, np.arange(force.size) * every * STEP, displacement, force)
