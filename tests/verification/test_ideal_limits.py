"""Laws at their ideal limits: friction that sticks, and stops, contacts and play that do not give way."""

from __future__ import annotations

import os

import numpy as np
import pytest
from seeds import seed_of
from verification.alone import network_of
from verification.systems import drive_of, excitation, rms, system, times
from verification.truth.at_events import force_on_a_slider
from verification.truth.impacts import Leg, between_stops, carried, pushed_along, thrown_back
from verification.truth.motion import smooth_motion

from dashpot.data.drive import drive_from_path, drive_from_samples
from dashpot.data.excitation import Excitation
from dashpot.kernel.energy import EnergyCounter
from dashpot.kernel.solution import Status
from dashpot.kernel.within import FINEST, TOLERANCE, solve_within

ANEW = "DRAW_SEEDS" in os.environ  # then of draws that nobody has looked at less is asked
PARTS = 500  # of a sample, in the closed form of a slider
BEHIND = "leg: {{series: {{k: {{element: spring, stiffness: {k} N/m}}, it: {{element: {law}}}}}}}"
CARRIED = """
slider: {{element: ideal_coulomb, limit: {limit} N, between: [base, hub]}}
spring: {{element: spring, stiffness: {k} N/m, between: [base, hub]}}
"""
RIGID = 1e12  # N/m


@pytest.fixture
def same_draws(monkeypatch):
    """The draws of ``make test`` in every session, for what was found on them and is no law for all."""
    monkeypatch.delenv("DRAW_SEEDS", raising=False)


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
    # what is extrapolated from two solutions may go beyond
    assert np.max(np.abs(found)) <= limit * (1.0 + (TOLERANCE if ANEW else 1e-9))


def test_an_ideal_slider_does_not_creep_however_long_it_is_held():
    network, at = system("", BEHIND.format(k=1e5, law="ideal_coulomb, limit: 100 N")), times(20.0)
    place = 0.4e-3 * (1.0 - np.cos(np.pi * np.minimum(at / 0.1, 1.0)))
    held = network.solve(network.prepare(Excitation.of_drive(drive_from_samples(at[1], place)))).force[0, 0]
    assert held[[200, -1]] == pytest.approx(80.0, rel=1e-4)
    assert held[200] - held[-1] == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize(("share", "creep"), [(0.1, 1e-5), (0.03, 1e-4), (0.01, 1e-3)])
def test_an_ideal_slider_holds_still_what_friction_pulls_at_just_before_a_sample(share, creep, state):
    # it turns so early before some samples that no step lies between: none of the steps shows what the slider gives way
    dt, limit, amplitude, omega = 4e-3, 10.0, 2e-3, 2.0 * np.pi * 5.0
    at = dt * np.arange(251)
    angle = omega * (at + dt * share)
    place, speed, acceleration = np.cos(angle), -omega * np.sin(angle), -(omega**2) * np.cos(angle)
    path = drive_from_path(dt, *(amplitude * row for row in (place, speed, acceleration)))
    network = system(
        "{base: driven, floor: ground, hub: free}",
        f"rub: {{element: coulomb, limit: {limit} N, creep_velocity: {creep} m/s, between: [base, hub]}}\n"
        "held: {element: ideal_coulomb, limit: 300 N, between: [hub, floor]}",
    )
    found = solve_within(network, Excitation({"base": path}, {}, {}, dt, at.size))
    missed = (found.solution.force[0, 0] - limit * np.tanh(amplitude * speed / creep))[1:]
    state(f"what an ideal slider holds: {rms(missed) / limit:.1e} of the RMS force, bound {found.error[0] / limit:.1e}")
    assert rms(missed) <= found.error[0] + 1e-6 * limit


@pytest.mark.parametrize(("mass", "k", "limit"), [(1.0, 1.0, 20.0), (5.0, 1e3, 60.0), (0.1, 1e2, 2.0)])
def test_a_mass_on_ideal_friction_sticks_and_slides(mass, k, limit, state):
    at, motion = times(1.0), drawn("masses on sliders")
    exact = force_on_a_slider(motion, at, mass, k, limit)
    found, bound = solved(
        system(f"{{base: driven, hub: {{mass: {mass} kg}}}}", CARRIED.format(k=k, limit=limit)),
        at,
        motion,
        FINEST,
    )
    state(f"{mass:g} kg on friction of {limit:g} N: {rms(found - exact) / rms(exact):.1e} of the RMS force")
    assert rms(found - exact) < bound


def test_a_force_that_jumps_just_before_a_sample_is_beyond_the_bound_at_that_sample_alone(same_draws):
    # 1.4 microseconds before this sample the mass sticks: no step is so short
    at, motion, mass, k, limit, late = times(1.0), drawn("masses on sliders"), 1.0, 1.0, 5.0, 894
    before, after = force_on_a_slider(motion, np.append(at[:late], [at[late] - 2e-6, at[late]]), mass, k, limit)[-2:]
    assert after - before > 0.5 * limit
    exact = force_on_a_slider(motion, at, mass, k, limit)
    network = system(f"{{base: driven, hub: {{mass: {mass} kg}}}}", CARRIED.format(k=k, limit=limit))
    within = solve_within(network, excitation(at, {"base": motion}))
    found, others = within.solution.force[0, 0], np.arange(at.size) != late
    assert rms((found - exact)[others]) < within.error[0]
    assert before <= found[late] <= after


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


LOOSE = """
clamp:
  series:
    play: {element: clearance, stiffness: 1e12 N/m, gap: 0.4 mm}
    rubber: {parallel: {k: {element: spring, stiffness: 1e5 N/m}, d: {element: damper, damping: 800 N*s/m}}}
"""


def test_rubber_behind_play_is_a_spring_and_a_damper_in_series_with_rigid_play(state):
    at, motion = times(1.0), drawn("loose rubber")
    exact, bound = solved(system("", LOOSE), at, motion, 256)
    alone = network_of("loose_kelvin_voigt", stiffness="1e5 N/m", damping="800 N*s/m", gap="0.4 mm")
    found = alone.simulate(alone.prepare(drive_of(motion, at)))
    state(f"rubber behind play: {rms(found - exact) / rms(exact):.1e} of the RMS force")
    assert rms(found - exact) < bound + 1e-6 * rms(exact)
    assert np.mean(found == 0.0) > 0.1  # it parts and touches


LEG = """
spring: {{element: spring, stiffness: {k} N/m, between: [base, hub]}}
damper: {{element: damper, damping: {c} N*s/m, between: [base, hub]}}
"""
LOW, HIGH = -3e-3, 2e-3
STOP = "stop: {{element: rigid_stop, compression: {high} m, rebound: {low} m, between: [{ends}]}}"
LEGS = [(3e3, 5.0, 1.0, 0.0), (3e3, 5.0, 1.0, 4.0), (2e4, 40.0, 0.3, 15.0), (2e3, 0.0, 2.0, 0.0)]


def on_the_floor(number, at):
    """A mass between two rigid stops on the floor, on which it may rub: network, excitation, force, phases."""
    k, c, mass, limit = LEGS[number]
    motion = drawn(f"between stops {number}", 6e-3)
    rubbing = f"rub: {{element: ideal_coulomb, limit: {limit} N, between: [hub, floor]}}\n" if limit else ""
    stop = STOP.format(high=HIGH, low=LOW, ends="hub, floor")
    network = system(
        f"{{base: driven, floor: ground, hub: {{mass: {mass} kg}}}}", LEG.format(k=k, c=c) + rubbing + stop
    )
    return network, excitation(at, {"base": motion}), *between_stops(Leg(motion, k, c), mass, limit, LOW, HIGH, at)


def on_the_base(number, at):
    """The same on the driven base, which pushes the mass by its stops."""
    k, c, mass, _ = LEGS[number]
    motion = drawn(f"carried between stops {number}", 6e-3)
    network = system(
        f"{{base: driven, hub: {{mass: {mass} kg}}}}",
        LEG.format(k=k, c=c) + STOP.format(high=HIGH, low=LOW, ends="base, hub"),
    )
    return network, excitation(at, {"base": motion}), *carried(Leg(motion, k, c), mass, LOW, HIGH, 0.0, at)


def on_a_table(number, at):
    """A mass that lies on a shaking table, and is tossed and caught."""
    motion, mass = drawn(f"a table {number}", 15e-3), (0.1, 2.0, 30.0)[number]
    network = system(
        f"{{base: driven, hub: {{mass: {mass} kg}}}}",
        "stop: {element: rigid_stop, compression: 0 mm, between: [base, hub]}",
        "9.81 m/s^2",
    )
    return network, excitation(at, {"base": motion}), *carried(Leg(motion, 0.0, 0.0), mass, -np.inf, 0.0, 9.81, at)


def on_another_mass(number, at):
    """A mass that hits another one, which moves on with it."""
    motion, masses, back = drawn(f"two masses {number}", 6e-3), [(1.0, 1.0), (0.2, 5.0), (3.0, 0.4)][number], 2e4
    network = system(
        f"{{base: driven, floor: ground, hub: {{mass: {masses[0]} kg}}, other: {{mass: {masses[1]} kg}}}}",
        LEG.format(k=3e3, c=5.0)
        + f"back: {{element: spring, stiffness: {back} N/m, between: [other, floor]}}\n"
        + "stop: {element: rigid_stop, compression: 1 mm, between: [hub, other]}",
    )
    return network, excitation(at, {"base": motion}), *pushed_along(Leg(motion, 3e3, 5.0), masses, 1e-3, back, at)


CAUGHT = [(on_the_floor, number) for number in range(4)] + [(on_the_base, number) for number in (0, 3)]
CAUGHT += [(made, number) for made in (on_a_table, on_another_mass) for number in range(3)]
CAUGHT_IDS = [f"{made.__name__}_{number}" for made, number in CAUGHT]


@pytest.mark.parametrize(("made", "number"), CAUGHT, ids=CAUGHT_IDS)
def test_a_mass_that_hits_a_rigid_stop_stays_there_until_it_is_pulled_off(made, number, state):
    network, run, exact, phases = made(number, times(1.0))
    if ANEW and phases <= 4:
        pytest.skip("in this draw the mass hardly ever hits the stop")
    assert phases > 4
    found = solve_within(network, run)
    missed = found.solution.force[0, 0] - exact
    state(f"{made.__name__} {number}: {rms(missed) / rms(exact):.1e} of the RMS force, {found.refine} times the steps")
    assert found.solution.status == (Status.GOOD,)
    assert found.error[0] <= TOLERANCE * rms(found.solution.force[0, 0]) or ANEW and found.refine == FINEST
    assert rms(missed) < found.error[0]
    assert np.max(np.abs(missed)) < found.peak[0]


@pytest.mark.parametrize("made", [on_the_floor, on_the_base, on_a_table, on_another_mass])
def test_the_error_at_rigid_stops_falls_with_the_step(made, state, same_draws):
    numbers = [number for other, number in CAUGHT if other is made]
    cases = [made(number, times(1.0)) for number in numbers]
    shares = [
        [rms(network.solve(network.prepare(run, refine)).force[0, 0] - exact) / rms(exact) for refine in (4, 16, 64)]
        for network, run, exact, _ in cases
    ]
    coarse, middle, fine = np.sqrt(np.mean(np.square(shares), axis=0))
    state(f"{made.__name__} with 4, 16, 64 times the steps: {coarse:.1e}, {middle:.1e}, {fine:.1e} of the RMS force")
    assert fine < 0.4 * middle < 0.16 * coarse


@pytest.mark.parametrize("stiffness", [1e5, 1e6, 1e7, 1e8, 1e10, RIGID])
def test_an_elastic_stop_throws_a_mass_back_or_the_bound_tells_that_its_steps_are_too_long(stiffness, state):
    at, motion = times(1.0), drawn("thrown back", 6e-3)
    exact, phases = thrown_back(Leg(motion, 3e3, 0.0), 1.0, stiffness, HIGH, at)
    stop = f"stop: {{element: end_stop, stiffness: {stiffness} N/m, compression: {HIGH} m, between: [hub, floor]}}"
    network = system("{base: driven, floor: ground, hub: {mass: 1 kg}}", LEG.format(k=3e3, c=0.0) + stop)
    found = solve_within(network, excitation(at, {"base": motion}))
    missed = rms(found.solution.force[0, 0] - exact)
    bound = found.error[0] / rms(exact)
    state(f"an elastic stop of {stiffness:g} N/m: {missed / rms(exact):.1e} of the RMS force, bound {bound:.1e}")
    assert phases > 9
    assert missed < found.error[0]
    # 1e7 N/m hold 1 kg for as long as a sample, 1e10 N/m for a thirtieth of it
    assert bound <= 1.01 * TOLERANCE if stiffness <= 1e7 else stiffness < 1e10 or bound > TOLERANCE


# a second stop lets the last mass be pushed along, or left behind where the others are pulled away
ROW = [
    ("compression: 50 mm, between: [one, two]", "compression: 0 mm, between: [two, three]", "one two three"),
    ("compression: 1 m, rebound: -50 mm, between: [two, one]", "compression: 0 mm, between: [three, two]", "one two"),
]


@pytest.mark.parametrize(("first", "second", "moved"), ROW, ids=["pushed", "pulled"])
def test_masses_in_a_row_keep_their_momentum(first, second, moved):
    at, masses, pushing = times(1.0), {"one": 1e3, "two": 2e3, "three": 500.0}, 5e3
    push = np.where(at < 0.2, pushing * np.sin(np.pi * at / 0.2) ** 2, 0.0)
    joints = ", ".join(f"{name}: {{mass: {mass} kg}}" for name, mass in masses.items())
    springs = [f"of_{name}: {{element: spring, stiffness: 1 N/m, between: [base, {name}]}}" for name in masses]
    stops = [f"stop_{n}: {{element: rigid_stop, {text}}}" for n, text in enumerate((first, second))]
    network = system(
        f"{{base: driven, {joints}}}".replace("kg}", "kg, hold: loaded}", 1), "\n".join([*springs, *stops])
    )
    run = excitation(at, {"base": smooth_motion(np.random.default_rng(0), 0.0, 0.0)}, loads={"one": push})
    found = network.solve(network.prepare(run))
    speeds = dict(zip(network.topology.unknown, (found.motion[0, :, -1] - found.motion[0, :, -201]) / 0.2, strict=True))
    common = 0.5 * pushing * 0.2 / sum(masses[name] for name in moved.split())
    for name, speed in speeds.items():
        assert speed == pytest.approx(common if name in moved.split() else 0.0, rel=1e-3, abs=1e-5)


def test_what_impacts_take_is_missing_in_the_balance_of_energy():
    # pushed by a load alone, a mass hits the floor with the energy that it was given, and once only
    at, mass, pushing = times(0.6), 2.0, 10.0
    push = np.where(at < 0.2, pushing * np.sin(np.pi * at / 0.2) ** 2, 0.0)
    network = system(
        f"{{base: driven, floor: ground, hub: {{mass: {mass} kg, hold: loaded}}}}",
        "soft: {element: spring, stiffness: 1 N/m, between: [base, hub]}\n"
        "stop: {element: rigid_stop, compression: 80 mm, between: [hub, floor]}",
    )
    run = excitation(at, {"base": smooth_motion(np.random.default_rng(0), 0.0, 0.0)}, loads={"hub": push})
    balance = EnergyCounter.of(network.spec).balance(run, pairs=16)
    given = (0.5 * pushing * 0.2) ** 2 / (2.0 * mass)
    assert balance.put_in == pytest.approx(given, rel=1e-2)
    assert balance.stored == pytest.approx(0.5 * 0.08**2, rel=1e-3)
    assert balance.missing == pytest.approx(balance.put_in - balance.stored, rel=1e-6)
