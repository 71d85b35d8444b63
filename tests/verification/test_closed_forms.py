"""Elements against closed forms of their steady response to a sine."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import i1
from seeds import seed_of
from verification.alone import circling, dynamic_stiffness, last_cycle, network_of

RNG = np.random.default_rng(seed_of("test_closed_forms"))
SEED = int(RNG.integers(2**32))


@pytest.fixture
def rng() -> np.random.Generator:
    print(f"seed {SEED}")
    return np.random.default_rng(SEED)


def work(x, force):
    closed = np.append(force, force[0])
    return np.sum(0.5 * (closed[1:] + closed[:-1]) * np.diff(np.append(x, x[0])))


@pytest.mark.parametrize("frequency", [1.0, 7.0, 25.0])
def test_a_maxwell_element_has_the_dynamic_stiffness_of_its_formula(frequency, rng):
    stiffness, time = 1e4 * rng.uniform(0.5, 2.0), 10.0 ** rng.uniform(-3.0, -0.8)
    found = dynamic_stiffness("maxwell", 2e-3, frequency, 60, 400, stiffness=stiffness, relaxation_time=time)
    turn = 2j * np.pi * frequency * time
    decayed = np.exp(-59 / (frequency * time))
    assert abs(found - stiffness * turn / (1.0 + turn)) < (1e-8 + decayed) * stiffness


def test_the_loss_stiffness_of_a_maxwell_element_peaks_with_half_its_stiffness_at_one_over_its_time():
    time = 0.02
    around = [1.0 / (2.0 * np.pi * time) * factor for factor in (0.97, 1.0, 1.03)]
    loss = [dynamic_stiffness("maxwell", 1e-3, f, 40, 400, stiffness=1e4, relaxation_time=time).imag for f in around]
    assert loss[1] == pytest.approx(5e3, rel=1e-8)
    assert max(loss) == loss[1]


@pytest.mark.parametrize("ratio", [0.2, 1.0, 1.5, 4.0, 12.0])
def test_a_dahl_loop_has_the_stiffness_of_bessel_functions(ratio, rng):
    stiffness, limit = 6e4 * rng.uniform(0.5, 2.0), 15.0 * rng.uniform(0.5, 2.0)
    amplitude = ratio * limit / stiffness
    found = dynamic_stiffness("dahl", amplitude, 3.0, 60, 6000, stiffness=stiffness, limit=limit)
    storage = 2.0 * limit * i1(ratio) / (amplitude * np.cosh(ratio))
    loss = 4.0 * limit / (np.pi * amplitude) * (1.0 - np.tanh(ratio) / ratio)
    assert found.real == pytest.approx(storage, rel=2e-6)
    assert found.imag == pytest.approx(loss, rel=2e-6)


@pytest.mark.parametrize("ratio", [0.3, 1.5, 6.0])
def test_a_dahl_loop_has_its_peak_force_and_its_work(ratio, rng):
    stiffness, limit = 6e4 * rng.uniform(0.5, 2.0), 15.0 * rng.uniform(0.5, 2.0)
    amplitude, yielding = ratio * limit / stiffness, limit / stiffness
    _, x, force = last_cycle("dahl", amplitude, 3.0, 60, 6000, stiffness=stiffness, limit=limit)
    assert np.max(force) == pytest.approx(limit * np.tanh(ratio), rel=1e-12)
    assert np.min(force) == pytest.approx(-limit * np.tanh(ratio), rel=1e-12)
    # the trapezoid of 6000 pieces is good to their square
    assert work(x, force) == pytest.approx(4.0 * limit * (amplitude - yielding * np.tanh(ratio)), rel=1e-5)


def jenkin_stiffness(stiffness, limit, amplitude):
    yielding = limit / stiffness
    turn = np.arccos(1.0 - 2.0 * yielding / amplitude)
    loss = 4.0 * limit / (np.pi * amplitude) * (1.0 - yielding / amplitude)
    return stiffness / np.pi * (turn - 0.5 * np.sin(2.0 * turn)) + 1j * loss


@pytest.mark.parametrize("ratio", [1.2, 2.0, 5.0])
def test_a_dahl_element_of_exponent_zero_is_an_elastic_perfectly_plastic_slider(ratio, rng):
    stiffness, limit = 6e4 * rng.uniform(0.5, 2.0), 15.0 * rng.uniform(0.5, 2.0)
    amplitude = ratio * limit / stiffness
    numbers = {"stiffness": stiffness, "limit": limit, "exponent": 0}
    found = dynamic_stiffness("dahl", amplitude, 3.0, 3, 6000, **numbers)
    expected = jenkin_stiffness(stiffness, limit, amplitude)
    assert abs(found - expected) < 1e-6 * stiffness
    _, x, force = last_cycle("dahl", amplitude, 3.0, 3, 6000, **numbers)
    assert np.max(np.abs(force)) == limit
    assert work(x, force) == pytest.approx(4.0 * limit * (amplitude - limit / stiffness), rel=1e-5)


def test_the_loss_stiffness_of_a_slider_peaks_with_a_pi_th_of_its_stiffness_at_twice_its_yield_travel():
    amplitude = 2.0 * 15.0 / 6e4
    found = dynamic_stiffness("dahl", amplitude, 3.0, 3, 6000, stiffness=6e4, limit=15.0, exponent=0)
    assert found.imag == pytest.approx(6e4 / np.pi, rel=1e-6)


@pytest.mark.parametrize("exponent", [0.0, 1.0])
def test_a_sharp_prandtl_element_is_a_slider_behind_its_spring(exponent):
    # sliding starts over limit/(sharpness stiffness), which a sharpness of 1000 makes short
    stiffness, limit, amplitude = 2e4, 20.0, 3e-3
    numbers = {"stiffness": stiffness, "limit": limit, "sharpness": 1000, "exponent": exponent}
    found = dynamic_stiffness("prandtl", amplitude, 2.0, 3, 6000, **numbers)
    assert abs(found - jenkin_stiffness(stiffness, limit, amplitude)) < 6e-3 * stiffness


def test_a_prandtl_element_starts_with_the_stiffness_of_both_springs_in_series():
    stiffness, sharpness, limit = 2e4, 10.0, 20.0
    network = network_of("prandtl", stiffness=stiffness, limit=limit, sharpness=sharpness)
    drive = circling(1e-9, 1.0, 1, 4000)
    force = network.simulate(network.prepare(drive))
    slope = force[1:1000] / drive.displacement[1:1000]
    assert slope == pytest.approx(np.full(999, stiffness * sharpness / (1.0 + sharpness)), rel=1e-5)


def test_after_a_reversal_from_sliding_a_slider_is_stiffer_by_two_to_its_exponent():
    for exponent in (0.5, 1.0, 2.0):
        stiffness, limit = 6e4, 15.0
        network = network_of("dahl", stiffness=stiffness, limit=limit, exponent=exponent)
        drive = circling(200.0 * limit / stiffness, 1.0, 1, 400_000)
        force = network.simulate(network.prepare(drive))
        top = int(np.argmax(drive.displacement))
        fall = (force[top + 40] - force[top]) / (drive.displacement[top + 40] - drive.displacement[top])
        expected = stiffness * (1.0 + force[top] / limit) ** exponent
        assert fall == pytest.approx(expected, rel=2e-4)


@pytest.mark.parametrize(
    ("element", "numbers"),
    [
        ("spring", {"stiffness": 2e5}),
        ("damper", {"damping": 150.0}),
        ("inerter", {"inertance": 3.0}),
    ],
)
def test_the_elements_without_memory_have_the_dynamic_stiffness_of_their_name(element, numbers):
    omega = 2.0 * np.pi * 9.0
    expected = {"spring": 2e5, "damper": 150.0 * 1j * omega, "inerter": -3.0 * omega**2}[element]
    assert dynamic_stiffness(element, 1e-3, 9.0, 2, 200, **numbers) == pytest.approx(expected, rel=1e-12)


def test_a_quadratic_damper_has_the_equivalent_damping_of_a_sine():
    # 8/(3 pi) d X w on the damping of the first harmonic
    omega, amplitude = 2.0 * np.pi * 9.0, 2e-3
    found = dynamic_stiffness("quadratic_damper", amplitude, 9.0, 2, 2000, damping=300.0)
    assert found.imag == pytest.approx(8.0 / (3.0 * np.pi) * 300.0 * amplitude * omega**2, rel=1e-6)
    assert abs(found.real) < 1e-9 * abs(found)
