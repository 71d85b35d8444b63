"""Elements with memory against an independent integration of their law along a sine."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import gamma
from verification.alone import network_of
from verification.truth.elements import (
    absorber_pull,
    absorber_rate,
    bouc_wen_rate,
    bristles,
    hydro_rate,
    integrate,
    stribeck_rate,
)

from dashpot.data.drive import drive_from_path

FREQUENCY, AMPLITUDE = 7.0, 2e-3
OMEGA = 2.0 * np.pi * FREQUENCY
# turning points of the path: the middle and the end of every cycle
TURNS = np.arange(1, 100) * 0.5 / FREQUENCY
HYDRO = {"fluid_mass": 50.0, "stiffness": 2e5}
ABSORBER = {"mass": 5.0, "stiffness": 2e4}


def place(t):
    """From rest at zero deflection: compressed and back."""
    return AMPLITUDE * (1.0 - np.cos(OMEGA * t))


def speed(t):
    return AMPLITUDE * OMEGA * np.sin(OMEGA * t)


def march(element, dt, cycles=3.0, **numbers):
    """Times, and the force of an element, along ``place``."""
    time = dt * np.arange(round(cycles / (FREQUENCY * dt)) + 1)
    drive = drive_from_path(dt, place(time), speed(time), AMPLITUDE * OMEGA**2 * np.cos(OMEGA * time))
    network = network_of(element, **numbers)
    return time, network.simulate(network.prepare(drive))


def hydro_force(time, damping, turbulence=0.0, chamber=0.0):
    mass, wall = HYDRO["fluid_mass"], HYDRO["stiffness"]
    fluid = integrate(hydro_rate(place, mass, wall, damping, turbulence, chamber), [0.0, 0.0], time)[0]
    return wall * (place(time) - fluid)


def absorber_force(time, damping, turbulence=0.0):
    mass, *numbers = *ABSORBER.values(), damping, turbulence
    where, fast = integrate(absorber_rate(place, speed, mass, *numbers), [0.0, 0.0], time)
    return absorber_pull(place(time) - where, speed(time) - fast, *numbers)


def relative(found, expected):
    return np.max(np.abs(found - expected)) / np.max(np.abs(expected))


def orders(errors):
    """The order of convergence between steps that are halved."""
    return np.log2(np.array(errors[:-1]) / np.array(errors[1:]))


# critical damping is 2 sqrt((k_b + k_2) m) = 6325 N s/m without a chamber
@pytest.mark.parametrize("damping", [10.0, 1.6e3, 6.3e3, 6324.55532, 6.4e3, 5e5])
@pytest.mark.parametrize("chamber", [0.0, 5e4])
def test_a_linear_hydro_element_solves_its_equation_of_motion(damping, chamber, state):
    time, found = march("hydro", 0.5e-3, damping=damping, compensation_stiffness=chamber, **HYDRO)
    # of the step only the cubic between samples is left, of the fourth order
    error = relative(found, hydro_force(time, damping, chamber=chamber))
    state(f"hydro, d = {damping:g} N s/m, k_2 = {chamber:g} N/m at 0.5 ms: {error:.1e} of the largest force")
    assert error < 5e-9


# critical damping is 2 sqrt(k m) = 632.46 N s/m; a mass that is all but held shows the acceleration of the cubic path,
# which between two samples is right to (2 pi 7 dt)^2/6
@pytest.mark.parametrize(
    ("damping", "allowed"),
    [
        (1.0, 5e-8),
        (60.0, 5e-8),
        (630.0, 5e-8),
        (632.455532, 5e-8),
        (640.0, 5e-8),
        (5e4, 8e-5),
    ],
)
def test_a_linear_absorber_solves_its_equation_of_motion(damping, allowed, state):
    time, found = march("vibration_absorber", 0.5e-3, damping=damping, **ABSORBER)
    error = relative(found, absorber_force(time, damping))
    state(f"vibration absorber, d = {damping:g} N s/m at 0.5 ms: {error:.1e} of the largest force")
    assert error < allowed


@pytest.mark.parametrize(
    ("element", "numbers", "force", "damping"),
    [
        ("hydro", HYDRO, hydro_force, 1.6e3),
        ("vibration_absorber", ABSORBER, absorber_force, 60.0),
    ],
)
def test_the_step_of_a_linear_mass_on_a_spring_leaves_the_error_of_the_cubic_path_alone(
    element, numbers, force, damping
):
    errors = []
    for dt in (4e-3, 2e-3, 1e-3):
        time, found = march(element, dt, damping=damping, **numbers)
        errors.append(relative(found, force(time, damping)))
    assert np.all(orders(errors) > 3.7)


@pytest.mark.parametrize(
    ("element", "numbers", "force", "damping", "turbulence"),
    [
        ("hydro", HYDRO, hydro_force, 300.0, 2e4),
        ("vibration_absorber", ABSORBER, absorber_force, 20.0, 500.0),
    ],
)
def test_quadratic_damping_is_of_second_order_in_the_step(element, numbers, force, damping, turbulence, state):
    errors = []
    for dt in (2e-3, 1e-3, 0.5e-3):
        time, found = march(element, dt, damping=damping, quadratic_damping=turbulence, **numbers)
        errors.append(relative(found, force(time, damping, turbulence)))
    shown = ", ".join(f"{error:.1e}" for error in errors)
    state(f"{element} with d_2 at 2, 1, 0.5 ms: {shown} of the largest force")
    assert np.all(orders(errors) > 1.9)
    assert errors[1] < 1e-3


def test_a_stribeck_slider_is_of_second_order_in_the_step(state):
    numbers = {"stiffness": 6e4, "limit": 10.0, "breakaway": 25.0, "stribeck_velocity": 0.02}
    errors = []
    for dt in (1e-3, 0.5e-3, 0.25e-3):
        time, found = march("stribeck", dt, **numbers)
        expected = integrate(stribeck_rate(speed, *numbers.values()), [0.0], time, TURNS)[0]
        errors.append(relative(found, expected))
    state(f"stribeck at 1, 0.5, 0.25 ms: {', '.join(f'{error:.1e}' for error in errors)} of the largest force")
    assert np.all(orders(errors) > 1.7)
    assert errors[0] < 2e-3


def test_damped_bristles_are_those_of_the_lugre_model(state):
    numbers, errors = {"stiffness": 6e4, "limit": 10.0, "breakaway": 25.0, "stribeck_velocity": 0.02}, []
    for dt in (1e-3, 0.5e-3, 0.25e-3):
        time, found = march("stribeck", dt, **numbers, bristle_damping=200.0)
        rate = stribeck_rate(speed, *numbers.values())
        bent = integrate(rate, [0.0], time, TURNS)[0]
        expected = bristles(rate, time, bent, numbers["stiffness"], 200.0, speed(time))
        assert np.max(expected - bent) > 0.2 * np.max(bent)
        errors.append(relative(found, expected))
    state(f"LuGre at 1, 0.5, 0.25 ms: {', '.join(f'{error:.1e}' for error in errors)} of the largest force")
    assert np.all(orders(errors) > 1.7)
    assert errors[0] < 2e-3


def test_a_stribeck_slider_with_one_limit_is_a_dahl_slider():
    _, found = march("stribeck", 1e-3, stiffness=6e4, limit=10.0, breakaway=10.0, stribeck_velocity=0.02)
    _, dahl = march("dahl", 1e-3, stiffness=6e4, limit=10.0)
    assert relative(found, dahl) < 1e-12


def bouc_wen_force(time, shape, exponent):
    """In the classical numbers: limit (A/(beta + gamma))^(1/n), shape beta/(beta + gamma)."""
    both = 5e4 / 30.0**exponent
    return integrate(bouc_wen_rate(speed, 5e4, shape * both, (1.0 - shape) * both, exponent), [0.0], time, TURNS)[0]


@pytest.mark.parametrize(("exponent", "tolerance"), [(1.0, 1.5e-7), (1.5, 2e-5), (3.0, 2e-6)])
@pytest.mark.parametrize("shape", [0.5, 0.7, 1.0])
def test_a_bouc_wen_element_solves_its_equation(shape, exponent, tolerance, state):
    time, found = march("bouc_wen", 1e-3, 1.2, stiffness=5e4, limit=30.0, shape=shape, exponent=exponent)
    # where the cubic path turns differs from the sine by up to (w dt)^4/384 of the amplitude, which is 7e-8 in force
    error = relative(found, bouc_wen_force(time, shape, exponent))
    state(f"bouc_wen, shape {shape:g}, exponent {exponent:g} at 1 ms: {error:.1e} of the largest force")
    assert error < tolerance


def test_a_bouc_wen_element_of_an_exponent_beside_one_is_of_fourth_order():
    # with shorter steps every way is shorter
    truth = march("bouc_wen", 1e-3 / 64, 1.0, stiffness=2e4, limit=30.0, shape=0.8, exponent=3.0)[1]
    errors = []
    for parts in (1, 2, 4):
        found = march("bouc_wen", 1e-3 / parts, 1.0, stiffness=2e4, limit=30.0, shape=0.8, exponent=3.0)[1]
        errors.append(relative(found[: 140 * parts : parts], truth[: 140 * 64 : 64]))
    assert np.all(orders(errors) > 3.0)


def test_a_self_heating_spring_follows_its_warmth():
    numbers = {"stiffness": 2e4, "speed": 0.05, "time": 0.3}
    time, found = march("softening", 1e-3, 8.0, **numbers)
    warmth = integrate(lambda t, w: [((speed(t) / 0.05) ** 2 - w[0]) / 0.3], [0.0], time)[0]
    assert relative(found, 2e4 * place(time) / (1.0 + warmth)) < 1e-4
    for exponent in (0.5, 4.0):
        found = march("softening", 1e-3, 8.0, exponent=exponent, **numbers)[1]
        left = (1.0 + (2.0 ** (1.0 / exponent) - 1.0) * warmth) ** -exponent
        assert relative(found, 2e4 * place(time) * left) < 1e-4


def test_a_spring_that_is_still_warm_cools_beside_what_it_gains():
    numbers = {"stiffness": 2e4, "speed": 0.05, "time": 0.3}
    time, found = march("softening", 1e-3, 8.0, **numbers, before=9e-4, kept=0.4)
    inherited = 0.4 * 9e-4 / (0.05**2 * 0.3)
    warmth = integrate(lambda t, w: [((speed(t) / 0.05) ** 2 - w[0]) / 0.3], [inherited], time)[0]
    # at the first sample a step has passed
    assert relative(found[1:], 2e4 * place(time[1:]) / (1.0 + warmth[1:])) < 1e-3
    assert inherited > 0.4


def test_a_fading_spring_follows_the_clock_and_nothing_else():
    time, found = march("fading_spring", 1e-3, 8.0, stiffness=2e4, time=0.4)
    # at the first sample a step has passed
    assert found == pytest.approx(2e4 * place(time) * np.exp(-(time + 1e-3) / 0.4), abs=1e-9)


def test_a_creeping_spring_loses_its_force_along_the_logarithm_of_time():
    # held from the first sample on: a step from the unloaded specimen
    held, time = 4e-3, 0.1 * np.arange(20_001)
    network = network_of("creep", stiffness=1e4)
    drive = drive_from_path(0.1, np.full(time.size, held), np.zeros(time.size), np.zeros(time.size))
    force = network.simulate(network.prepare(drive))
    lost = force[0] - force
    expected = 1e4 * held * np.log10((1.1 + time) / 1.1)  # at the first sample a step has passed
    within = (0.2 < time) & (time < 100.0)
    assert lost[within] == pytest.approx(expected[within], rel=0.03)


def test_a_preload_creeps_and_what_moves_on_top_of_it_does_not():
    time = 1e-2 * np.arange(2001)
    drive = drive_from_path(1e-2, 3e-3 + place(time), speed(time), AMPLITUDE * OMEGA**2 * np.cos(OMEGA * time))
    network = network_of("preload_creep", stiffness=1e4, shortest=0.5)
    force = network.simulate(network.prepare(drive))
    # at the first sample a step has passed
    assert force == pytest.approx(-1e4 * 3e-3 * np.log10(1.0 + (time + 1e-2) / 0.5), abs=1e-9)


@pytest.mark.parametrize("order", [0.1, 0.3, 0.5])
@pytest.mark.parametrize("dwell", [3.0, 40.0])
def test_a_springpot_still_feels_the_deflection_under_which_it_has_rested(order, dwell):
    """The relaxation modulus of (j w)^order is t^-order/Gamma(1 - order), t from the begin of the dwell on."""
    network = network_of("springpot", stiffness=1e5, order=order, reference=1.0, lowest=0.002, decades=4.0, dwell=dwell)
    dt, still = 0.01, np.full(2001, 5e-3)
    force = network.simulate(network.prepare(drive_from_path(dt, still, 0.0 * still, 0.0 * still)))
    time = dwell + dt * np.arange(still.size)
    expected = 1e5 * (2.0 * np.pi) ** -order * 5e-3 * time**-order / gamma(1.0 - order)
    assert force[1:] == pytest.approx(expected[1:], rel=0.01)  # two and a half branches a decade
    rested = network_of("springpot", stiffness=1e5, order=order)
    assert not rested.simulate(rested.prepare(drive_from_path(dt, still, 0.0 * still, 0.0 * still))).any()
