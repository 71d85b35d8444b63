"""What a small force inside a network does to the measured ones, against linear mechanics and a loaded node."""

import numpy as np
import pytest
from seeds import seed_of

from dashpot.contract.registry import load_registry
from dashpot.data.drive import drive_from_samples
from dashpot.data.excitation import Excitation
from dashpot.kernel.influence import Influence
from dashpot.kernel.network import compile_network
from dashpot.model.reading import parse_network

ELEMENTS = load_registry().elements
MASS, TIRE, LOSS, SPRING, DAMPING = 40.0, 2e5, 150.0, 3e4, 1800.0
TEXT = f"""\
format: dashpot-network/1
name: wheel
nodes: {{platform: driven, wheel: {{mass: {MASS} kg}}, body: ground}}
branches:
  tire: {{between: [platform, wheel], element: spring, stiffness: {TIRE} N/m}}
  loss: {{between: [platform, wheel], element: damper, damping: {LOSS} N*s/m}}
  spring: {{between: [wheel, body], element: spring, stiffness: {SPRING} N/m}}
  damper: {{between: [wheel, body], element: damper, damping: {DAMPING} N*s/m}}
"""
SLIDER = "  slider: {between: [wheel, body], element: dahl, stiffness: 100 N/mm, limit: 60 N}\n"
STEP = 1e-3
TIME = np.arange(4000) * STEP
PAIRS = (("platform", "wheel"), ("wheel", "body"), ("platform", "body"))


def excitation():
    path = 3e-3 * np.sin(2.0 * np.pi * (TIME + TIME**2))
    return Excitation({"platform": drive_from_samples(STEP, path)}, dt=STEP, samples=TIME.size)


def changes(text, pair, forces):
    return Influence(parse_network(text, ELEMENTS), PAIRS).changes(excitation(), {pair: forces})[:, 0]


@pytest.mark.parametrize("frequency", [2.0, 11.0, 20.0])
def test_a_sine_on_the_wheel_reaches_the_platform_as_linear_mechanics_says(frequency):
    omega = 2.0 * np.pi * frequency
    tire, strut = TIRE + 1j * omega * LOSS, SPRING + 1j * omega * DAMPING
    # a force f that presses wheel and body apart moves the wheel by -f / (...) and the platform carries -tire z
    expected = tire / (tire + strut - MASS * omega**2)
    found = changes(TEXT, ("wheel", "body"), np.sin(omega * TIME)[None])[0]
    late = TIME > 2.0
    waves = np.array([np.sin(omega * TIME), np.cos(omega * TIME)])[:, late]
    sine, cosine = np.linalg.lstsq(waves.T, found[late], rcond=None)[0]
    assert sine + 1j * cosine == pytest.approx(expected, rel=2e-3)


def test_a_force_between_platform_and_ground_is_measured_as_it_is(rng):
    force = rng.standard_normal((11, 1)) * np.cos(3.0 * TIME)
    assert changes(TEXT, ("platform", "body"), force) == pytest.approx(force, abs=1e-6)


def test_more_forces_than_lanes_each_have_their_own_answer(rng):
    forces = rng.standard_normal((19, 1)) * np.sin(2.0 * np.pi * rng.uniform(2.0, 20.0, (19, 1)) * TIME)
    together = changes(TEXT, ("platform", "wheel"), forces)
    alone = changes(TEXT, ("platform", "wheel"), forces[17:18])
    assert together[17] == pytest.approx(alone[0], abs=1e-9)


def test_a_force_that_is_zero_changes_nothing():
    assert not changes(TEXT, ("wheel", "body"), np.zeros((2, TIME.size))).any()


def test_with_friction_the_change_is_that_of_a_small_load_on_the_wheel():
    """The same force as a known load of the node, downwards on the wheel: it was there before and is coded apart."""
    force, small = np.sin(2.0 * np.pi * 7.0 * TIME), 1.0
    loaded = compile_network(
        parse_network((TEXT + SLIDER).replace("wheel: {mass", "wheel: {hold: loaded, mass"), ELEMENTS)
    )
    answers = [
        loaded.simulate(loaded.prepare(Excitation(excitation().motions, {"wheel": load}, dt=STEP, samples=TIME.size)))
        for load in (-small * force, small * force)
    ]
    expected = 0.5 * (answers[0] - answers[1]) / small
    found = changes(TEXT + SLIDER, ("wheel", "body"), force[None])[0]
    assert np.sqrt(np.mean((found - expected) ** 2)) < 0.02 * np.std(expected)


@pytest.fixture
def rng():
    seed = seed_of("test_influence")
    print(f"seed {seed}")
    return np.random.default_rng(seed)
