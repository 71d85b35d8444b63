"""A spring curve from dynamic runs; truth: the spring, the damper and the slider the runs were made with."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of

from dashpot.data.start_curve import curve_from_sweeps

SAMPLE_TIME = 1e-3


@pytest.fixture
def random(request) -> np.random.Generator:
    return np.random.default_rng(seed_of(request.node.name))


def spring(displacement: np.ndarray) -> np.ndarray:
    return 180e3 * displacement + 1e6 * displacement**2


def run(preload: float, amplitude: float, random: np.random.Generator, stiffening: float = 0.0):
    """Sweep 1 to 25 Hz over spring, damper 100 N s/m and Coulomb friction 20 N, with 10 N of noise."""
    time = np.arange(10000) * SAMPLE_TIME
    angle = 2.0 * np.pi * (time + 1.2 * time**2)
    displacement = preload + amplitude * np.sin(angle)
    velocity = amplitude * np.cos(angle) * 2.0 * np.pi * (1.0 + 2.4 * time)
    force = spring(displacement) + stiffening * (displacement - preload) + 100.0 * velocity + 20.0 * np.sign(velocity)
    return displacement, velocity, force + random.normal(0.0, 10.0, len(time))


def test_overlapping_sweeps_give_curve_damper_and_friction(random):
    found = curve_from_sweeps([run(0.010, 4e-3, random), run(0.016, 4e-3, random), run(0.022, 4e-3, random)])
    np.testing.assert_allclose(found.force, spring(found.deflection), rtol=0.02)
    assert found.deflection[[0, -1]] == pytest.approx([0.006, 0.026], abs=1e-5)
    assert found.damping == pytest.approx(100.0, rel=0.08)
    assert found.friction == pytest.approx(20.0, rel=0.15)


def test_what_stiffens_around_every_preload_is_kept_out_of_the_curve(random):
    runs = [run(preload, 2e-3, random, stiffening=40e3) for preload in (0.010, 0.018, 0.026)]
    found = curve_from_sweeps(runs)
    np.testing.assert_allclose(found.force, spring(found.deflection), rtol=0.02)
    assert found.stiffening == pytest.approx(40e3, rel=0.1)


def test_a_gap_between_two_preloads_is_bridged(random):
    found = curve_from_sweeps([run(0.010, 1e-3, random), run(0.030, 0.5e-3, random)], knots=20)
    np.testing.assert_allclose(found.force, spring(found.deflection), rtol=0.02)
    assert np.all(np.diff(found.force) > 0.0)


def test_one_preload_cannot_tell_stiffening_from_slope(random):
    assert curve_from_sweeps([run(0.015, 3e-3, random, stiffening=40e3)]).stiffening == 0.0


@pytest.mark.parametrize("runs", [[], [(np.zeros(100), np.zeros(100), np.zeros(100))]])
def test_nothing_that_moves_is_refused(runs):
    with pytest.raises(ValueError, match="expected runs that move, got none; give a sweep"):
        curve_from_sweeps(runs)
