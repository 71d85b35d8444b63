"""The gain on held-out runs."""

import numpy as np
import pytest

from dashpot.assess.gain import measure_gain


def test_the_gain_is_one_minus_the_ratio_of_pooled_errors():
    """Runs weigh the same whatever their length."""
    before = [np.full(1000, 3.0), np.full(4000, 4.0)]
    after = [np.full(1000, 1.5), np.full(4000, 2.0)]
    found = measure_gain(before, after, [1e-3, 1e-3])
    assert found.value == pytest.approx(0.5)
    assert found.interval == pytest.approx((0.5, 0.5))


def test_the_interval_covers_the_gain_of_noise():
    """Misfits that differ by noise alone: at least 30 of 40 intervals hold zero (95 %: P(fewer) = 3e-7)."""
    rng = np.random.default_rng()
    draws = []
    for _ in range(40):
        before, after = rng.standard_normal((2, 5000))
        low, high = measure_gain([before], [after], [1e-3], seed=int(rng.integers(1 << 30))).interval
        draws.append(low <= 0.0 <= high)
    assert sum(draws) >= 30


def test_without_held_out_runs_there_is_no_gain():
    """None, not a number."""
    assert measure_gain([], [], []) is None
