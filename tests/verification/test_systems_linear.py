"""Linear networks with unknown nodes: exact state space, complex stiffness, order, and how far the estimate holds."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of
from verification.linear_systems import LINEAR, QUARTER_CAR
from verification.systems import excitation, lanes, rms, system, times
from verification.truth.motion import Cosines, smooth_motion

from dashpot.kernel.solution import Status

SEED = seed_of("test_systems_linear")
LANES, PAIRS = 48, (1, 2, 4)
HEAVY = ("quarter car", "two masses and an inerter")  # every unknown node has a mass


@pytest.fixture
def rng() -> np.random.Generator:
    print(f"seed {SEED}")
    return np.random.default_rng(SEED)


def draws(linear, rng, spread=0.7):
    network = linear.network
    return network.start * np.exp(rng.uniform(-spread, spread, (LANES, network.start.size)))


@pytest.mark.parametrize("name", LINEAR)
def test_the_force_is_that_of_the_state_space_of_high_order_in_the_step(name, rng, state):
    linear, at, motion = LINEAR[name], times(0.6), smooth_motion(rng, 0.0, 3e-3)
    network, values = linear.network, draws(linear, rng)
    exact = np.array([linear.exact(lane).force(motion, at) for lane in values])
    sizes = rms(exact - exact[:, :1])
    errors, estimates = [], []
    for pairs in PAIRS:
        found = network.solve(network.prepare(excitation(at, {network.outputs[0]: motion}), pairs), values)
        assert set(found.status) == {Status.GOOD}
        errors.append(rms(found.force[:, 0] - exact))
        estimates.append(found.error[:, 0])
    order = np.log2(np.array(errors[:-1]) / errors[1:])
    promised = np.log2(np.array(estimates[:-1]) / estimates[1:])
    shares = errors[0] / estimates[0]
    state(
        f"{name} at 1 ms: error {np.median(errors[0] / sizes):.1e} of the RMS force, order "
        f"{np.median(order):.2f}; estimate of order {np.median(promised):.2f}, {1.0 / np.median(shares):.0f} times "
        f"the error (from {1.0 / shares.max():.0f} to {1.0 / shares.min():.0f})"
    )
    assert np.max(errors[0] / sizes) < 1e-4
    if name in HEAVY:  # of fourth order; after one more halving rounding shows
        assert np.median(order[0]) > 3.9
        assert promised[0] == pytest.approx(np.full(LANES, 4.0), abs=0.1)
    else:
        # the estimate is that of the short steps, whose leading error has been taken away from the answer
        assert np.median(order[0]) > 2.8 and np.median(order[1]) > 2.8
        assert promised == pytest.approx(np.full_like(promised, 2.0), abs=0.1)
    assert np.all(shares < 1.0)


def harmonic(network, frequency, amplitude, values=None, samples=200):
    """K* in the last cycle of twelve seconds of a sine."""
    cycles = round(12.0 * frequency)
    motion = Cosines(0.0, np.array([amplitude]), np.array([2.0 * np.pi * frequency]))
    at = np.arange(cycles * samples + 1) / (frequency * samples)
    found = network.solve(network.prepare(excitation(at, {network.outputs[0]: motion})), values)
    turn = np.exp(-2j * np.pi * np.arange(1, samples + 1) / samples)
    return 2.0 / (amplitude * samples) * found.force[:, 0, -samples:] @ turn


@pytest.mark.parametrize("frequency", [2.0, 8.0, 12.0, 25.0])
def test_a_quarter_car_has_the_dynamic_stiffness_of_its_transfer_function(frequency, rng):
    network = QUARTER_CAR.network
    m, body, k, d, ks, ds = 36.0, 346.0, 253.2e3, 150.0, 25.57e3, 1474.0
    values = lanes(
        network,
        wheel__mass=m,
        body__mass=body,
        tire__k__stiffness=k,
        tire__d__damping=d,
        strut__k__stiffness=ks,
        strut__d__damping=ds,
    )
    s = 2j * np.pi * frequency
    tire, strut = k + s * d, ks + s * ds
    suspended = strut * body * s**2 / (body * s**2 + strut)
    expected = tire * (1.0 - tire / (tire + m * s**2 + suspended))
    assert abs(harmonic(network, frequency, 1e-3, values)[0] - expected) < 2e-6 * abs(tire)


@pytest.mark.parametrize("name", ["zener", "three in series", "two masses and an inerter"])
def test_the_dynamic_stiffness_in_the_steady_state_is_that_of_the_state_space(name, rng):
    linear = LINEAR[name]
    frequency = rng.uniform(4.0, 20.0)
    expected = linear.exact(linear.network.start).stiffness(2.0 * np.pi * frequency)
    assert abs(harmonic(linear.network, frequency, 1e-3)[0] - expected) < 2e-6 * abs(expected) + 0.1


def test_compliances_add_up_in_series(rng):
    network = LINEAR["three in series"].network
    frequency = rng.uniform(4.0, 20.0)
    s = 2j * np.pi * frequency
    compliance = 1.0 / 2e5 + 1.0 / (3e3 * s) + 1.0 / (1e5 + 2e3 * s)
    assert harmonic(network, frequency, 1e-3)[0] == pytest.approx(1.0 / compliance, rel=1e-6)


def test_springs_in_series_are_one_spring_at_once():
    network = system(
        "",
        "leg: {series: {a: {element: spring, stiffness: 3 N/mm}, b: {element: spring, "
        "stiffness: 6 N/mm}, c: {element: spring, stiffness: 2 N/mm}}}",
        "",
    )
    at = times(0.3)
    motion = smooth_motion(np.random.default_rng(SEED), 1e-3, 5e-3)
    found = network.solve(network.prepare(excitation(at, {network.outputs[0]: motion})))
    # no rates, no steps: only Newton's last step is left
    assert found.force[0, 0] == pytest.approx(1e3 * motion.place(at), rel=1e-9, abs=1e-9)


def test_a_mass_behind_a_spring_resonates_as_the_fluid_of_a_hydro_element():
    # the fluid is a mass between the wall and the body that it is pumped against, damped by the track
    nodes = "{piston: driven, fluid: {mass: 50 kg}, frame: ground}"
    network = system(
        nodes,
        """
        wall: {between: [piston, fluid], element: spring, stiffness: 200 N/mm}
        track: {between: [fluid, frame], element: damper, damping: 1.6 N*s/mm}
        """,
    )
    for frequency in (8.0, 12.0, np.sqrt(2e5 / 50.0) / (2.0 * np.pi)):
        track = -50.0 * (2.0 * np.pi * frequency) ** 2 + 1.6e3 * 2j * np.pi * frequency
        assert harmonic(network, frequency, 1e-3)[0] == pytest.approx(2e5 * track / (2e5 + track), rel=2e-6)
