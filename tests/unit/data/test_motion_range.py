"""What of a motion counts as range of identification, against motions whose half cycles are known."""

from __future__ import annotations

import numpy as np
import pytest

from dashpot.data.drive import drive_from_path, drive_from_samples
from dashpot.data.motion_range import motion_range

DT = 1e-3


def sine(amplitude: float, frequency: float, preload: float = 0.0, duration: float = 2.0):
    rate = 2.0 * np.pi * frequency
    phase = rate * np.arange(round(duration / DT) + 1) * DT
    return drive_from_path(
        DT, preload + amplitude * np.sin(phase), amplitude * rate * np.cos(phase), -amplitude * rate**2 * np.sin(phase)
    )


def test_a_sine_has_one_amplitude_preload_and_frequency():
    found = motion_range([sine(2e-3, 5.0, 15e-3)])
    assert found["displacement"] == pytest.approx((13e-3, 17e-3), rel=1e-9)
    assert found["speed"] == pytest.approx((0.0, 2.0 * np.pi * 5.0 * 2e-3), rel=1e-9)
    assert found["amplitude"] == pytest.approx((2e-3, 2e-3), rel=1e-9)
    assert found["preload"] == pytest.approx((15e-3, 15e-3), rel=1e-9)
    assert found["frequency"] == pytest.approx((5.0, 5.0), rel=1e-9)


def test_runs_span_a_range_from_the_smallest_amplitude_on():
    found = motion_range([sine(1e-3, 2.0), sine(4e-3, 20.0, 10e-3)])
    # the crests of 20 Hz fall between samples: they are cut by 1 - cos(pi / 50) at most
    assert found["amplitude"] == pytest.approx((1e-3, 4e-3), rel=2e-3)
    assert found["preload"] == pytest.approx((0.0, 10e-3), abs=4e-3 * 2e-3)
    assert found["frequency"] == pytest.approx((2.0, 20.0), rel=0.05)


def test_ripple_far_below_the_amplitude_is_no_half_cycle():
    plain, ripple = sine(2e-3, 1.0), sine(5e-5, 40.0)
    both = drive_from_path(
        DT,
        plain.displacement + ripple.displacement,
        plain.velocity + ripple.velocity,
        plain.acceleration + ripple.acceleration,
    )
    assert motion_range([both])["frequency"] == pytest.approx((1.0, 1.0), rel=0.05)


def test_what_does_not_turn_has_a_displacement_and_a_speed_only():
    hold = drive_from_samples(DT, np.full(1000, 3e-3))
    assert motion_range([hold]) == {"displacement": pytest.approx((3e-3, 3e-3)), "speed": pytest.approx((0.0, 0.0))}


def test_noise_of_the_sensor_is_no_motion():
    noise = 2e-6 * np.random.default_rng(1).standard_normal(4001)
    moved = sine(1e-3, 2.0, duration=4.0).displacement + noise
    still = drive_from_samples(DT, 5e-3 + noise)
    found = motion_range([drive_from_samples(DT, moved), still])
    assert found["frequency"] == pytest.approx((2.0, 2.0), rel=0.1)


def test_a_motion_smaller_than_all_that_counts_tells_its_amplitude_nevertheless():
    assert motion_range([sine(1e-4, 5.0)], smallest=1e-3) == {
        "displacement": pytest.approx((-1e-4, 1e-4)),
        "speed": pytest.approx((0.0, 2.0 * np.pi * 5.0 * 1e-4)),
        "amplitude": pytest.approx((1e-4, 1e-4)),
    }
