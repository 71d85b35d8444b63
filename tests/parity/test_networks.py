"""Compiled, interpreted and eager, every shipped network gives the same force."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from seeds import seed_of
from verification.shipped import NAMES, Dice, filled

from dashpot.data.drive import Drive
from dashpot.kernel.eager import simulate_eagerly, simulate_interpreted
from dashpot.kernel.network import compile_network
from dashpot.testing import MOTIONS, random_drive

LANES, SAMPLES = 5, 150
PRELOAD, AMPLITUDE = 15e-3, 6e-3
TOLERANCE = 1e-12


def preloaded(drive: Drive) -> Drive:
    places = {"displacement": drive.displacement + PRELOAD, "turn_displacement": drive.turn_displacement + PRELOAD}
    return replace(drive, **places)


@pytest.mark.parametrize("kind", MOTIONS)
@pytest.mark.parametrize("name", NAMES)
def test_all_ways_to_simulate_agree(name, kind):
    seed = seed_of("test_networks")
    print(f"seed {seed}")
    rng = np.random.default_rng(seed)
    spec = filled(name, Dice(seed))
    network = compile_network(spec)
    drive = preloaded(random_drive(rng, kind, AMPLITUDE, 1.0 / (2.0 * np.pi * rng.uniform(5.0, 25.0)), SAMPLES, 1e-3))
    values = network.start * np.exp(rng.uniform(-0.2, 0.2, (LANES, network.start.size)))
    eager = simulate_eagerly(spec, drive, values)
    scale = np.max(np.abs(eager), axis=1, keepdims=True)
    compiled = network.simulate(network.prepare(drive), values)
    assert np.isfinite(eager).all()
    assert np.max(np.abs(simulate_interpreted(spec, drive, values) - eager) / scale) <= TOLERANCE
    assert np.max(np.abs(compiled - eager) / scale) <= TOLERANCE


@pytest.mark.parametrize("name", NAMES)
def test_a_score_is_the_weighted_sum_of_squared_errors_of_the_simulated_force(name):
    seed = seed_of("test_networks2")
    print(f"seed {seed}")
    rng = np.random.default_rng(seed)
    network = compile_network(filled(name, Dice(seed)))
    drives = [preloaded(random_drive(rng, kind, AMPLITUDE, 0.01, SAMPLES + 40 * k)) for k, kind in enumerate(MOTIONS)]
    runs = [network.prepare(drive) for drive in drives]
    values = network.start * np.exp(rng.uniform(-0.2, 0.2, (70, network.start.size)))
    measured = [1e3 * rng.standard_normal(drive.samples) for drive in drives]
    weights = [rng.uniform(0.0, 1.0, drive.samples) for drive in drives]
    expected = [
        ((network.simulate(run, values) - target) ** 2) @ weight
        for run, target, weight in zip(runs, measured, weights, strict=True)
    ]
    for jobs in (1, 2):
        assert network.score(runs, measured, weights, values, jobs) == pytest.approx(np.array(expected), rel=1e-12)


def test_a_lane_is_bitwise_the_same_in_any_company():
    network = compile_network(filled("tire_model_5", Dice(7)))
    run = network.prepare(preloaded(random_drive(np.random.default_rng(7), "multisine", AMPLITUDE, 0.01, 400)))
    values = network.start * np.exp(np.random.default_rng(8).uniform(-0.2, 0.2, (131, network.start.size)))
    together = network.simulate(run, values)
    for lanes in ([0], [130], [3, 77], list(range(60, 131)), list(range(130, -1, -1))):
        assert np.array_equal(network.simulate(run, values[lanes]), together[lanes])


def test_a_lane_that_fails_does_not_touch_the_others():
    network = compile_network(filled("tire_model_5", Dice(9)))
    run = network.prepare(preloaded(random_drive(np.random.default_rng(9), "multisine", AMPLITUDE, 0.01, 400)))
    values = np.repeat(network.start[None], 20, axis=0)
    sound = network.simulate(run, values)
    values[3, network.paths.index("friction.limit")] = np.nan
    values[11, network.paths.index("stiffness.stiffness[2]")] = np.inf
    found = network.simulate(run, values)
    assert np.isnan(found[[3, 11], 1:]).all()
    assert np.array_equal(np.delete(found, [3, 11], axis=0), np.delete(sound, [3, 11], axis=0))
