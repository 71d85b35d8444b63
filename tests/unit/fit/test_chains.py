"""Convergence of chains, against processes whose autocorrelation is known."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of

from dashpot.fit.chains import at_rest, autocorrelation_time, split_r_hat

MEMORY = 0.8
TIME = (1.0 + MEMORY) / (1.0 - MEMORY)  # of an autoregressive process


def autoregressive(steps: int, walkers: int, name: str) -> np.ndarray:
    """Chains (steps, walkers, 1) of variance one that remember ``MEMORY`` of the last step."""
    from scipy.signal import lfilter

    rng = np.random.default_rng(seed_of(name))
    noise = rng.standard_normal((steps, walkers)) * np.sqrt(1.0 - MEMORY**2)
    noise[0] /= np.sqrt(1.0 - MEMORY**2)
    return lfilter([1.0], [1.0, -MEMORY], noise, axis=0)[:, :, None]


def test_the_autocorrelation_time_is_that_of_the_process():
    draws = autoregressive(4000, 32, "chains")
    assert autocorrelation_time(draws)[0] == pytest.approx(TIME, rel=0.06)
    assert at_rest(draws).effective[0] == pytest.approx(4000 * 32 / TIME, rel=0.06)


def test_a_monotone_function_of_a_number_is_worth_as_much():
    draws = autoregressive(1000, 16, "chains2")
    some, other = at_rest(draws), at_rest(np.exp(5.0 * draws))
    assert other.time == pytest.approx(some.time, rel=1e-9)


def test_halves_that_agree_have_an_r_hat_that_their_length_tells():
    # the mean of n draws of a process scatters by time / n of its variance
    found = split_r_hat(autoregressive(2000, 64, "chains3"))[0]
    assert found - 1.0 == pytest.approx(TIME / 1000 / 2.0, rel=0.5)


@pytest.mark.parametrize("fault", ["a walker apart", "a drift", "a walker wider than the others"])
def test_what_is_not_at_rest_is_seen(fault):
    draws = autoregressive(2000, 8, "chains4")
    assert at_rest(draws).r_hat[0] < 1.01
    if fault == "a walker apart":
        draws[:, 0] += 2.0
    elif fault == "a drift":
        draws += np.linspace(0.0, 2.0, 2000)[:, None, None]
    else:
        draws[:, 0] *= 5.0
    assert at_rest(draws).r_hat[0] > 1.05


def test_independent_draws_have_a_time_of_one_step():
    rng = np.random.default_rng(seed_of("chains5"))
    assert at_rest(rng.standard_normal((2000, 16, 1))).time[0] == pytest.approx(1.0, abs=0.1)
