"""Laws that every network with unknown nodes keeps, whatever its numbers and its motion."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from seeds import seed_of
from verification.systems import drawn, excitation, shipped, system, times
from verification.truth.motion import Cosines, smooth_motion

from dashpot.data.drive import drive_from_path
from dashpot.text.quantity import force_dimension

SEEDS = st.integers(0, 2**32 - 1)
few = settings(max_examples=12, deadline=None)
AT = times(0.15)
MEMBERS = (
    "a: {element: spring, stiffness: 60 N/mm}",
    "b: {parallel: {k: {element: spring, stiffness: 90 N/mm}, d: {element: damper, damping: 300 N*s/m}}}",
    "c: {element: maxwell, stiffness: 200 N/mm, relaxation_time: 20 ms}",
)


def forces(network, motions, values=None, settings=None):
    """Forces of one lane (driven nodes, n)."""
    return network.forces(network.prepare(excitation(AT, motions, settings)), values)[0]


def near(found, expected, share=1e-9):
    # Newton's method stops at a millionth of the span of the motion, from where its last step was quadratic
    return np.max(np.abs(found - expected)) <= share * np.max(np.abs(expected))


def leg(*members: str):
    return system("", "leg: {series: {" + ", ".join(members) + "}}", "")


@few
@given(seed=SEEDS)
def test_the_order_of_members_in_series_does_not_matter(seed):
    motion = smooth_motion(np.random.default_rng(seed), 0.0, 4e-3)
    # the driven end knows its velocity, inner nodes have that of the scheme: what stands where changes its small error
    assert near(forces(leg(*MEMBERS[1:], MEMBERS[0]), {"": motion}), forces(leg(*MEMBERS), {"": motion}), 1e-5)


@few
@given(seed=SEEDS)
def test_two_equal_members_in_series_are_one_of_half_the_strength(seed):
    rng = np.random.default_rng(seed)
    motion = smooth_motion(rng, 0.0, 4e-3)
    inner = "{element: maxwell, stiffness: 50 N/mm, relaxation_time: 20 ms}"
    load = "k: {element: spring, stiffness: 120 N/mm}"
    twice, once = leg(f"a: {inner}", f"b: {inner}", load), leg(f"a: {inner}", load)
    values = once.start.copy()
    values[once.paths.index("leg.a.stiffness")] = 25e3
    assert near(forces(twice, {"": motion}), forces(once, {"": motion}, values))


@few
@given(seed=SEEDS)
def test_two_equal_legs_in_parallel_press_twice_as_much(seed):
    motion = smooth_motion(np.random.default_rng(seed), 0.0, 4e-3)
    text = "{series: {k: {element: spring, stiffness: 60 N/mm}, d: {element: damper, damping: 300 N*s/m}}}"
    one, two = system("", f"one: {text}", ""), system("", f"one: {text}\ntwo: {text}", "")
    assert near(forces(two, {"": motion}), 2.0 * forces(one, {"": motion}))


def wheel(platform: str, mass: str, body: str, spring: str, tire: str):
    return system(
        f"{{{platform}: driven, {mass}: {{mass: 40 kg}}, {body}: ground}}",
        f"""
        {spring}: {{element: spring, stiffness: 25 N/mm, between: [{mass}, {body}]}}
        {tire}: {{element: spring, stiffness: 200 N/mm, between: [{platform}, {mass}]}}
        """,
    )


@few
@given(seed=SEEDS)
def test_names_do_not_matter(seed):
    motion = smooth_motion(np.random.default_rng(seed), 0.0, 4e-3)
    plain, other = wheel("platform", "wheel", "body", "spring", "tire"), wheel("z", "a", "k", "y", "b")
    assert near(forces(other, {"z": motion}), forces(plain, {"platform": motion}))


def test_units_of_the_file_do_not_matter():
    motion = smooth_motion(np.random.default_rng(seed_of("test_systems_laws")), 0.0, 4e-3)
    one = system(
        "{table: driven, block: {mass: 3 kg}}",
        "k: {element: spring, stiffness: 25 N/mm, between: [table, block], offset: 2 mm}",
        "9.81 m/s^2",
    )
    other = system(
        "{table: driven, block: {mass: 3000 g}}",
        "k: {element: spring, stiffness: 2.5e4, between: [table, block], offset: 0.2 cm}",
        "981 cm/s^2",
    )
    assert near(forces(other, {"table": motion}), forces(one, {"table": motion}), 1e-13)


@pytest.fixture(scope="module")
def axle():
    return shipped("axle_model_1")


def motions(rng) -> dict[str, Cosines]:
    return {end: smooth_motion(rng, rng.uniform(-4e-3, 4e-3), 3e-3) for end in ("platform_left", "platform_right")}


@few
@given(seed=SEEDS)
def test_an_axle_seen_from_behind_has_its_forces_exchanged(axle, seed):
    rng = np.random.default_rng(seed)
    values, moved = drawn(axle, rng), motions(rng)
    mirrored = dict(zip(moved, reversed(moved.values()), strict=True))
    assert near(forces(axle, mirrored, values), forces(axle, moved, values)[::-1])


@few
@given(seed=SEEDS, factor=st.floats(1e-2, 1e2))
def test_scaling_all_forces_and_masses_scales_the_forces(axle, seed, factor):
    rng = np.random.default_rng(seed)
    values, moved = drawn(axle, rng), motions(rng)
    # a kilogram is a newton at 1 m/s^2
    powers = np.array(
        [1.0 if slot.value.unit == "kg" else force_dimension(slot.value.unit) for slot in axle.spec.slots()]
    )
    scaled = forces(axle, moved, values * factor**powers)
    assert near(scaled, factor * forces(axle, moved, values), 1e-7)


@few
@given(seed=SEEDS, wait=st.integers(1, 100))
def test_what_happens_later_happens_alike(axle, seed, wait):
    rng = np.random.default_rng(seed)
    values, run = drawn(axle, rng), excitation(AT, motions(rng))
    still = np.ones(wait), np.zeros(wait), np.zeros(wait)
    later = {}
    for node, drive in run.motions.items():
        rates = drive.displacement, drive.velocity, drive.acceleration
        begin = (drive.displacement[0] * still[0], still[1], still[2])
        later[node] = drive_from_path(drive.dt, *(np.concatenate(pair) for pair in zip(begin, rates, strict=True)))
    moved = axle.forces(axle.prepare(replace(run, motions=later, samples=run.samples + wait)), values)[0]
    # the record begins with a step of backward Euler, which rests here and moves there
    assert near(moved[:, wait:], axle.forces(axle.prepare(run), values)[0], 1e-5)
    assert np.ptp(moved[:, :wait], axis=1) == pytest.approx(0.0, abs=1e-6)


@few
@given(seed=SEEDS, place=st.floats(-0.02, 0.02))
def test_a_free_body_rides_along_with_its_platform(seed, place):
    car = shipped("quarter_car")
    motion = smooth_motion(np.random.default_rng(seed), 0.0, 3e-3)
    raised = Cosines(motion.mean + place, motion.amplitudes, motion.omegas)
    assert near(forces(car, {"platform": raised}), forces(car, {"platform": motion}), 1e-8)
