"""Gas springs: the polytrope, and heat exchange between isothermal and adiabatic; and what stands beside a spring."""

from __future__ import annotations

import numpy as np
import pytest
from verification.alone import dynamic_stiffness
from verification.test_elements_with_memory import OMEGA, march, orders, place, relative, speed
from verification.truth.elements import integrate


@pytest.mark.parametrize("exponent", [1.0, 1.17, 1.4])
def test_a_gas_spring_follows_its_polytrope(exponent):
    time, found = march("gas_spring", 1e-3, force=400.0, length=9e-3, exponent=exponent)
    pressure = (9e-3 - place(time)) ** -exponent
    assert found == pytest.approx(400.0 * pressure / 9e-3**-exponent, rel=1e-12)


def test_beyond_its_bottom_a_gas_spring_goes_on_along_its_tangent():
    time, found = march("gas_spring", 1e-3, force=400.0, length=3e-3, exponent=1.4)
    bottom = 0.95 * 3e-3
    beyond = place(time) > bottom
    force, slope = 400.0 * 0.05**-1.4, 1.4 * 400.0 * 0.05**-2.4 / 3e-3
    assert beyond.any()
    assert found[beyond] == pytest.approx(force + slope * (place(time)[beyond] - bottom), rel=1e-12)


def test_a_gas_that_cools_solves_its_equation(state):
    errors = []
    for dt in (2e-3, 1e-3, 0.5e-3):
        time, found = march("warm_gas_spring", dt, force=400.0, length=9e-3, time=0.02)

        def rate(t, temperature):
            u = 1.0 - place(t) / 9e-3
            return 0.4 * temperature * speed(t) / 9e-3 / u - (temperature - 1.0) / 0.02

        temperature = integrate(rate, [1.0], time)[0]
        errors.append(relative(found, 400.0 * temperature / (1.0 - place(time) / 9e-3)))
    state(f"warm_gas_spring at 2, 1, 0.5 ms: {', '.join(f'{error:.1e}' for error in errors)} of the largest force")
    assert np.all(orders(errors) > 1.9)
    assert errors[1] < 1e-3


def test_fast_a_gas_is_adiabatic():
    _, polytrope = march("gas_spring", 1e-3, force=400.0, length=20e-3, exponent=1.4)
    _, found = march("warm_gas_spring", 1e-3, force=400.0, length=20e-3, time=1e5)
    assert relative(found, polytrope) < 1e-6


def test_slow_a_gas_keeps_its_temperature():
    _, polytrope = march("gas_spring", 1e-3, force=400.0, length=20e-3, exponent=1.0)
    _, found = march("warm_gas_spring", 1e-3, force=400.0, length=20e-3, time=1e-3)
    # w T times 0.4 of the rise of the force, and of pressure and volume
    assert relative(found - 400.0, polytrope - 400.0) < 0.4 * OMEGA * 1e-3


def test_small_motions_of_a_gas_find_the_stiffness_of_its_formula():
    frequency, time = 3.0, 0.05
    turn = 2j * np.pi * frequency * time
    found = dynamic_stiffness("warm_gas_spring", 2e-6, frequency, 4, 2000, force=400.0, length=0.1, time=time)
    assert found == pytest.approx(4000.0 * (1.0 + 0.4 * turn / (1.0 + turn)), rel=2e-4)


def test_a_constant_force_is_constant():
    _, found = march("constant_force", 1e-3, force=-35.0)
    assert np.all(found == -35.0)


@pytest.mark.parametrize("stiffness", [-3000.0, 3000.0])
def test_a_signed_spring_is_a_straight_line_of_either_sign(stiffness):
    time, found = march("signed_spring", 1e-3, stiffness=stiffness)
    assert found == pytest.approx(stiffness * place(time), rel=1e-12)
