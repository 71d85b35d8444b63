"""Velocities of sampled motions, clean, quantised and noisy, from 200 to 3 samples in a period, against known ones."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import make_interp_spline
from seeds import seed_of

from dashpot.data.drive import drive_from_samples
from dashpot.data.smoothing import HALF_WIDTHS, smooth_path

DT, COUNT, AMPLITUDE, PLACES, DEVIATION = 1e-3, 4000, 5e-3, 1e-6, 2e-6
INSIDE = slice(100, -100)
# samples in a period, and the error of the velocity of a clean sine that a spline leaves, with some room
PERIODS = {200: 1e-9, 50: 2e-9, 25: 1e-7, 16: 1e-6, 12: 1e-8, 10: 1e-8, 8: 1e-8, 6: 1e-7, 5: 1e-6, 4: 1e-5, 3: 1e-3}


def sine(period, rng):
    """Displacement and velocity, with a phase and a frequency between the lines of any spectrum."""
    angle = 2.0 * np.pi * np.arange(COUNT) / (period * rng.uniform(1.0, 1.02)) + rng.uniform(0.0, 2.0 * np.pi)
    omega = (angle[1] - angle[0]) / DT
    return AMPLITUDE * np.sin(angle), AMPLITUDE * omega * np.cos(angle)


def sweep(period):
    """From 1000 samples in a period to so many."""
    first, last = 2.0 * np.pi / 1000.0, 2.0 * np.pi / period
    rate = first + (last - first) * np.arange(COUNT) / COUNT
    angle = first * np.arange(COUNT) + 0.5 * (last - first) * np.arange(COUNT) ** 2 / COUNT
    return AMPLITUDE * np.sin(angle), AMPLITUDE * rate / DT * np.cos(angle)


def error(x, v, **how):
    return relative(drive_from_samples(DT, x, **how).velocity, v)


def relative(found, v):
    return np.sqrt(np.mean((found - v)[INSIDE] ** 2) / np.mean(v[INSIDE] ** 2))


@pytest.mark.parametrize("period", PERIODS)
def test_a_clean_motion_keeps_its_velocity(period):
    rng = np.random.default_rng(seed_of(f"rates {period}"))
    assert error(*sine(period, rng)) < PERIODS[period]
    assert error(*sweep(period)) < PERIODS[period]


@pytest.mark.parametrize("period", PERIODS)
def test_noise_and_steps_of_the_sensor_are_smoothed_where_that_brings_the_velocity_nearer(period):
    rng = np.random.default_rng(seed_of(f"noisy rates {period}"))
    for x, v in (sine(period, rng), sweep(period)):
        for spoilt in (PLACES * np.round(x / PLACES), x + DEVIATION * rng.standard_normal(COUNT)):
            time = DT * np.arange(COUNT)
            splines = [make_interp_spline(time, spoilt, k=degree)(time, 1) for degree in (5, 11)]
            spline, smoothed = min(relative(each, v) for each in splines), error(spoilt, v, smooth=True)
            # the choice is made from an estimate, and need not be right where both are alike
            assert error(spoilt, v) < 1.3 * min(spline, smoothed)
            assert period < 25 or error(spoilt, v) < 0.5 * spline


@pytest.mark.parametrize("count", [30, 127, 128, 150, 255])
@pytest.mark.parametrize("period", [20.0, 8.0, 4.0])
def test_a_short_clean_motion_keeps_its_velocity(count, period):
    angle = 2.0 * np.pi * np.arange(count) / period + 0.7
    found = drive_from_samples(DT, AMPLITUDE * np.sin(angle)).velocity[5:-5]
    truth = (AMPLITUDE * 2.0 * np.pi / (period * DT) * np.cos(angle))[5:-5]
    assert np.sqrt(np.mean((found - truth) ** 2) / np.mean(truth**2)) < {20.0: 2e-5, 8.0: 1e-4, 4.0: 8e-3}[period]


@pytest.mark.parametrize("count", [30, 60, 100, 127, 128, 200, 1000])
@pytest.mark.parametrize("period", [8.0, 5.0, 4.0, 3.5, 3.0])
def test_the_ends_of_a_clean_motion_are_as_good_as_its_middle(count, period):
    # of the velocity's RMS, over all samples: what the quintic and the spline of high degree leave of an endless sine
    quintic = {8.0: 6e-5, 5.0: 1.2e-3, 4.0: 6e-3, 3.5: 1.5e-2, 3.0: 5e-2}[period]
    allowed = quintic if count < 128 else {3.5: 2e-4, 3.0: 1e-3}.get(period, 3e-5)
    for phase in np.arange(0.1, 6.0, 0.7):
        angle = 2.0 * np.pi * np.arange(count) / period + phase
        found = drive_from_samples(DT, AMPLITUDE * np.sin(angle)).velocity
        truth = AMPLITUDE * 2.0 * np.pi / (period * DT) * np.cos(angle)
        assert np.sqrt(np.mean((found - truth) ** 2) / np.mean(truth**2)) < allowed


def test_the_ends_of_a_motion_that_no_sines_are_are_no_worse_than_those_of_the_spline():
    """In the mean over motions; of a single corner near an end chance decides."""
    rng, time, ratios = np.random.default_rng(seed_of("ends")), DT * np.arange(100), list[float]()
    for _ in range(20):
        angle = 2.0 * np.pi * np.arange(100) / rng.uniform(15.0, 40.0) + rng.uniform(0.0, 6.0)
        triangle, noisy = 2.0 / np.pi * np.arcsin(np.sin(angle)), np.sin(angle) + 1e-3 * rng.standard_normal(100)
        slope = np.sign(np.cos(angle)) * 2.0 / np.pi
        for x, v in ((triangle, slope), (noisy, np.cos(angle))):
            v = v * (angle[1] - angle[0]) / DT
            spline = make_interp_spline(time, x, k=5)(time, 1)
            found = drive_from_samples(DT, x).velocity
            ratios.append(float(np.mean((found - v) ** 2) / np.mean((spline - v) ** 2)))
    assert np.mean(ratios) < 1.0 and np.max(ratios) < 1.5


@pytest.mark.parametrize("count", [20, 60, 128, 300])
@pytest.mark.parametrize("share", [0.9, 0.5, 0.2, 0.01])
def test_a_shock_that_fades_from_the_first_sample_on_is_not_told_backwards(count, share):
    x = share ** np.arange(count)
    before = DT * np.log(share) / DT**2 * x
    spline = make_interp_spline(DT * np.arange(count), x, k=5)(DT * np.arange(count), 1)
    for path, truth, known in ((x, before, spline), (x[::-1], -before[::-1], -spline[::-1])):
        found = drive_from_samples(DT, path).velocity
        assert np.max(np.abs(found - truth)) < 1.01 * np.max(np.abs(known - truth)) + 1e-6 / DT


def random_motion(rng):
    """A hundred waves from 1 to 25 Hz."""
    omega, phase = 2.0 * np.pi * rng.uniform(1.0, 25.0, 100), rng.uniform(0.0, 2.0 * np.pi, 100)
    angle = np.outer(DT * np.arange(COUNT), omega) + phase
    return 0.1 * AMPLITUDE * np.sin(angle).sum(axis=1), 0.1 * AMPLITUDE * np.cos(angle) @ omega


def rounded_triangles(rng):
    """One a second; the corners last for some 20 ms."""
    angle = 2.0 * np.pi * DT * np.arange(COUNT) + rng.uniform(0.0, 2.0 * np.pi)
    slope = 0.998 * np.cos(angle) / np.sqrt(1.0 - (0.998 * np.sin(angle)) ** 2)
    return AMPLITUDE * np.arcsin(0.998 * np.sin(angle)), AMPLITUDE * 2.0 * np.pi * slope


@pytest.mark.parametrize("share", [1e-4, 1e-3, 1e-2])
@pytest.mark.parametrize("motion", [random_motion, rounded_triangles])
def test_a_noisy_motion_of_many_frequencies_gets_nearly_the_best_window(motion, share):
    rng = np.random.default_rng(seed_of(f"windows {motion.__name__} {share}"))
    x, v = motion(rng)
    noisy = x + share * np.std(x) * rng.standard_normal(COUNT)
    speeds = [smooth_path(DT, noisy, half)[1] for half in HALF_WIDTHS]
    errors = [np.sqrt(np.mean((speed - v)[INSIDE] ** 2) / np.mean(v[INSIDE] ** 2)) for speed in speeds]
    assert error(noisy, v) < 1.3 * min(errors) < 0.5 * errors[0]


def triangle(period, phase):
    u = (np.arange(COUNT) + phase) / period % 1.0
    return AMPLITUDE * np.where(u < 0.5, u, 1.0 - u), AMPLITUDE / period / DT * np.where(u < 0.5, 1.0, -1.0)


def ramps(period, phase):
    """Up and down again in three samples each, and at rest between."""
    at = (np.arange(COUNT) + phase) % period
    rising, falling = (at > 0.0) & (at < 3.0), (at > period / 2) & (at < period / 2 + 3.0)
    place = np.clip(at / 3.0, 0.0, 1.0) - np.clip((at - period / 2) / 3.0, 0.0, 1.0)
    return AMPLITUDE * place, AMPLITUDE / 3.0 / DT * (rising * 1.0 - falling * 1.0)


def bumps(period, phase):
    """The acceleration leaps."""
    angle = 2.0 * np.pi * (np.arange(COUNT) + phase) / period
    up, omega = np.maximum(np.sin(angle), 0.0), 2.0 * np.pi / period / DT
    return AMPLITUDE * up**2, AMPLITUDE * omega * 2.0 * up * np.cos(angle)


@pytest.mark.parametrize("phase", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("period", [1000.0, 333.3, 100.0])
@pytest.mark.parametrize("motion", [triangle, ramps, bumps])
def test_corners_ring_no_longer_than_those_of_the_quintic_spline(motion, period, phase):
    x, v = motion(period, phase)
    time = DT * np.arange(COUNT)
    quintic = make_interp_spline(time, x, k=5)(time, 1)
    assert drive_from_samples(DT, x).velocity == pytest.approx(quintic, abs=1e-9 * np.max(np.abs(v)))


@pytest.mark.parametrize("period", [6.0, 5.0, 4.0, 3.0])
def test_the_ends_of_a_fast_motion_are_no_worse_than_those_of_the_quintic_spline(period):
    time, errors = DT * np.arange(COUNT), []
    for phase in np.linspace(0.0, np.pi, 12, endpoint=False):
        angle = 2.0 * np.pi * np.arange(COUNT) / period + phase
        x, v = AMPLITUDE * np.sin(angle), AMPLITUDE * 2.0 * np.pi / period / DT * np.cos(angle)
        found = drive_from_samples(DT, x).velocity, make_interp_spline(time, x, k=5)(time, 1)
        errors.append([(velocity - v) ** 2 for velocity in found])
    own, quintic = np.sqrt(np.mean(errors, axis=0))
    # where errors of either sign happen to cancel, the quintic is better than it is inside
    allowed = 1.05 * np.maximum(quintic, np.median(quintic))
    assert np.all(own < allowed)
