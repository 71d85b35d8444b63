"""Slow curves of an axle; truth: springs and sliders in closed form, and the laws of the virtual car."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of

from dashpot.data.axle_curves import SlowAxle, axle_curves, behind_tire, end_bias, slow_curve
from dashpot.data.loop import mean_loop
from dashpot_specimens.car_laws import STEP, Car, drive_car, tire_force
from dashpot_specimens.car_path import triangle

DT = 0.02
LOOPS = np.interp(np.arange(6001) % 2000, [0, 500, 1500, 2000], [0.0, 0.03, -0.03, 0.0])


@pytest.fixture
def random() -> np.random.Generator:
    seed = seed_of("test_axle_curves")
    return np.random.default_rng(seed)


def dahl(deflection: np.ndarray, limit: float, travel: float) -> np.ndarray:
    force = [0.0]
    for way in np.diff(deflection).tolist():
        side = np.copysign(limit, way)
        force.append(side + (force[-1] - side) * np.exp(-abs(way) / travel))
    return np.array(force)


def spring(deflection: np.ndarray) -> np.ndarray:
    return 24e3 * deflection + 90e3 * deflection * np.abs(deflection)


def test_the_ends_of_the_mid_line_are_freed_of_friction_whatever_its_law(random):
    sliders = [(random.uniform(20, 60), random.uniform(0.3e-3, 2e-3)) for _ in range(2)]
    force = spring(LOOPS) + sum(dahl(LOOPS, *each) for each in sliders)
    curve, loop = slow_curve(LOOPS, force, DT), mean_loop(LOOPS, force)
    wrong = np.abs(loop.middle - spring(loop.deflection)).max()
    assert wrong > 0.5 * sum(limit for limit, _ in sliders)
    assert np.abs(curve.force - spring(curve.deflection)).max() < 0.05 * wrong
    assert curve.friction == pytest.approx(sum(limit for limit, _ in sliders), rel=0.01)
    assert curve.speed == pytest.approx(0.12 / (2000 * DT), rel=0.02)


def test_without_friction_there_is_no_bias():
    assert np.abs(end_bias(mean_loop(LOOPS, spring(LOOPS)))).max() < 1e-9


def test_dampers_beside_the_friction_are_taken_off_at_their_speed():
    velocity = np.gradient(LOOPS, DT)
    curve = slow_curve(LOOPS, spring(LOOPS) + dahl(LOOPS, 40.0, 0.3e-3) + 3000.0 * velocity, DT, damping=3000.0)
    assert curve.friction == pytest.approx(40.0, rel=0.02)


def test_a_single_direction_is_refused():
    with pytest.raises(ValueError, match="expected a slow test in both directions"):
        slow_curve(np.linspace(0.0, 0.03, 500), np.linspace(0.0, 700.0, 500), DT)


@pytest.fixture(scope="module")
def car() -> Car:
    return Car()


@pytest.fixture(scope="module")
def slow(car) -> dict[float, tuple[SlowAxle, np.ndarray]]:
    """In phase (1) and in anti-phase (-1), with the motion of the platforms."""
    every = 200
    found = {}
    for side, depth in ((1.0, 40e-3), (-1.0, 20e-3)):
        path = triangle(-depth, depth, 40.0)
        answer = drive_car(car, np.array([path, side * path]), 0.0)
        wheels, forces = (tuple(answer[key][:, ::every]) for key in ("wheel", "force"))
        found[side] = SlowAxle(wheels, forces, every * STEP), np.array([path, side * path])[:, ::every]
    return found


def test_the_virtual_car_shows_its_springs_its_friction_and_its_bar(car, slow):
    slope = 0.5 * (car.rebound[0] + car.compression[0])
    curves = axle_curves(slow[1.0][0], slow[-1.0][0], damping=slope)
    for side in curves.suspension:
        middle = np.abs(side.deflection) < 0.9 * np.abs(side.deflection).max()
        z = side.deflection[middle]
        truth = car.spring * z + car.spring_hardening * z * np.abs(z)
        assert np.ptp(side.force[middle] - truth) < 0.01 * np.ptp(truth)
        dry = car.friction * (1.0 + (car.breakaway - 1.0) * np.exp(-side.speed / 0.03))
        assert side.friction == pytest.approx(dry, rel=0.03)
    assert curves.bar_rate == pytest.approx(car.bar, rel=0.01)
    assert curves.bar_friction == pytest.approx(car.bar_friction, abs=1.5)


def test_where_the_wheel_is_not_measured_the_tire_tells_its_motion(car, slow):
    axle, platforms = slow[1.0]
    path = triangle(0.0, 40e-3, 40.0)
    tire = slow_curve(path[::200], tire_force(car.tire, path)[::200], axle.sample_time)
    wheel = behind_tire(platforms[0], axle.forces[0], tire)
    found, truth = (slow_curve(each, axle.forces[0], axle.sample_time) for each in (wheel, axle.wheels[0]))
    assert found.rate == pytest.approx(truth.rate, rel=0.01)
    with pytest.raises(ValueError, match="expected contact forces within the tire's curve"):
        behind_tire(platforms[0], axle.forces[0] + 1e5, tire)
