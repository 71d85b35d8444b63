"""Friction with a limit for each direction, and with one that grows away from a middle."""

from __future__ import annotations

import numpy as np
import pytest
from verification.alone import last_cycle
from verification.test_elements_with_memory import AMPLITUDE, TURNS, march, place, relative, speed
from verification.truth.elements import integrate


@pytest.mark.parametrize("exponent", [1.0, 2.0])
def test_friction_by_direction_solves_its_equation(exponent):
    numbers = {"stiffness": 6e4, "compression": 12.0, "rebound": 30.0, "exponent": exponent}

    def rate(t, force):
        side = np.sign(speed(t))
        u = 1.0 - side * force / (12.0 if side > 0.0 else 30.0)
        return 6e4 * speed(t) * np.abs(u) ** exponent * np.sign(u)

    time, found = march("directional_friction", 1e-3, 2.0, **numbers)
    assert relative(found, integrate(rate, [0.0], time, TURNS)[0]) < 2e-6


def test_friction_by_direction_comes_to_rest_at_its_limit_with_an_exponent_below_one():
    """With the exponent 1/2 the root of u falls in proportion to the way, until the slider slides."""
    stiffness, limits = 6e4, {1.0: 12.0, -1.0: 30.0}
    time, found = march(
        "directional_friction", 1e-3, 2.0, stiffness=stiffness, compression=12.0, rebound=30.0, exponent=0.5
    )
    force, begin = np.zeros(time.size), 0.0
    turns = [0.0, *TURNS[TURNS < time[-1]], time[-1]]
    for start, end in zip(turns, turns[1:], strict=False):
        side = float(np.sign(speed(0.5 * (start + end))))
        limit, inside = limits[side], (time >= start) & (time <= end)
        way = side * (place(np.append(time[inside], end)) - place(start))
        root = np.maximum(np.sqrt(1.0 - side * begin / limit) - 0.5 * stiffness * way / limit, 0.0)
        *force[inside], begin = side * limit * (1.0 - root**2)
    assert relative(found, force) < 2e-6


def test_with_equal_limits_it_is_a_dahl_slider():
    _, found = march("directional_friction", 1e-3, stiffness=6e4, compression=12.0, rebound=12.0)
    _, dahl = march("dahl", 1e-3, stiffness=6e4, limit=12.0)
    assert relative(found, dahl) < 1e-12


def test_sliding_to_and_fro_takes_the_work_of_both_limits_and_leaves_half_their_difference():
    _, x, force = last_cycle(
        "directional_friction", 5e-3, 1.0, 3, 4000, stiffness=1e8, compression=20.0, rebound=50.0, exponent=0.0
    )
    work = np.sum(0.5 * (force + np.roll(force, 1)) * (x - np.roll(x, 1)))
    assert work == pytest.approx(2.0 * 5e-3 * (20.0 + 50.0), rel=1e-3)
    assert np.mean(force) == pytest.approx(0.5 * (20.0 - 50.0), rel=1e-2)


def test_rounded_friction_by_direction_follows_its_curve():
    """tanh from its exponentials, with the limit of each direction; with equal ones it is that of both."""
    numbers = {"compression": 12.0, "rebound": 30.0, "creep_velocity": 5e-3}
    time, found = march("directional_coulomb", 1e-3, 2.0, **numbers)
    fast = np.exp(-2.0 * np.abs(speed(time)) / 5e-3)
    level = (1.0 - fast) / (1.0 + fast)
    assert relative(found, np.where(speed(time) > 0.0, 12.0 * level, -30.0 * level)) < 1e-12
    _, equal = march("directional_coulomb", 1e-3, 2.0, compression=12.0, rebound=12.0, creep_velocity=5e-3)
    assert relative(equal, march("coulomb", 1e-3, 2.0, limit=12.0, creep_velocity=5e-3)[1]) < 1e-12


def test_rounded_friction_takes_the_work_of_both_limits_less_that_of_its_creep():
    """Over a half sine at v, the limit times the stroke times 1 less pi^2/24 (creep/v)^2, where the creep is slow."""
    _, x, force = last_cycle(
        "directional_coulomb", 5e-3, 1.0, 3, 4000, compression=20.0, rebound=50.0, creep_velocity=1e-3
    )
    work = np.sum(0.5 * (force + np.roll(force, 1)) * (x - np.roll(x, 1)))
    share = 1.0 - np.pi**2 / 24.0 * (1e-3 / (2.0 * np.pi * 5e-3)) ** 2
    assert work == pytest.approx(2.0 * 5e-3 * (20.0 + 50.0) * share, rel=1e-4)


@pytest.mark.parametrize(("growth", "middle"), [(0.0, 0.0), (2e3, 1.5e-3), (5e3, 0.0), (5e4, 3e-3), (59999.0, 1e-3)])
def test_friction_by_place_solves_its_equation(growth, middle):
    """The limit has a kink where the way crosses the middle: the integration begins anew there."""

    def rate(t, force):
        limit = 12.0 + growth * np.abs(place(t) - middle)
        return 6e4 * (speed(t) - np.abs(speed(t)) * force / limit)

    crossing = np.arccos(np.clip(1.0 - middle / AMPLITUDE, -1.0, 1.0)) / (2.0 * np.pi * 7.0)
    kinks = np.sort(np.concatenate([TURNS, [n / 7.0 + s * crossing for n in range(9) for s in (-1.0, 1.0)]]))
    kinks = kinks[np.concatenate([[True], np.diff(kinks) > 1e-9])]
    time, found = march("side_load_friction", 1e-3, 2.0, stiffness=6e4, limit=12.0, growth=growth, middle=middle)
    assert relative(found, integrate(rate, [0.0], time, kinks)[0]) < 2e-6


def test_without_growth_it_is_a_dahl_slider():
    _, found = march("side_load_friction", 1e-3, stiffness=6e4, limit=12.0, growth=0.0)
    _, dahl = march("dahl", 1e-3, stiffness=6e4, limit=12.0)
    assert relative(found, dahl) < 1e-12


def test_a_stiff_slider_follows_the_butterfly_of_its_limit():
    _, x, force = last_cycle("side_load_friction", 5e-3, 1.0, 3, 4000, stiffness=1e8, limit=5.0, growth=4e3)
    work = np.sum(0.5 * (force + np.roll(force, 1)) * (x - np.roll(x, 1)))
    # to and fro: 4 times the integral of the limit over half the stroke
    assert work == pytest.approx(4.0 * (5.0 * 5e-3 + 0.5 * 4e3 * 5e-3**2), rel=2e-3)


@pytest.mark.parametrize(("growth", "middle"), [(0.0, 0.0), (2e3, 1.5e-3), (5e3, 0.0), (5e4, 3e-3), (2e5, 1e-3)])
def test_a_slider_under_a_load_is_the_limit_of_many_small_steps(growth, middle):
    """Moreau's catching-up: after each of many small ways the force goes to the nearest one that is admitted."""
    time, found = march("loaded_slider", 1e-3, 2.0, stiffness=6e4, limit=12.0, growth=growth, middle=middle)
    parts, exact, force = 400, [0.0], 0.0
    path = place(np.linspace(0.0, time[-1], parts * (time.size - 1) + 1))
    for way, there in zip(np.diff(path), path[1:], strict=True):
        limit = 12.0 + growth * abs(there - middle)
        force = min(max(force + 6e4 * way, -limit), limit)
        exact.append(force)
    assert relative(found, np.array(exact)[::parts]) < 1e-4


def test_a_slider_under_a_load_slides_along_its_butterfly_and_sticks_in_between():
    _, x, force = last_cycle("loaded_slider", 5e-3, 1.0, 3, 4000, stiffness=1e9, limit=5.0, growth=4e3)
    limit = 5.0 + 4e3 * np.abs(x)
    assert np.all(np.abs(force) <= limit * (1.0 + 1e-12))
    work = np.sum(0.5 * (force + np.roll(force, 1)) * (x - np.roll(x, 1)))
    assert work == pytest.approx(4.0 * (5.0 * 5e-3 + 0.5 * 4e3 * 5e-3**2), rel=2e-3)
