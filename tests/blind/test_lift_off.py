"""A specimen that is pressed, not held: swept through its free position it leaves the platform."""

from pathlib import Path

import numpy as np
import pytest
from truth.design import Plan
from truth.folder import write_dataset
from truth.motion import at_samples, sweep

from dashpot import load_registry
from dashpot.data.dataset import read_dataset
from dashpot.diagnose.diagnose import diagnose
from dashpot.model.reading import read_network

STIFFNESS, DAMPING, NOISE = 190e3, 280.0, 8.0
SWEEPS = [Plan(f"a{a:g}_p{p:g}", 1e-3 * a, 1e-3 * p) for a in (1.0, 3.0, 5.0) for p in (2.0, 4.0, 12.0)]
AGAIN = [Plan(f"{plan.name}_b", plan.amplitude, plan.preload, repeats=plan.name) for plan in SWEEPS[4:7]]


def measured(folder: Path, seed: int, held: bool) -> Path:
    """Spring and damper on a platform; one that does not hold it shows no pull."""
    rng = np.random.default_rng(seed)
    runs = {}
    for plan in (*SWEEPS, *AGAIN):
        motion = sweep(plan.amplitude, plan.preload, 1.0, 25.0, 4.0)
        force = STIFFNESS * motion.displacement + DAMPING * motion.velocity
        force = at_samples(force if held else np.maximum(force, 0.0))
        runs[plan] = at_samples(motion.displacement), force + NOISE * rng.standard_normal(force.size)
    return write_dataset(folder, "press", runs)


@pytest.mark.parametrize("held", [True, False])
def test_lift_off_is_named_where_the_platform_does_not_hold_the_specimen(tmp_path, seed, held):
    registry = load_registry()
    readers = {word: reader() for word, reader in registry.formats.items()}
    dataset = read_dataset(measured(tmp_path, seed, held), readers)
    found = diagnose(read_network("kelvin_voigt", registry.elements), dataset, registry=registry).as_dict()
    print(found["verdict"], [(cause["cause"], cause["gain"]) for cause in found["causes"]], found["rmse"])
    assert [cause["cause"] for cause in found["causes"] if cause["accepted"]] == ([] if held else ["lift_off"])
    assert found["rmse"]["after"]["held_out"] < 1.05 * NOISE
