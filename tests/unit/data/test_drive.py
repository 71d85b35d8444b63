"""The path between samples and where it turns."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import CubicHermiteSpline, make_interp_spline
from seeds import seed_of

from dashpot.data import drive as drive_module
from dashpot.data import interpolating
from dashpot.data.drive import drive_from_path, drive_from_samples, find_turns
from dashpot.text.problem import InputError

DT = 1e-3
TIME = DT * np.arange(1000)
OMEGA = 2.0 * np.pi * 11.0


@given(seed=st.integers(0, 2**32 - 1))
def test_turning_points_are_where_the_cubic_path_has_its_extrema(seed):
    rng = np.random.default_rng(seed)
    x, v = rng.standard_normal(30), rng.standard_normal(30) * 10.0 ** rng.uniform(-1.0, 4.0)
    step, place = find_turns(DT, x, v)
    path = CubicHermiteSpline(DT * np.arange(30), x, v)
    turns = path.derivative().roots(extrapolate=False)
    turns = np.array([t for t in turns if np.sign(path(t - 1e-9, 1)) != np.sign(path(t + 1e-9, 1))])
    inside = turns[np.abs(turns / DT - np.round(turns / DT)) > 1e-6]
    assert len(step) >= len(inside)
    found = {int(s): [] for s in step}
    for s, p in zip(step, place, strict=True):
        found[int(s)].append(p)
    room = 1e-9 * (1.0 + np.max(np.abs(x)) + np.max(np.abs(v)) * DT)
    for t in inside:
        assert min(abs(p - path(t)) for p in found[int(t / DT) + 1]) < room


def test_turning_points_come_in_the_order_of_time():
    # v(u) = (u - 0.2)(u - 0.7): up, down, up within one step
    x = np.array([0.0, DT * (1.0 / 3.0 - 0.9 / 2.0 + 0.14)])
    step, place = find_turns(DT, x, np.array([0.14, 0.24]))
    assert step.tolist() == [1, 1]
    assert place == pytest.approx([DT * (u**3 / 3.0 - 0.45 * u**2 + 0.14 * u) for u in (0.2, 0.7)], rel=1e-9)


def test_a_path_that_only_rests_for_a_moment_does_not_turn():
    # v(u) = (u - 0.5)^2
    step, _ = find_turns(DT, np.array([0.0, DT / 12.0]), np.array([0.25, 0.25]))
    assert step.size == 0


@pytest.mark.parametrize(("x", "v"), [([1.0, 1.0], [0.0, 0.0]), ([0.0, DT], [1.0, 1.0]), ([0.0, 2 * DT], [1.0, 3.0])])
def test_standing_still_and_going_straight_are_no_turning_points(x, v):
    assert find_turns(DT, np.array(x), np.array(v))[0].size == 0


def test_a_turn_at_constant_deceleration_is_found():
    step, place = find_turns(DT, np.array([0.0, 0.0]), np.array([1.0, -1.0]))
    assert step.tolist() == [1]
    assert place == pytest.approx([DT / 4.0])


def test_clean_samples_get_the_rates_of_a_spline():
    x = 2e-3 * np.sin(OMEGA * TIME)
    drive = drive_from_samples(DT, x)
    assert np.array_equal(drive.displacement, x)
    assert drive.velocity == pytest.approx(2e-3 * OMEGA * np.cos(OMEGA * TIME), abs=2e-6 * OMEGA)
    inside = slice(10, -10)
    expected = -2e-3 * OMEGA**2 * np.sin(OMEGA * TIME)
    assert drive.acceleration[inside] == pytest.approx(expected[inside], abs=1e-4 * 2e-3 * OMEGA**2)


def test_noisy_samples_are_smoothed():
    rng = np.random.default_rng(seed_of("test_drive"))
    x = 2e-3 * np.sin(OMEGA * TIME)
    noisy = x + 1e-6 * rng.standard_normal(TIME.size)
    drive = drive_from_samples(DT, noisy)
    inside = slice(30, -30)
    assert np.std((drive.displacement - x)[inside]) < 0.8e-6
    spline = drive_from_samples(DT, noisy, smooth=False)
    truth = 2e-3 * OMEGA * np.cos(OMEGA * TIME)
    assert np.std((drive.velocity - truth)[inside]) < 0.3 * np.std((spline.velocity - truth)[inside])
    assert np.array_equal(spline.displacement, noisy)


def test_smoothing_passes_what_a_rig_moves():
    for frequency in (1.0, 10.0, 25.0):
        omega = 2.0 * np.pi * frequency
        drive = drive_from_samples(DT, np.sin(omega * TIME), smooth=True)
        inside = slice(15, -15)
        assert drive.displacement[inside] == pytest.approx(np.sin(omega * TIME)[inside], abs=1e-5)
        assert drive.velocity[inside] == pytest.approx(omega * np.cos(omega * TIME)[inside], abs=1e-4 * omega)


@pytest.mark.parametrize("samples", [2, 3, 5, 6, 20])
def test_a_short_record_has_a_path_too(samples):
    drive = drive_from_samples(DT, 3.0 * DT * np.arange(samples))
    assert drive.samples == samples
    assert drive.velocity == pytest.approx(np.full(samples, 3.0))


def test_known_rates_are_kept():
    x, v, a = np.sin(TIME), np.cos(TIME), -np.sin(TIME)
    drive = drive_from_path(DT, x, v, a)
    assert drive.displacement is x and drive.velocity is v and drive.acceleration is a


def test_a_long_path_has_the_rates_of_the_spline_through_all_samples(monkeypatch):
    time = 1e-3 * np.arange(2500)
    x = 1e-3 * np.sin(90.0 * time) + 1e-4 * np.random.default_rng(4).standard_normal(time.size)
    spline = make_interp_spline(time, x, k=5)
    for module in (drive_module, interpolating):
        monkeypatch.setattr(module, "PIECE", 400)
    found = drive_from_samples(1e-3, x, smooth=False)
    assert found.velocity == pytest.approx(spline(time, 1), abs=1e-9 * np.ptp(spline(time, 1)))
    assert found.acceleration == pytest.approx(spline(time, 2), abs=1e-9 * np.ptp(spline(time, 2)))
    assert len(found.turn_step) > 1000
    monkeypatch.undo()
    whole = drive_from_samples(1e-3, x, smooth=False)
    assert np.array_equal(found.turn_step, whole.turn_step)
    assert found.turn_displacement == pytest.approx(whole.turn_displacement, abs=1e-12)


@pytest.mark.parametrize("samples", [0, 1])
def test_a_single_sample_is_no_motion(samples):
    with pytest.raises(InputError, match=f"expected a motion of two samples at least, got {samples}"):
        drive_from_samples(1e-3, np.zeros(samples))
    with pytest.raises(InputError, match=f"expected a motion of two samples at least, got {samples}"):
        drive_from_path(1e-3, *np.zeros((3, samples)))
