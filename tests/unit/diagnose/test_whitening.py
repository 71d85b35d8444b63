"""Noise against processes whose colour is known, and what averaging keeps."""

import numpy as np
import pytest
from scipy.signal import lfilter

from dashpot.diagnose.whitening import (
    ORDER,
    Noise,
    covariance_of,
    filter_of,
    independent_share,
    lagged,
    learn_filter,
    orthonormal,
    reduction,
)


def autoregressive(coefficients, size, seed=0):
    """A process x_t = sum a_k x_(t-k) + e_t with unit e, its start thrown away."""
    noise = np.random.default_rng(seed).standard_normal(size + 1000)
    return lfilter([1.0], np.concatenate([[1.0], -np.asarray(coefficients)]), noise)[1000:]


@pytest.mark.parametrize("coefficients", [[0.0], [0.9], [0.98], [1.2, -0.5]])
def test_filtered_noise_is_white_and_of_unit_variance(coefficients):
    noise = 7.0 * autoregressive(coefficients, 50_000)
    white = Noise({"run": 1}, {"run": learn_filter(noise, 1e-9)}).whiten("run", noise)[ORDER:]
    assert np.var(white) == pytest.approx(1.0, rel=0.02)
    lags = [np.mean(white[lag:] * white[:-lag]) for lag in range(1, ORDER)]
    assert np.max(np.abs(lags)) < 5.0 / np.sqrt(white.size)


def test_the_filter_of_an_autoregressive_process_is_its_own():
    """Second order, 100 000 samples: standard errors are about 0.003."""
    found = learn_filter(autoregressive([1.2, -0.5], 100_000), 1e-9)
    assert found == pytest.approx([1.0, -1.2, 0.5, *[0.0] * (ORDER - 2)], abs=0.02)


def test_nothing_smaller_than_the_resolution_is_taken_for_noise():
    for size in (0.0, 1e-9):
        found = learn_filter(size * np.random.default_rng(0).standard_normal(500), 0.01)
        assert found[0] == pytest.approx(100.0)
        assert np.abs(found[1:]).max() < 1e-6


def test_a_run_too_short_for_its_colour_has_white_noise():
    found = learn_filter(np.array([1.0, -1.0, 1.0, -1.0]), 1e-9)
    assert found == pytest.approx([1.0, *[0.0] * ORDER])


def test_averages_keep_the_deviation_of_white_noise_and_the_inner_products_of_slow_signals():
    noise, slow = np.random.default_rng(0).standard_normal(60_003), np.sin(2e-3 * np.arange(60_003))
    reduced = Noise({"run": 6}).reduce("run", np.array([noise, slow]))
    assert reduced.shape == (2, 10_000)
    assert np.std(reduced[0]) == pytest.approx(1.0, rel=0.02)
    assert reduced[1] @ reduced[1] == pytest.approx(slow @ slow, rel=1e-3)
    assert Noise({"run": 6}).kept("run", 60_003) == 10_000


def test_rows_are_filtered_apart_and_the_first_values_have_no_past():
    rows = np.random.default_rng(1).standard_normal((3, 50))
    coefficients = np.array([0.5, -0.3, 0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.05])
    found = Noise({"run": 1}, {"run": coefficients}).filter("run", rows)
    expected = np.array([[coefficients @ row[n - ORDER : n + 1][::-1] for n in range(ORDER, 50)] for row in rows])
    assert found[:, ORDER:] == pytest.approx(expected)
    assert not found[:, :ORDER].any()


def test_the_fifth_harmonic_of_the_driven_band_stays():
    """At 1 kHz and 10 Hz: averages over ten samples, 100 Hz, hold 50 Hz."""
    assert reduction(1e-3, 10.0) == 10
    assert reduction(1e-3, 500.0) == 1


def test_a_line_beyond_the_band_of_the_blocks_is_not_taken_for_its_alias():
    """Blocks of 8 ms hold up to 62.5 Hz: 50 Hz is there, 150 Hz would look like 25 Hz."""
    angle = 2.0 * np.pi * 2e-3 * np.arange(1000)
    reduced = Noise({"run": 4}).reduce_shapes("run", np.array([np.sin(50.0 * angle), np.sin(150.0 * angle)]))
    assert reduced[0].any() and not reduced[1].any()


def test_white_noise_asks_for_no_past():
    found = Noise({"run": 1}).with_white({"run": 2.0}).whiten("run", np.arange(4.0))
    assert found == pytest.approx([0.0, 0.5, 1.0, 1.5])


def test_all_values_of_white_noise_are_independent():
    assert independent_share(np.random.default_rng(1).standard_normal(20_000)) == pytest.approx(1.0, abs=0.05)


def test_values_that_remember_count_as_fewer():
    """The sum of the squared autocorrelation of an autoregression of first order is (1 + a^2) / (1 - a^2)."""
    assert independent_share(autoregressive([0.9], 100_000)) == pytest.approx(0.19 / 1.81, rel=0.1)


def test_a_wave_has_a_few_independent_values_however_long_it_is():
    time = np.arange(10_000) / 1000.0
    assert 10_000 * independent_share(np.sin(2.0 * np.pi * 5.0 * time)) == pytest.approx(4.0)


@pytest.mark.parametrize("columns", [40, 200])
def test_what_a_fit_takes_of_the_noise_is_given_back_at_every_lag(columns):
    """Of 500 white samples a fit takes the slowest tenth or two fifths; over 200 draws their mean is white again."""
    place = np.arange(500)
    basis = orthonormal(np.array([np.cos(np.pi * (place + 0.5) * k / 500) for k in range(columns)]))
    noise = 3.0 * np.random.default_rng(2).standard_normal((200, 500))
    found = np.mean([covariance_of(rest, lagged(basis) / 500) for rest in noise - noise @ basis.T @ basis], axis=0)
    assert found == pytest.approx([9.0, *[0.0] * ORDER], abs=5.0 * 9.0 / np.sqrt(500 * 200))
    left = noise[0] - noise[0] @ basis.T @ basis
    assert learn_filter(left, 1e-9)[1:].any(), "as it is, what is left is not white"
    assert not filter_of(covariance_of(left, lagged(basis) / 500), 500, 1e-9)[1:].any()


def test_pairs_of_samples_add_up_over_blocks_that_begin_with_what_was_before_them():
    basis = orthonormal(np.random.default_rng(3).standard_normal((5, 100)))
    blocks = lagged(basis[:, :60]) + lagged(basis[:, 60 - ORDER :], ORDER)
    assert blocks == pytest.approx(lagged(basis), abs=1e-12)
    assert lagged(basis)[:2] == pytest.approx([5.0, np.sum(basis[:, 1:] * basis[:, :-1])])


def test_an_autocovariance_that_no_noise_has_is_cut_off():
    """Beyond a lag at which the correlation with what is known would exceed one."""
    found = filter_of(np.array([1.0, 0.5, -0.9, *[0.0] * (ORDER - 2)]), 1000, 1e-9)
    assert found == pytest.approx(np.array([1.0, -0.5, *[0.0] * (ORDER - 1)]) / np.sqrt(0.75))
