"""A low-pass of first order against its closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

from dashpot.kernel.lowpass import smoothed, smoothed_straight, weights

DT = 1e-3
TIME = DT * np.arange(2000)
OMEGA = 2.0 * np.pi * 7.0


def sine_behind(lag: float) -> np.ndarray:
    """What is left of sin(omega t) from rest at 0."""
    size = 1.0 + (OMEGA * lag) ** 2
    return (np.sin(OMEGA * TIME) - OMEGA * lag * (np.cos(OMEGA * TIME) - np.exp(-TIME / lag))) / size


@pytest.mark.parametrize("lag", [1e-9, 1e-5, 3e-4, 1e-3, 2e-2, 0.5, 30.0, 900.0])
def test_a_sine_comes_out_smaller_and_later(lag):
    found = smoothed(np.sin(OMEGA * TIME)[None], np.array([lag]), DT)[0]
    # the spline through 143 samples a period
    assert np.abs(found - sine_behind(lag)).max() < 2e-7


@pytest.mark.parametrize("lag", [1e-7, 1e-3, 0.3, 1e3])
def test_a_cubic_is_followed_exactly(lag):
    # lag * y' + y = u with y(0) = u(0): the particular solution u - lag u' + lag^2 u'' - lag^3 u''' and what fades
    u = np.polynomial.Polynomial([3.0, -2.0, 5.0, 1.0])
    rest = u - lag * u.deriv() + lag**2 * u.deriv(2) - lag**3 * u.deriv(3)
    expected = rest(TIME) + (u(0.0) - rest(0.0)) * np.exp(-TIME / lag)
    found = smoothed(u(TIME)[None], np.array([lag]), DT)[0]
    # the closed form itself loses digits where its terms are large
    assert np.abs(found - expected).max() < 1e-13 * max(30.0, np.abs(rest(TIME)).max())


@pytest.mark.parametrize("lag", [1e-7, 1e-3, 0.3, 1e3])
def test_between_samples_on_straight_lines_these_are_followed_exactly(lag):
    # lag * y' + y = b + a t with y(0) = b: b + a (t - lag (1 - exp(-t / lag)))
    expected = 3.0 - 2.0 * (TIME + lag * np.expm1(-TIME / lag))
    found = smoothed_straight(np.array([3.0 - 2.0 * TIME, np.full(TIME.size, 5.0)]), lag, DT)
    assert found[0] == pytest.approx(expected, abs=1e-12 * max(1.0, lag))
    assert found[1] == pytest.approx(np.full(TIME.size, 5.0), rel=1e-12)
    wave = np.sin(OMEGA * TIME)[None]
    # a chord is off by at most an eighth of the square of a step times the curvature
    assert (
        np.abs(smoothed_straight(wave, lag, DT) - smoothed(wave, np.array([lag]), DT)).max() < (OMEGA * DT) ** 2 / 8.0
    )
    assert smoothed_straight(wave, 0.0, DT) is wave


@pytest.mark.parametrize("steps", [1e-8, 1e-3, 0.5, 0.999, 1.0, 3.0, 500.0])
def test_the_weights_are_the_integrals_that_they_stand_for(steps):
    for power, found in enumerate(weights(steps)):
        # with r (1 - p) for the place, so that quadrature sees the steep end
        def integrand(s, power=power):
            return np.exp(-s) * (1.0 - s / steps) ** power

        expected = quad(integrand, 0.0, min(steps, 60.0), epsabs=0.0, epsrel=1e-13, limit=200)[0]
        assert found == pytest.approx(expected, rel=1e-11)


def test_every_lane_has_its_own_lag_and_what_is_not_finite_stays_away_from_others():
    values = np.stack([np.sin(OMEGA * TIME)] * 4)
    values[2, 5] = np.nan
    found = smoothed(values, np.array([0.0, 2e-2, 2e-2, np.nan]), DT)
    assert np.array_equal(found[0], values[0])
    assert found[1] == pytest.approx(sine_behind(2e-2), abs=2e-7)
    assert np.isnan(found[2:]).all()
    assert smoothed(values, np.zeros(1), DT) is values
