"""Facts of the particle swarm."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from dashpot.contract.optimizer import Space
from dashpot.fit.search import SearchResult, run_search
from dashpot_optimizers.pso import ParticleSwarm, reflect

SPACE = Space(("a", "b"), np.array([0.5, 0.2]))


def run(swarm: ParticleSwarm, worth) -> SearchResult:
    return run_search(swarm, worth, worth, SPACE, 1)


def test_default_is_the_swarm_of_96_in_200_iterations() -> None:
    values = iter(range(96 * 200, 0, -1))
    result = run(ParticleSwarm(), lambda points: np.array([float(next(values)) for _ in points]))
    assert result.evaluations == 96 * 200
    assert result.remark == "200 iterations done"


def test_ends_when_nothing_is_gained() -> None:
    result = run(ParticleSwarm(particles=10, stall=7), lambda points: np.ones(len(points)))
    assert result.evaluations == 10 * (1 + 7)
    assert result.remark == "no gain in 7 iterations"


def test_a_gain_of_less_than_a_millionth_counts_as_none() -> None:
    losses = iter(1.0 - 1e-8 * np.arange(1000))
    result = run(ParticleSwarm(particles=10, stall=7), lambda points: np.full(len(points), next(losses)))
    assert result.evaluations == 10 * (1 + 7)


@given(arrays(float, 3, elements=st.floats(0.0, 1.0)), arrays(float, 3, elements=st.floats(-1.0, 1.0)))
def test_reflected_particles_stay_inside_and_turn_round(places: np.ndarray, velocities: np.ndarray) -> None:
    moved, turned = reflect(places, velocities)
    free = places + velocities
    assert np.all((moved >= 0.0) & (moved <= 1.0))
    assert np.all(np.abs(turned) == np.abs(velocities))
    outside = (free < 0.0) | (free > 1.0)
    assert np.array_equal(turned != velocities, outside & (velocities != 0.0))
    assert np.allclose(moved, np.arccos(np.cos(np.pi * free)) / np.pi, atol=1e-7)


@pytest.mark.parametrize("particles", [2, 3, 7])
def test_a_ring_smaller_than_the_neighbourhood_works(particles: int) -> None:
    result = run(ParticleSwarm(particles=particles, neighbours=10), lambda points: np.sum(points**2, axis=1))
    assert result.loss < SPACE.start @ SPACE.start


@pytest.mark.parametrize(("option", "value"), [("particles", 1), ("iterations", 0), ("inertia", 1.5), ("stall", 0)])
def test_options_out_of_range_are_refused(option: str, value: float) -> None:
    with pytest.raises(ValueError, match=rf"^{option}: expected .* got {value}"):
        ParticleSwarm(**{option: value})
