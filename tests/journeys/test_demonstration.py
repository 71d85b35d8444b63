"""The demonstration finds what its specimen really does, and blames no sensor."""

from __future__ import annotations

import os

import pytest
from seeds import seed_of

import dashpot as dp
from dashpot import load_registry

SLIDING = {"friction", "amplitude_softening", "load_dependent_friction"}
RELAXING = {"relaxation", "preload_dependent_damping"}


@pytest.mark.slow
def test_sliding_and_relaxing_rubber_are_named_and_no_fault_of_the_measurement(tmp_path):
    """The laws of the virtual tire are those of no element: Iwan's sliders, a stretched exponential with a level."""
    seed = int(os.environ.get("DEMO_SEED") or seed_of("test_demonstration") % 65536)
    print(f"seed {seed}: DEMO_SEED={seed} repeats it")
    data = load_registry().specimens["test_tire"]().measure(tmp_path, seed)
    found = dp.diagnose("kelvin_voigt", dp.load_dataset(data), jobs=2).as_dict()
    named = {cause["cause"] for cause in found["causes"] if cause["standing"] in ("accepted", "probable")}
    assert named & SLIDING
    assert named & RELAXING
    assert named <= SLIDING | RELAXING
    assert "measurement" not in {cause["class"] for cause in found["causes"]}
    assert found["rmse"]["after"]["held_out"] < 1.3 * found["noise_floor"]["value"]


LADDER = ("spring", "kelvin_voigt", "gehmann", "ftire", *(f"tire_model_{k}" for k in range(1, 6)))


@pytest.mark.slow
@pytest.mark.parametrize("model", LADDER)
def test_no_model_of_the_ladder_accuses_the_rig(model, tmp_path):
    """Nothing is wrong with the virtual rig, whatever the model lacks."""
    seed = int(os.environ.get("DEMO_SEED") or seed_of(f"test_demonstration-{model}") % 65536)
    print(f"seed {seed}: DEMO_SEED={seed} repeats it")
    data = load_registry().specimens["test_tire"]().measure(tmp_path, seed)
    found = dp.diagnose(model, dp.load_dataset(data), jobs=2).as_dict()
    assert found["faults"] == []
    assert [cause["cause"] for cause in found["causes"] if cause["class"] == "measurement"] == []
