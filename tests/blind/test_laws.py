"""Laws of dampers, struts and mounts as their textbooks write them, each hidden in a spring and a damper.

Nothing of the elements is used: curves, powers and exponentials in closed form, states integrated by themselves on the
fine grid of the rig.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from truth.design import Plan
from truth.folder import write_dataset
from truth.motion import STEP, Motion, at_samples, sweep

from dashpot import load_registry
from dashpot.data.dataset import read_dataset
from dashpot.diagnose.diagnose import diagnose
from dashpot.model.reading import parse_network

Array = np.ndarray
Law = Callable[[Motion, float], Array]

STIFFNESS, DAMPING, NOISE = 60e3, 900.0, 4.0
CURRENTS = (0.0, 0.5, 1.0)  # A, of the runs in turn
CONDITIONS = [(a, p) for p in (6.0, 10.0, 14.0) for a in (1.5, 3.0, 5.0)]
MODEL = """\
format: dashpot-network/1
name: strut
branches:
  spring: {element: spring, stiffness: {start: 50 N/mm}}
  damper: {element: damper, damping: {start: 500 N*s/m}}
"""


def magnetorheological(motion: Motion, current: float) -> Array:
    """A damping that saturates with the current."""
    return 1200.0 * np.tanh(current / 0.7) * motion.velocity


def blow_off(motion: Motion, current: float) -> Array:
    """Two hyperbolas, steep up to the blow-off of each side, flat behind it."""
    v = motion.velocity
    knee, most = np.where(v > 0.0, 0.06, 0.1), np.where(v > 0.0, 150.0, 420.0)
    return most * (v / knee) / np.sqrt(1.0 + (v / knee) ** 2)


def gas(motion: Motion, current: float) -> Array:
    """Nitrogen behind a piston: constant pressure times volume to the 1.25."""
    return 300.0 * (1.0 - motion.displacement / 32e-3) ** -1.25


def lip_seal(motion: Motion, current: float) -> Array:
    """Friction of a lip that grips one way."""
    return np.where(motion.velocity > 0.0, 55.0, 20.0) * np.tanh(motion.velocity / 1e-3)


def side_load(motion: Motion, current: float) -> Array:
    """Friction of a rod that is bent to both sides of the middle."""
    return (10.0 + 9e3 * np.abs(motion.displacement - 10e-3)) * np.tanh(motion.velocity / 1e-3)


def foaming(motion: Motion, current: float) -> Array:
    """Oil that foams: a part of the damping is gone like one over the time."""
    return 900.0 * motion.velocity / (1.0 + motion.time / 1.2)


def rattling(motion: Motion, current: float) -> Array:
    """A weight of 0.3 kg between stops 0.4 mm to either side, stiff and damped, carried along."""
    place, speed, found = 0.0, 0.0, np.empty(motion.time.size)
    for number, a in enumerate(motion.acceleration.tolist()):
        beyond = max(abs(place) - 0.4e-3, 0.0) * np.sign(place)
        contact = 60e3 * beyond + (15.0 * speed if beyond else 0.0)
        speed += STEP * (-a - contact / 0.3)
        place += STEP * speed
        found[number] = -contact
    return found


CASES = {
    "setting_dependence": magnetorheological,
    "valve": blow_off,
    "gas_spring": gas,
    "friction": lip_seal,
    "load_dependent_friction": side_load,
    "fading_damping": foaming,
    "loose_mass": rattling,
}


def measured(folder: Path, seed: int, law: Law) -> Path:
    """Nine sweeps and two repeats; the current is written into the settings of the runs."""
    rng = np.random.default_rng(seed)
    runs, currents = {}, {}
    for number, (amplitude, preload) in enumerate([*CONDITIONS, CONDITIONS[4], CONDITIONS[8]]):
        again = number >= len(CONDITIONS)
        name = f"a{amplitude:g}_p{preload:g}"
        plan = Plan(name + "_b" * again, 1e-3 * amplitude, 1e-3 * preload, repeats=name if again else None)
        # neither the stroke nor the middle of a run tells its current
        currents[plan.name] = CURRENTS[(CONDITIONS.index((amplitude, preload)) + int(preload / 4.0)) % 3]
        motion = sweep(1e-3 * amplitude, 1e-3 * preload, 1.0, 18.0, 4.0)
        force = STIFFNESS * motion.displacement + DAMPING * motion.velocity + law(motion, currents[plan.name])
        seen = at_samples(force)
        runs[plan] = at_samples(motion.displacement), seen + NOISE * rng.standard_normal(seen.size)
    path = write_dataset(folder, "strut", runs)
    lines = path.read_text().splitlines(keepends=True)
    path.write_text("".join(_with_current(line, currents) for line in lines))
    return path


def _with_current(line: str, currents: dict[str, float]) -> str:
    told = [current for name, current in currents.items() if f"name: {name}," in line]
    return line.replace("settings: {", f"settings: {{current: {told[0]} A, ") if told else line


@pytest.mark.slow
@pytest.mark.parametrize(("word", "law"), CASES.items(), ids=list(CASES))
def test_the_law_is_the_cause_that_is_worth_most(tmp_path, seed, word, law):
    """Beside it others may be named: the laws are none of those that are looked for, but for the physics."""
    registry = load_registry()
    readers = {each: reader() for each, reader in registry.formats.items()}
    dataset = read_dataset(measured(tmp_path, seed, law), readers)
    model = parse_network(MODEL, registry.elements)
    found = diagnose(model, dataset, jobs=2, registry=registry).as_dict()
    print(found["verdict"], [(cause["cause"], cause["gain"]) for cause in found["causes"]], found["rmse"])
    most = max(found["causes"], key=lambda cause: cause["gain"] or 0.0, default={"cause": "nothing"})
    assert most["cause"] == word
