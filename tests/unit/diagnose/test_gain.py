"""The gain on runs that took no part."""

import numpy as np
import pytest

from dashpot.diagnose.folds import FEWEST
from dashpot.diagnose.gain import measure_gain

SINE = np.sin(2.0 * np.pi * np.arange(4000) / 200.0 - 0.1)


def gain(before, after, groups=None, seed=0):
    paths = {run: SINE[: values.size] for run, values in before.items()}
    return measure_gain(before, after, groups or {run: run for run in before}, paths, "held-out runs", seed)


def test_the_gain_is_one_minus_the_ratio_of_pooled_errors():
    """Runs weigh the same whatever their length."""
    found = gain({"a": np.full(1000, 3.0), "b": np.full(4000, 4.0)}, {"a": np.full(1000, 1.0), "b": np.full(4000, 2.0)})
    assert found.value == pytest.approx(1.0 - np.sqrt((1.0 + 4.0) / (9.0 + 16.0)))
    assert found.interval == pytest.approx((found.value, found.value))
    assert found.runs == "held-out runs"


def test_without_runs_there_is_no_gain():
    assert gain({}, {}) is None


def test_with_enough_groups_whole_groups_are_drawn():
    """Six runs whose own gains are 0.0 and 0.5 by turns: pieces of each would not scatter."""
    before = {f"r{k}": np.ones(400) for k in range(FEWEST)}
    after = {f"r{k}": np.full(400, 1.0 if k % 2 else 0.5) for k in range(FEWEST)}
    low, high = gain(before, after).interval
    assert low < 0.1 and high > 0.35
    few = {run: before[run] for run in ("r0", "r1")}
    found = gain(few, {run: after[run] for run in few})
    assert found.interval == pytest.approx((found.value, found.value))


def test_repeats_are_drawn_together():
    """Six runs in two groups are too few to be drawn."""
    before = {f"r{k}": np.ones(400) for k in range(6)}
    after = {f"r{k}": np.full(400, 1.0 if k % 2 else 0.5) for k in range(6)}
    found = gain(before, after, {run: str(int(run[1]) % 2) for run in before})
    assert found.interval == pytest.approx((found.value, found.value))


@pytest.mark.parametrize("runs", [1, FEWEST])
def test_the_interval_covers_the_gain_of_noise(runs):
    """Misfits that differ by noise alone: at least 30 of 40 intervals hold zero (95 %: P(fewer) = 3e-7)."""
    rng, held = np.random.default_rng(0), 0
    for draw in range(40):
        before, after = ({f"r{k}": rng.standard_normal(4000 // runs) for k in range(runs)} for _ in range(2))
        low, high = gain(before, after, seed=draw).interval
        held += low <= 0.0 <= high
    assert held >= 30
