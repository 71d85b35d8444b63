"""Valves and dampers in series with a spring against an independent integration, and in the limits that are known."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from verification.alone import circling, network_of
from verification.test_elements_with_memory import march, orders, relative, speed

from dashpot_elements.valve import _flow

VALVE = {
    "stiffness": 3e5,
    "compression": 2e3,
    "rebound": 5e3,
    "compression_knee": 0.05,
    "rebound_knee": 0.02,
    "compression_opened": 300.0,
    "rebound_opened": 100.0,
    "sharpness": 3.0,
}


def valve_curve(w, numbers):
    side = "rebound" if w < 0.0 else "compression"
    low, high, knee = (numbers[side + key] for key in ("", "_opened", "_knee"))
    m = numbers["sharpness"]
    return high * w + (low - high) * w / (1.0 + abs(w / knee) ** m) ** (1.0 / m)


def valve_slope(w, numbers):
    side = "rebound" if w < 0.0 else "compression"
    low, high, knee = (numbers[side + key] for key in ("", "_opened", "_knee"))
    m = numbers["sharpness"]
    return high + (low - high) * (1.0 + abs(w / knee) ** m) ** (-1.0 / m - 1.0)


def power_curve(w, numbers):
    r = abs(w / 0.1)
    return numbers["force"] * np.sign(w) * (r ** numbers["exponent"] if r > 1e-3 else r * at_rest(numbers))


def at_rest(numbers):
    return 1e-3 ** (numbers["exponent"] - 1.0)


def power_slope(w, numbers):
    r, n = abs(w / 0.1), numbers["exponent"]
    return numbers["force"] / 0.1 * (n * r ** (n - 1.0) if r > 1e-3 else at_rest(numbers))


def truth(curve, slope, numbers, time):
    """g(w) where g'(w) dw/dt = k (v - w)."""
    found = integrated(lambda t, w: numbers["stiffness"] * (speed(t) - w) / slope(w, numbers), time)
    return np.array([curve(w, numbers) for w in found])


def integrated(rate, time):
    """What begins at zero and changes by rate(t, y)."""
    options = {"method": "LSODA", "rtol": 1e-10, "atol": 1e-13, "max_step": 2e-4}
    return solve_ivp(lambda t, y: [rate(t, y[0])], (0.0, time[-1]), [0.0], t_eval=time, **options).y[0]


@pytest.mark.parametrize(
    ("element", "curve", "slope", "numbers"),
    [
        ("valve", valve_curve, valve_slope, VALVE),
        ("valve", valve_curve, valve_slope, {**VALVE, "sharpness": 1.0, "compression_opened": 0.0, "stiffness": 1e5}),
        ("compliant_damper", power_curve, power_slope, {"stiffness": 4e4, "force": 300.0, "exponent": 2.0}),
        ("compliant_damper", power_curve, power_slope, {"stiffness": 4e4, "force": 100.0, "exponent": 0.6}),
    ],
)
def test_a_damper_behind_a_spring_is_of_second_order_in_the_step(element, curve, slope, numbers, state):
    errors = []
    for dt in (1e-3, 0.5e-3, 0.25e-3):
        time, found = march(element, dt, 1.0, **numbers)
        errors.append(relative(found, truth(curve, slope, numbers, time)))
    state(f"{element} at 1, 0.5, 0.25 ms: {', '.join(f'{error:.1e}' for error in errors)} of the largest force")
    # where turbulent flow turns, its slope is next to nothing: the square root of the force that is left there has none
    assert errors[0] < 1e-3
    assert np.all(orders(errors) > 1.6) or (numbers.get("exponent") == 2.0 and errors[2] < 0.3 * errors[0])


def power_of_ten(low, high):
    return st.floats(low, high).map(lambda exponent: 10.0**exponent)


STIFFENING = {"stiffness": 4e4, "relaxation_time": 0.02, "travel": 1e-3}


def test_a_dashpot_on_a_spring_that_stiffens_is_of_second_order_in_the_step(state):
    """Against the deflection e of the spring, e' = v - k e/(1 - |e|/s)/d."""
    k, time_constant, s = STIFFENING.values()
    errors = []
    for dt in (1e-3, 0.5e-3, 0.25e-3):
        time, found = march("stiffening_maxwell", dt, 1.0, **STIFFENING)
        stretch = integrated(lambda t, e: speed(t) - e / (1.0 - abs(e) / s) / time_constant, time)
        errors.append(relative(found, k * stretch / (1.0 - np.abs(stretch) / s)))
    assert np.max(np.abs(stretch)) > 0.5 * s
    state(f"stiffening_maxwell at 1, 0.5, 0.25 ms: {', '.join(f'{error:.1e}' for error in errors)}")
    assert errors[0] < 2e-3
    assert np.all(orders(errors) > 1.6)


def test_a_spring_that_is_blocked_far_away_is_that_of_a_maxwell_element():
    _, maxwell = march("maxwell", 0.25e-3, stiffness=4e4, relaxation_time=0.02)
    for travel, share in ((10.0, 1.0), (1.0, 10.0)):
        _, found = march("stiffening_maxwell", 0.25e-3, stiffness=4e4, relaxation_time=0.02, travel=travel)
        assert relative(found, maxwell) < 1e-4 * share


def test_a_spring_that_is_blocked_at_once_leaves_the_dashpot():
    """But for the velocity of the spring, which in a step goes from one end of its travel to the other at the most."""
    travel, damping, drive = 1e-6, 800.0, circling(5e-3, 5.0, 2, 100)
    network = network_of("stiffening_maxwell", stiffness=1e6, relaxation_time=damping / 1e6, travel=travel)
    found = network.simulate(network.prepare(drive))[5:]
    assert found == pytest.approx(damping * drive.velocity[5:], abs=damping * 2.0 * travel / drive.dt)


@given(given=power_of_ten(-9, 3), part=power_of_ten(-9, 4), travel=power_of_ten(-6, 1))
def test_deflection_and_flow_of_a_spring_that_stiffens_are_what_is_given(given, part, travel):
    from dashpot_elements.stiffening_maxwell import _loaded

    loaded = float(_loaded(-given, part, travel))
    assert -loaded / (1.0 - loaded / travel) - part * loaded == pytest.approx(given, rel=1e-9)


@given(
    lag=power_of_ten(-3, 5),
    damping=power_of_ten(-1, 6),
    share=st.floats(0.0, 0.99),
    knee=power_of_ten(-3, 1),
    sharpness=st.floats(1.0, 8.0),
    force=power_of_ten(-3, 5),
)
@example(lag=1e5, damping=1e3, share=0.0, knee=0.1, sharpness=1.05, force=99.0)  # soft spring, gentle knee
@example(lag=1e5, damping=1e3, share=0.0, knee=0.1, sharpness=8.0, force=100.0)
def test_the_velocity_through_a_valve_is_the_root_whatever_its_knee(lag, damping, share, knee, sharpness, force):
    """Against bracketing in the logarithm of the velocity: what a step of a spring that lags by some steps asks for."""
    opened, rate = share * damping, damping / lag
    numbers = {"compression": damping, "compression_opened": opened, "compression_knee": knee, "sharpness": sharpness}
    lowest, highest = force / (rate + damping), (force + damping * knee) / rate

    def missing(place):
        w = np.exp(place)
        return rate * w + valve_curve(w, numbers) - force

    root = np.exp(brentq(missing, np.log(0.5 * lowest), np.log(2.0 * highest), xtol=1e-13, rtol=1e-13))
    carried, speed = (float(each) for each in _flow(force, rate, damping - opened, knee, opened, sharpness))
    assert speed == pytest.approx(root, rel=5e-6)
    assert carried == pytest.approx(force - rate * root, abs=1e-9 * force)


def test_a_linear_damper_behind_a_spring_is_a_maxwell_element():
    errors = []
    for dt in (1e-3, 0.5e-3):
        _, maxwell = march("maxwell", dt, stiffness=4e4, relaxation_time=0.02)
        _, found = march("compliant_damper", dt, stiffness=4e4, force=80.0)
        errors.append(relative(found, maxwell))
        _, valve = march(
            "valve",
            dt,
            stiffness=4e4,
            compression=800.0,
            rebound=800.0,
            compression_knee=1e3,
            rebound_knee=1e3,
            compression_opened=800.0,
            rebound_opened=800.0,
        )
        assert valve == pytest.approx(found, abs=1e-9)
    assert errors[0] < 1e-3
    assert orders(errors)[0] > 1.9


@pytest.mark.parametrize(
    ("element", "curve", "numbers"),
    [
        ("valve", valve_curve, {**VALVE, "stiffness": 1e10}),
        ("compliant_damper", power_curve, {"stiffness": 1e10, "force": 300.0, "exponent": 2.0}),
        ("compliant_damper", power_curve, {"stiffness": 1e10, "force": 300.0, "exponent": 0.3}),
    ],
)
def test_behind_a_rigid_spring_a_damper_follows_its_curve(element, curve, numbers):
    drive = circling(5e-3, 5.0, 2, 100)
    network = network_of(element, **numbers)
    found = network.simulate(network.prepare(drive))[50:]
    expected = np.array([curve(v, numbers) for v in drive.velocity[50:]])
    # near zero velocity the curve of a small power is stiffer than any spring
    slow = np.abs(drive.velocity[50:]) < 0.05 * np.max(drive.velocity)
    assert np.max(np.abs(found - expected)[~slow]) < 1e-3 * np.max(expected)


def test_towards_the_power_zero_it_is_a_slider_behind_a_spring():
    _, slider = march("dahl", 0.5e-3, stiffness=4e4, limit=30.0, exponent=0.0)
    _, found = march("compliant_damper", 0.5e-3, stiffness=4e4, force=30.0, exponent=0.05)
    # |v| runs over decades: at its twentieth power the force is off by (v/0.1 m/s)^0.05 - 1
    assert relative(found, slider) < 0.15


@pytest.mark.parametrize("exponent", [0.05, 0.3, 1.0, 2.0, 4.0])
@pytest.mark.parametrize("stiffness", [1e2, 1e5, 1e9])
def test_the_step_of_a_power_leaves_no_residual(exponent, stiffness):
    from dashpot_elements.compliant_damper import _flow

    given, rate = np.geomspace(1e-6, 1e6, 400), 0.2929 * 1e-3 * stiffness * 0.1 / 50.0
    share, ratio = _flow(given, rate, exponent)
    assert share * given + rate * ratio == pytest.approx(given, rel=1e-12)
    assert ratio**exponent == pytest.approx(share * given, rel=1e-10, abs=1e-300)


@pytest.mark.parametrize("sharpness", [1.0, 2.5, 8.0])
@pytest.mark.parametrize("rate", [1e-3, 1.0, 1e3, 1e7])
def test_the_step_of_a_valve_leaves_no_residual(sharpness, rate):
    from dashpot_elements.valve import _flow

    given = np.concatenate([-np.geomspace(1e-6, 1e5, 300), np.geomspace(1e-6, 1e5, 300)])
    force, w = _flow(given, rate, 1800.0, 0.05, 200.0, sharpness)
    curve = 200.0 * w + 1800.0 * w / (1.0 + np.abs(w / 0.05) ** sharpness) ** (1.0 / sharpness)
    assert curve + rate * w == pytest.approx(given, rel=1e-10)
    assert force + rate * w == pytest.approx(given, rel=1e-12)
