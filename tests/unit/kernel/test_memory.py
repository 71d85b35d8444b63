"""How much memory a score takes: none that grows with lanes times samples."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest
from unit.kernel.networks import compiled

from dashpot.kernel.network import CompiledNetwork
from dashpot.testing import random_drive

LANES, SAMPLES, DT = 96, 20_000, 1e-3
TIRE = """
    carcass: {element: spring, stiffness: 200 N/mm}
    rubber: {repeat: 3, element: maxwell, stiffness: 8 N/mm, relaxation_time: [160 ms, 32 ms, 6 ms]}
    filler: {repeat: 3, element: prandtl, stiffness: 9 N/mm, limit: [6 N, 20 N, 60 N]}
"""


@pytest.fixture
def peak():
    """What a call allocates at most, in bytes."""

    def measure(work) -> int:
        work()  # compiled and cached before
        tracemalloc.start()
        try:
            work()
            return tracemalloc.get_traced_memory()[1]
        finally:
            tracemalloc.stop()

    return measure


def test_a_score_stores_no_force(peak):
    network = compiled(TIRE)
    assert isinstance(network, CompiledNetwork)
    run = network.prepare(random_drive(np.random.default_rng(1), "sweep", DT, 5e-3, SAMPLES))
    values = np.repeat(network.start[None], LANES, axis=0)
    zero = np.zeros(SAMPLES)
    score = peak(lambda: network.score([run], [zero], [zero + 1.0], values))
    assert score < 0.05 * LANES * SAMPLES * 8
    assert peak(lambda: network.simulate(run, values)) > LANES * SAMPLES * 8


def test_twice_the_samples_take_no_more_memory_for_each_lane(peak):
    network = compiled(TIRE)
    found = []
    for samples in (SAMPLES, 2 * SAMPLES):
        run = network.prepare(random_drive(np.random.default_rng(1), "sweep", DT, 5e-3, samples))
        zero, one = np.zeros(samples), np.ones(samples)
        for lanes in (16, LANES):
            values = np.repeat(network.start[None], lanes, axis=0)
            found.append(peak(lambda: network.score([run], [zero], [one], values)))  # noqa: B023
    few, many, few_long, many_long = found
    assert abs((many_long - few_long) - (many - few)) < 0.01 * LANES * SAMPLES * 8
