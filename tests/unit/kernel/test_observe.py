"""How the load cell sees a force."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from seeds import seed_of

from dashpot.kernel.observe import Observation, read_observation

DT = 1e-3
TIME = DT * np.arange(400)


def channel(gain=1.0, offset=0.0, delay=0.0) -> Observation:
    return Observation(np.array([gain]), np.array([offset]), np.array([delay]))


def wave(time):
    return 100.0 * np.sin(2.0 * np.pi * 12.0 * time) + 30.0 * np.cos(2.0 * np.pi * 3.0 * time)


def test_a_plain_channel_shows_the_force_itself():
    force = wave(TIME)[None]
    assert channel().plain
    assert channel().see(force, DT) is force


def test_gain_and_offset_are_applied():
    assert channel(gain=1.1, offset=-20.0).see(wave(TIME)[None], DT)[0] == pytest.approx(1.1 * wave(TIME) - 20.0)


@pytest.mark.parametrize("delay", [0.4e-3, 1e-3, 7.3e-3, -2.6e-3])
def test_a_delay_shows_the_force_of_an_earlier_time(delay):
    seen = channel(delay=delay).see(wave(TIME)[None], DT)[0]
    inside = slice(20, -20)
    assert seen[inside] == pytest.approx(wave(TIME - delay)[inside], abs=2e-3)


def test_before_the_record_the_force_is_held():
    seen = channel(delay=5e-3).see(wave(TIME)[None], DT)[0]
    assert seen[:6] == pytest.approx(np.full(6, wave(0.0)))


@pytest.mark.parametrize("early", [0.4e-3, 1.4e-3, 2.6e-3])
def test_after_the_record_an_early_force_goes_on_as_the_motion_does(early):
    time = TIME[:342]  # ends on a rising flank
    seen = channel(delay=-early).see(wave(time)[None], DT)[0]
    bend = 100.0 * (2.0 * np.pi * 12.0) ** 2 + 30.0 * (2.0 * np.pi * 3.0) ** 2  # N/s^2, at most
    assert seen[-3:] == pytest.approx(wave(time + early)[-3:], abs=0.5 * bend * early**2)  # by Taylor
    held = abs(wave(time[-1]) - wave(time[-1] + early))
    assert abs(seen[-1] - wave(time[-1] + early)) < 0.2 * held


def test_after_the_record_an_early_force_stays_within_its_range():
    seen = channel(delay=-50e-3).see(wave(TIME)[None], DT)[0]
    assert seen.max() <= wave(TIME).max() and seen.min() >= wave(TIME).min()


def test_the_gain_is_applied_behind_the_delay_and_the_offset_behind_both():
    seen = channel(gain=2.0, offset=5.0, delay=3e-3).see(wave(TIME)[None], DT)[0]
    assert seen[10:] == pytest.approx(2.0 * wave(TIME)[7:-3] + 5.0, abs=1e-9)


def test_every_lane_has_its_own_channel():
    force = np.stack([wave(TIME), 2.0 * wave(TIME), 3.0 * wave(TIME)])
    seen = Observation(np.array([1.0, 2.0, 1.0]), np.array([0.0, 0.0, 7.0]), np.array([0.0, 1e-3, 0.0])).see(force, DT)
    assert seen[0] == pytest.approx(force[0])
    assert seen[1, 1:] == pytest.approx(2.0 * force[1, :-1], abs=1e-9)
    assert seen[2] == pytest.approx(force[2] + 7.0)


def test_a_lane_that_failed_stays_nan_and_does_not_stop_the_others():
    force = np.stack([wave(TIME), np.where(TIME > 0.2, np.nan, 1.0), wave(TIME)])
    delays = np.array([1e-3, 1e-3, np.nan])
    seen = Observation(np.ones(3), np.zeros(3), delays).see(force, DT)
    assert np.isfinite(seen[0]).all()
    assert np.isnan(seen[1:]).all()


def test_the_channel_is_read_from_the_values_of_each_lane():
    paths = ("a.stiffness", "measurement.force.delay", "measurement.force.offset")
    found = read_observation(paths, np.array([[5.0, 1e-3, -2.0], [6.0, 0.0, 0.0]]))
    assert (found.delay.tolist(), found.offset.tolist(), found.gain.tolist()) == ([1e-3, 0.0], [-2.0, 0.0], [1.0, 1.0])
    assert not found.plain
    assert read_observation(("a.stiffness",), np.array([[5.0]])).plain


def test_a_specimen_that_is_not_held_shows_no_pull():
    held = read_observation(("measurement.force.least",), np.array([[0.0], [-50.0]]))
    force = np.stack([wave(TIME), wave(TIME)])
    assert held.see(force, DT) == pytest.approx(np.stack([np.maximum(wave(TIME), 0.0), np.maximum(wave(TIME), -50.0)]))
    assert not held.plain


def test_small_changes_of_a_force_that_is_not_shown_are_not_shown():
    held = read_observation(("measurement.force.least",), np.array([[0.0]]))
    _, *changes = held.linear(np.vstack([wave(TIME), np.ones((2, TIME.size))]), DT)
    assert changes == pytest.approx(np.broadcast_to(wave(TIME) > 0.0, (2, TIME.size)).astype(float))


def along_the_spline(row, then):
    """Held before the first sample, along the tangent within the range of the row after the last one."""
    spline, last = CubicSpline(np.arange(row.size), row), row.size - 1
    tangent = np.clip(row[-1] + spline(last, 1) * (then - last), row.min(), row.max())
    return np.where(then > last, tangent, spline(np.clip(then, 0.0, last)))


@pytest.mark.parametrize("samples", [2, 3, 4, 5, 6, 400])
def test_each_lane_is_shifted_along_its_own_cubic_spline(samples):
    rng = np.random.default_rng(seed_of("test_observe"))
    force, delay = rng.standard_normal((4, samples)).cumsum(axis=1), rng.uniform(-3e-3, 3e-3, 4)
    delay[2] = 0.0
    at = np.arange(samples)
    expected = [along_the_spline(row, at - late / 1e-3) for row, late in zip(force, delay, strict=True)]
    seen = Observation(np.ones(4), np.zeros(4), delay).see(force, 1e-3)
    assert seen == pytest.approx(np.array(expected), abs=1e-9 * np.abs(force).max())
    force[1, -1] = np.nan
    assert np.isnan(Observation(np.ones(4), np.zeros(4), delay).see(force, 1e-3)).any(axis=1).tolist() == [0, 1, 0, 0]


def test_what_is_behind_a_low_pass_is_smaller_and_later():
    lag, omega = 4e-3, 2.0 * np.pi * 12.0
    seen = read_observation(("measurement.force.lag",), np.array([[lag]])).see(np.sin(omega * TIME)[None], DT)[0]
    settled = TIME > 20 * lag
    expected = np.sin(omega * TIME - np.arctan(omega * lag)) / np.hypot(1.0, omega * lag)
    assert seen[settled] == pytest.approx(expected[settled], abs=2e-6)


def test_nothing_above_the_range_is_shown_whatever_the_force_is():
    paths = ("measurement.force.gain", "measurement.force.offset", "measurement.force.largest")
    found = read_observation(paths, np.array([[2.0, 30.0, 90.0]]))
    assert found.see(wave(TIME)[None], DT)[0] == pytest.approx(np.minimum(2.0 * wave(TIME) + 30.0, 90.0))
    assert not found.plain


def test_hum_is_added_by_the_time_of_the_run():
    paths = tuple(f"measurement.force.hum.{key}" for key in ("frequency", "cosine", "sine"))
    found = read_observation(paths, np.array([[50.0, 3.0, -4.0], [60.0, 0.0, 2.0]]))
    force = np.stack([wave(TIME), wave(TIME)])
    first = 3.0 * np.cos(100.0 * np.pi * TIME) - 4.0 * np.sin(100.0 * np.pi * TIME)
    second = 2.0 * np.sin(120.0 * np.pi * TIME)
    assert found.see(force, DT) - force == pytest.approx(np.stack([first, second]), abs=1e-11)


def test_small_changes_go_through_the_whole_channel():
    keys, numbers = ("gain", "offset", "lag", "delay"), [1.7, 11.0, 6e-3, 2e-3]
    # between samples a chord is off by at most an eighth of the square of a step times the curvature
    chord = 1.7 * (9.0 * DT) ** 2 / 8.0
    assert derivative_error(keys, numbers).max() < 1e-6 + chord
    # where the range begins a change jumps, and the spline through the jump is what is simulated: one per cent of it
    assert derivative_error((*keys, "least", "largest"), [*numbers, -60.0, 120.0]).max() < 0.01 * 1.7


def derivative_error(keys, numbers):
    """How far the linear channel is from a difference of the whole one, for a change that is cos(9 t)."""
    found = read_observation(tuple(f"measurement.force.{key}" for key in keys), np.array([numbers]))
    change = np.cos(9.0 * TIME)[None]
    step = 1e-4
    forward, back = (found.see(wave(TIME)[None] + side * step * change, DT) for side in (0.5, -0.5))
    linear = found.linear(np.vstack([wave(TIME), change]), DT)
    assert linear[0] == pytest.approx(found.see(wave(TIME)[None], DT)[0])
    return np.abs(linear[1] - (forward - back)[0] / step)
