"""What holds for all motions and all numbers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from seeds import seed_of
from verification.alone import network_of
from verification.shipped import NAMES, Dice, filled

from dashpot import load_registry
from dashpot.data.drive import Drive, drive_from_path
from dashpot.kernel.network import compile_network
from dashpot.model.reading import parse_network
from dashpot.testing import MOTIONS, draw_sizes, draw_specimens, random_drive
from dashpot.text.quantity import force_dimension

SEEDS = st.integers(0, 2**32 - 1)
KINDS = st.sampled_from(sorted(MOTIONS))
ODD = [
    "backlash",
    "bedding_in",
    "bouc_wen",
    "clearance",
    "compliant_damper",
    "coulomb",
    "dahl",
    "damper",
    "fading_damper",
    "fading_spring",
    "inerter",
    "iwan",
    "loose_friction",
    "loose_kelvin_voigt",
    "maxwell",
    "mullins",
    "power_law_damper",
    "prandtl",
    "preload_creep",
    "proportional_damper",
    "quadratic_damper",
    "rattling_mass",
    "sliding_mass",
    "softening",
    "spring",
    "stiffening_maxwell",
    "stribeck",
    "stribeck_curve",
    "worn_damper",
]
RATE_INDEPENDENT = {
    "dahl": {"stiffness": 6e4, "limit": 15.0},
    "prandtl": {"stiffness": 6e4, "limit": 15.0},
    "bouc_wen": {"stiffness": 6e4, "limit": 15.0, "shape": 0.8, "exponent": 2.0},
    "iwan": {"stiffness": 6e4, "shortest": 1e-4, "longest": 5e-3},
    "bedding_in": {"stiffness": 6e4, "depth": 2e-3},
    "mullins": {"stiffness": 6e4, "depth": 2e-3},
    "backlash": {"stiffness": 6e4, "gap": 5e-4},
    "loose_friction": {"limit": 15.0, "stiffness": 6e4, "gap": 5e-4},
    "directional_friction": {"stiffness": 6e4, "compression": 15.0, "rebound": 25.0},
    "side_load_friction": {"stiffness": 6e4, "limit": 15.0, "growth": 4e3, "middle": 1e-3},
    "loaded_slider": {"stiffness": 6e4, "limit": 15.0, "growth": 4e3, "middle": 1e-3},
}
SCALED = {
    "damper": "damping: 200 N*s/m",
    "maxwell": "stiffness: 12 N/mm, relaxation_time: 20 ms",
    "dahl": "stiffness: 60 N/mm, limit: 15 N",
    "prandtl": "stiffness: 20 N/mm, limit: 20 N",
}

few = settings(max_examples=15, deadline=None)


def motion(seed: int, kind: str = "multisine", samples: int = 250) -> Drive:
    """From rest, with no velocity at all at its first sample."""
    drive = random_drive(np.random.default_rng(seed), kind, 4e-3, 0.01, samples, 1e-3)
    still = np.concatenate([[0.0], np.ones(samples - 1)])
    return drive_from_path(drive.dt, drive.displacement, drive.velocity * still, drive.acceleration * still)


def simulate(network, drive, values=None):
    return network.simulate(network.prepare(drive), values)


def near(found, expected):
    return np.max(np.abs(found - expected)) <= 1e-11 * np.max(np.abs(expected))


@pytest.fixture(scope="module", params=NAMES)
def network(request):
    return compile_network(filled(request.param, Dice(seed_of("test_laws"))))


@few
@given(seed=SEEDS, kind=KINDS, factor=st.floats(1e-3, 1e3))
def test_scaling_all_forces_scales_the_force(network, seed, kind, factor):
    powers = np.array([force_dimension(slot.value.unit) for slot in network.spec.slots()])
    drive = motion(seed, kind)
    assert near(simulate(network, drive, network.start * factor**powers), factor * simulate(network, drive))


@few
@given(seed=SEEDS, kind=KINDS, wait=st.integers(1, 300))
def test_what_happens_later_happens_alike(network, seed, kind, wait):
    drive = motion(seed, kind)
    held = np.full(wait, drive.displacement[0]), np.zeros(wait), np.zeros(wait)
    rates = drive.displacement, drive.velocity, drive.acceleration
    later = drive_from_path(drive.dt, *(np.concatenate(pair) for pair in zip(held, rates, strict=True)))
    assert near(simulate(network, later)[wait:], simulate(network, drive))


@few
@given(seed=SEEDS, kind=KINDS, count=st.integers(2, 249))
def test_the_future_does_not_change_the_past(network, seed, kind, count):
    drive = motion(seed, kind)
    cut = drive_from_path(drive.dt, drive.displacement[:count], drive.velocity[:count], drive.acceleration[:count])
    assert np.array_equal(simulate(network, cut), simulate(network, drive)[:count])


@pytest.mark.parametrize("word", ODD)
@few
@given(seed=SEEDS, kind=KINDS)
def test_the_mirrored_motion_gives_the_mirrored_force(word, seed, kind):
    """The place of a play is mirrored with the motion."""
    rng = np.random.default_rng(seed)
    specimen = draw_specimens(load_registry().elements[word], rng, draw_sizes(rng), 4)[0]
    network, drive = compile_network(specimen.spec), motion(seed, kind)
    mirrored = replace(
        drive,
        displacement=-drive.displacement,
        velocity=-drive.velocity,
        acceleration=-drive.acceleration,
        turn_displacement=-drive.turn_displacement,
    )
    side = np.array([-1.0 if path.endswith(".place") else 1.0 for path in network.paths])
    assert near(simulate(network, mirrored, specimen.values * side), -simulate(network, drive, specimen.values))


@pytest.mark.parametrize("word", ["clearance", "loose_kelvin_voigt"])
@few
@given(seed=SEEDS, kind=KINDS, place=st.floats(-5e-3, 5e-3))
def test_play_about_a_place_is_that_of_a_motion_measured_from_there(word, seed, kind, place):
    further = {"damping": 300.0} if word == "loose_kelvin_voigt" else {}
    plain = network_of(word, stiffness=6e4, gap=5e-4, **further)
    placed = network_of(word, stiffness=6e4, gap=5e-4, place=place, **further)
    drive = motion(seed, kind)
    away = replace(drive, displacement=drive.displacement - place, turn_displacement=drive.turn_displacement - place)
    assert near(simulate(placed, drive), simulate(plain, away))


@pytest.mark.parametrize("word", ODD)
@few
@given(seed=SEEDS, kind=KINDS)
def test_two_branches_in_parallel_are_one_of_twice_the_strength(word, seed, kind):
    rng = np.random.default_rng(seed)
    specimen = draw_specimens(load_registry().elements[word], rng, draw_sizes(rng), 4)[-1]
    twin = replace(specimen.branch, name="twin")
    both = replace(specimen.spec, root=replace(specimen.spec.root, members=(specimen.branch, twin)))
    strength = np.array([2.0 ** force_dimension(slot.value.unit) for slot in specimen.spec.slots()])
    drive = motion(seed, kind)
    found = simulate(compile_network(both), drive, np.concatenate([specimen.values] * 2, axis=1))
    assert near(found, simulate(compile_network(specimen.spec), drive, specimen.values * strength))


@few
@given(first=SEEDS, second=SEEDS, factor=st.floats(-10.0, 10.0))
def test_a_maxwell_element_is_linear_in_its_motion(first, second, factor):
    network = network_of("maxwell", stiffness=1e4, relaxation_time=0.02)
    a, b = motion(first), motion(second)
    pairs = [(getattr(a, key), getattr(b, key)) for key in ("displacement", "velocity", "acceleration")]
    both = drive_from_path(a.dt, *(x + factor * y for x, y in pairs))
    assert near(simulate(network, both), simulate(network, a) + factor * simulate(network, b))


@few
@given(seed=SEEDS, speed=st.floats(0.01, 100.0))
def test_friction_does_not_know_how_fast_it_is_moved(seed, speed):
    drive = motion(seed)
    faster = replace(
        drive, dt=drive.dt / speed, velocity=drive.velocity * speed, acceleration=drive.acceleration * speed**2
    )
    for element, numbers in RATE_INDEPENDENT.items():
        network = network_of(element, **numbers)
        assert np.array_equal(simulate(network, faster), simulate(network, drive))


@pytest.mark.parametrize("element", SCALED)
@few
@given(seed=SEEDS, factors=st.lists(st.floats(0.05, 20.0), min_size=4, max_size=4))
def test_a_factor_over_its_own_deflection_keeps_an_element_passive(element, seed, factors):
    text = (
        f"format: dashpot-network/1\nname: scaled\nbranches:\n  it: {{element: {element}, {SCALED[element]}, "
        f"scale: {{deflection: [-3 mm, -1 mm, 1 mm, 3 mm], factor: {factors}}}}}\n"
    )
    network = compile_network(parse_network(text, load_registry().elements))
    drive = random_drive(np.random.default_rng(seed), "multisine", 4e-3, 0.01, 6000, 1e-4)
    force = simulate(network, drive)
    pieces = 0.5 * (force[1:] + force[:-1]) * np.diff(drive.displacement)
    assert np.min(np.cumsum(pieces)) >= -1e-3 * np.sum(np.abs(pieces))


@few
@given(seed=SEEDS)
def test_a_factor_multiplies_the_force_of_its_branch(seed):
    factors = np.random.default_rng(seed).uniform(0.1, 10.0, 3)
    text = (
        "format: dashpot-network/1\nname: scaled\nbranches:\n  it: {element: dahl, stiffness: 60000, limit: 15 N, "
        f"scale: {{deflection: [-2 mm, 0 mm, 2 mm], factor: {factors.tolist()}}}}}\n"
    )
    drive = motion(seed)
    found = simulate(compile_network(parse_network(text, load_registry().elements)), drive)
    plain = simulate(network_of("dahl", stiffness=6e4, limit=15.0), drive)
    low, high = drive.displacement <= -2e-3, drive.displacement >= 2e-3
    assert found[low] == pytest.approx(factors[0] * plain[low], rel=1e-12)
    assert found[high] == pytest.approx(factors[2] * plain[high], rel=1e-12)
