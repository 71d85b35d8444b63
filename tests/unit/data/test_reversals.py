"""Where a noisy motion turns round; truth: triangles and sines whose turning points are known."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as some
from seeds import seed_of

from dashpot.data.reversals import noise_threshold, strokes, turning_points, typical_swing


@pytest.fixture
def random() -> np.random.Generator:
    seed = seed_of("test_reversals")
    return np.random.default_rng(seed)


@given(some.lists(some.floats(0.1, 5.0), min_size=1, max_size=8))
def test_a_zigzag_turns_where_its_ways_end(ways):
    stations = np.cumsum([0.0, *(way * (-1) ** number for number, way in enumerate(ways))])
    zigzag = np.interp(np.arange(50 * len(ways) + 1) / 50, np.arange(len(stations)), stations)
    found = turning_points(zigzag, 0.05)
    assert found.tolist() == [50 * number for number in range(1, len(ways))]
    np.testing.assert_allclose(strokes(zigzag, 0.05), ways)


def test_noise_makes_no_turning_points(random):
    turns = np.arange(20000) / 1000
    noisy = np.sin(2.0 * np.pi * turns) + random.normal(0.0, 0.01, 20000)
    found = turning_points(noisy, noise_threshold(noisy))
    assert len(found) == 40
    np.testing.assert_allclose(found / 1000, np.arange(40) / 2 + 0.25, atol=0.1)


def test_start_and_end_are_no_turning_points():
    assert len(turning_points(np.linspace(0.0, 1.0, 100), 0.1)) == 0
    assert len(turning_points(np.linspace(1.0, 0.0, 100), 0.1)) == 0
    assert len(turning_points(np.ones(100), 0.0)) == 0


def test_the_typical_swing_is_that_of_the_oscillation_and_not_of_a_ramp():
    sweep = 0.02 + 0.001 * np.sin(np.arange(20000) / 30)
    ramp = np.linspace(0.0, 0.02, 2000)
    assert typical_swing(np.concatenate([ramp, sweep, ramp[::-1]])) == pytest.approx(0.002, rel=1e-3)
    assert typical_swing(np.ones(100)) == 0.0
