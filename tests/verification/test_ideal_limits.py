"""Laws at their ideal limits: friction that sticks, and stops, contacts and play that do not give way."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of
from verification.alone import network_of
from verification.systems import drive_of, excitation, rms, system, times
from verification.truth.at_events import force_on_a_slider
from verification.truth.motion import smooth_motion

from dashpot.data.drive import drive_from_samples
from dashpot.data.excitation import Excitation
from dashpot.kernel.solution import Status
from dashpot.kernel.within import TOLERANCE, solve_within

PARTS = 500  # of a sample, in the closed form of a slider
BEHIND = "leg: {{series: {{k: {{element: spring, stiffness: {k} N/m}}, it: {{element: {law}}}}}}}"
CARRIED = """
slider: {{element: ideal_coulomb, limit: {limit} N, between: [base, hub]}}
spring: {{element: spring, stiffness: {k} N/m, between: [base, hub]}}
"""
RIGID = 1e12  # N/m


def drawn(seed, amplitude=3e-3):
    return smooth_motion(np.random.default_rng(seed_of(seed)), 0.0, amplitude)


def solved(network, at, motion, finest):
    """The force within the tolerance with so many times as many steps as usual at most, and its bound."""
    found = solve_within(network, excitation(at, {network.outputs[0]: motion}))
    assert found.solution.status == (Status.GOOD,)
    assert found.refine <= finest
    assert found.error[0] <= TOLERANCE * rms(found.solution.force[0, 0])
    return found.solution.force[0, 0], found.error[0]


@pytest.mark.parametrize(("k", "limit"), [(1e4, 10.0), (1e5, 100.0), (2e6, 300.0), (2e6, 10.0)])
def test_an_ideal_slider_behind_a_spring_is_the_stop_operator(k, limit, state):
    at, motion, exact, force = times(1.0), drawn("ideal sliders"), [0.0], 0.0
    for way in np.diff(motion.place(np.linspace(0.0, at[-1], PARTS * (at.size - 1) + 1))):
        force = min(max(force + k * way, -limit), limit)
        exact.append(force)
    exact = np.array(exact)[::PARTS]
    network = system("", BEHIND.format(k=k, law=f"ideal_coulomb, limit: {limit} N"))
    found, bound = solved(network, at, motion, 16)
    state(f"an ideal slider of {limit:g} N behind {k:g} N/m: {rms(found - exact) / rms(exact):.1e} of the RMS force")
    assert rms(found - exact) < bound
    assert np.max(np.abs(found)) <= limit * (1.0 + 1e-9)


def test_an_ideal_slider_does_not_creep_however_long_it_is_held():
    network, at = system("", BEHIND.format(k=1e5, law="ideal_coulomb, limit: 100 N")), times(20.0)
    place = 0.4e-3 * (1.0 - np.cos(np.pi * np.minimum(at / 0.1, 1.0)))
    held = network.solve(network.prepare(Excitation.of_drive(drive_from_samples(at[1], place)))).force[0, 0]
    assert held[[200, -1]] == pytest.approx(80.0, rel=1e-4)
    assert held[200] - held[-1] == pytest.approx(0.0, abs=1e-6)


COMES_TO_REST = pytest.param(
    1.0,
    1.0,
    5.0,
    marks=pytest.mark.xfail(strict=True, reason="it sticks just as the base is fastest: one sample beyond the bound"),
)


@pytest.mark.parametrize(("mass", "k", "limit"), [(1.0, 1.0, 20.0), (5.0, 1e3, 60.0), (0.1, 1e2, 2.0), COMES_TO_REST])
def test_a_mass_on_ideal_friction_sticks_and_slides(mass, k, limit, state):
    at, motion = times(1.0), drawn("masses on sliders")
    exact = force_on_a_slider(motion, at, mass, k, limit)
    found, bound = solved(
        system(f"{{base: driven, hub: {{mass: {mass} kg}}}}", CARRIED.format(k=k, limit=limit)), at, motion, 64
    )
    state(f"{mass:g} kg on friction of {limit:g} N: {rms(found - exact) / rms(exact):.1e} of the RMS force")
    assert rms(found - exact) < bound


@pytest.mark.parametrize("k", [1e4, 2e6])
@pytest.mark.parametrize(
    ("law", "low", "high"),
    [
        ("contact", -np.inf, 0.0),
        ("end_stop, compression: 0.5 mm, rebound: -0.3 mm", -0.3e-3, 0.5e-3),
        ("clearance, gap: 0.4 mm", -0.4e-3, 0.4e-3),
    ],
)
def test_what_is_rigid_behind_a_spring_takes_all_that_goes_beyond(k, law, low, high, state):
    at, motion = times(1.0), drawn("rigid limits")
    place = motion.place(at)
    exact = k * (np.maximum(place - high, 0.0) + np.minimum(place - low, 0.0))
    network = system("", BEHIND.format(k=k, law=f"{law}, stiffness: {RIGID} N/m"))
    found, _ = solved(network, at, motion, 2)
    state(
        f"{law.split(',')[0]} of {RIGID:g} N/m behind {k:g} N/m: {rms(found - exact) / rms(exact):.1e} of the RMS force"
    )
    # what it gives way by is the share of its compliance
    assert rms(found - exact) < 1.01 * k / RIGID * rms(exact)


def test_play_alone_is_the_play_operator():
    at, motion, gap, k = times(1.0), drawn("rigid play"), 0.4e-3, 1e5
    exact, follower = [0.0], 0.0
    for place in motion.place(np.linspace(0.0, at[-1], PARTS * (at.size - 1) + 1))[1:]:
        follower = min(max(follower, place - gap), place + gap)
        exact.append(k * follower)
    exact = np.array(exact)[::PARTS]
    network = network_of("backlash", stiffness=f"{k} N/m", gap=f"{gap} m")
    found = network.simulate(network.prepare(drive_of(motion, at)))
    # along the cubic between the samples
    assert rms(found - exact) < 1e-6 * rms(exact)


def test_rigid_friction_behind_play_is_that_of_the_spring_in_series():
    # a spring in series with a rigid branch takes over its part: play, a spring and a slider are loose_friction
    at, motion, k, limit = times(1.0), drawn("rigid friction"), 1e5, 60.0
    behind = BEHIND.format(k=k, law=f"loose_friction, limit: {limit} N, stiffness: 1e10 N/m, gap: 0.3 mm")
    found, bound = solved(system("", behind), at, motion, 64)
    alone = network_of("loose_friction", limit=f"{limit} N", stiffness=f"{k} N/m", gap="0.3 mm")
    exact = alone.simulate(alone.prepare(drive_of(motion, at)))
    assert rms(found - exact) < bound + 1.01 * k / 1e10 * rms(exact)
