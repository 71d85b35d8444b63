"""Noise models against processes whose colour is known."""

import numpy as np
import pytest
from scipy.signal import lfilter

from dashpot.assess.noise import ORDER, burg, flat_noise, learn_noise


def autoregressive(rng, coefficients, size):
    """A process x_t = sum a_k x_(t-k) + e_t with unit e, its start thrown away."""
    return lfilter([1.0], np.concatenate([[1.0], -np.asarray(coefficients)]), rng.standard_normal(size + 1000))[1000:]


def test_burg_finds_the_coefficients_of_an_autoregressive_process():
    """Second order, 100 000 samples: standard errors are about 0.003."""
    rng = np.random.default_rng()
    found = burg(autoregressive(rng, [1.2, -0.5], 100_000), 2)
    np.testing.assert_allclose(found, [1.0, -1.2, 0.5], atol=0.02)


@pytest.mark.parametrize("memory", [0.0, 0.9, 0.98])
def test_learned_noise_makes_its_own_process_white_and_of_unit_variance(memory):
    """The whitened process has no correlation left at lags within the order and a variance of one."""
    noise = 7.0 * autoregressive(np.random.default_rng(), [memory], 50_000)
    white = learn_noise({"run": noise}, {"run": 1e-3}).whiten("run", noise)[ORDER:]
    assert np.var(white) == pytest.approx(1.0, rel=0.05)
    lags = [np.mean(white[lag:] * white[:-lag]) for lag in range(1, ORDER)]
    assert np.max(np.abs(lags)) < 5.0 / np.sqrt(white.size)


def test_flat_noise_only_scales():
    """White noise of 2 N halves a signal; the samples without a past are set to zero."""
    signal = np.arange(20.0)
    white = flat_noise({"run": 2.0}).whiten("run", signal)
    np.testing.assert_allclose(white[ORDER:], signal[ORDER:] / 2.0)
    assert not white[:ORDER].any()


def test_nothing_smaller_than_the_resolution_is_taken_for_noise():
    """Silence, and rounding errors, are measured against the resolution."""
    for size in (0.0, 1e-9):
        found = learn_noise({"run": size * np.random.default_rng().standard_normal(500)}, {"run": 0.01})
        np.testing.assert_allclose(found.filters["run"], [100.0] + ORDER * [0.0])
