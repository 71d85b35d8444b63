"""Networks of sharply bent laws: every step is solved, and dry friction behind a spring is what a bisection finds."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from seeds import seed_of
from verification.random_systems import draw_system
from verification.systems import DT, excitation, lanes, rms, system, times
from verification.truth.motion import Cosines, smooth_motion
from verification.truth.slipping import slipping_force

from dashpot.kernel.solution import Status
from dashpot.model.element import Motion
from dashpot_elements.stribeck import Stribeck

SLIDER = """
leg:
  series:
    k: {element: spring, stiffness: 100 N/mm}
    c: {element: coulomb, limit: 100 N, creep_velocity: 1 mm/s}
"""
SLOWEST, FEW, MANY = 1e-7, 12, 256
NETWORKS, DRAWS, SOON = 6, 10, 4


def drawn_sliders(network, rng, count):
    return lanes(
        network,
        leg__k__stiffness=10.0 ** rng.uniform(4.0, 6.3, count),
        leg__c__limit=10.0 ** rng.uniform(1.0, 2.5, count),
        leg__c__creep_velocity=10.0 ** rng.uniform(np.log10(SLOWEST), -3.0, count),
    )


@pytest.mark.parametrize("pairs", [1, 4])
def test_dry_friction_behind_a_spring_is_solved_however_stiff(pairs):
    network = system("", SLIDER)
    values = drawn_sliders(network, np.random.default_rng(seed_of("stiff sliders")), MANY)
    # 1 to 20 Hz with an amplitude of 3 mm, from rest
    sweep = Cosines(0.0, np.full(3, 1e-3), 2.0 * np.pi * np.array([1.0, 7.3, 20.0]))
    run = network.prepare(excitation(times(1.0), {network.outputs[0]: sweep}), pairs)
    assert set(network.solve(run, values).status) == {Status.GOOD}


def test_dry_friction_behind_a_spring_converges_to_what_a_bisection_finds(state):
    network, rng = system("", SLIDER), np.random.default_rng(seed_of("sliders and their truth"))
    values, motion, at = drawn_sliders(network, rng, FEW), smooth_motion(rng, 0.0, 3e-3), times(0.3)
    run, found = excitation(at, {network.outputs[0]: motion}), {}
    exact = np.array([slipping_force(motion.place, at.size, at[1], *lane) for lane in values])
    for pairs in (1, 4, 16):
        found[pairs] = rms(network.solve(network.prepare(run, pairs), values).force[:, 0] - exact) / rms(exact)
    worst = {pairs: float(np.max(error)) for pairs, error in found.items()}
    state(
        f"dry friction behind a spring, worst of {FEW} lanes at 1, 1/4 and 1/16 ms: "
        + ", ".join(f"{error:.1e}" for error in worst.values())
    )
    # of first order where the slider is caught within a step
    assert worst[16] < 2e-3 and worst[16] < worst[1] / 8.0


@pytest.mark.parametrize(
    "draw", [*range(SOON), *(pytest.param(draw, marks=pytest.mark.slow) for draw in range(SOON, DRAWS))]
)
def test_random_networks_are_solved(draw):
    rng = np.random.default_rng(seed_of(f"random systems {draw}"))
    for _ in range(NETWORKS):
        nodes, branches = draw_system(rng)
        network = system(nodes, branches)
        run = network.prepare(excitation(times(0.5), {"base": smooth_motion(rng, 0.0, 3e-3)}))
        assert network.solve(run).status == (Status.GOOD,), f"{nodes}\n{branches}"


BENDS = {
    "play and friction": """
        play: {element: backlash, stiffness: 10 N/mm, gap: 0.32 mm, between: [n0, base]}
        friction: {element: coulomb, limit: 22 N, creep_velocity: 0.4 mm/s, between: [n0, wall]}
        """,
    "a slider that holds a node by itself": """
        ideal: {element: ideal_coulomb, limit: 316 N, between: [base, n0]}
        spring: {element: spring, stiffness: 100 N/mm, between: [base, wall]}
        """,
    "sliders of one limit behind springs": """
        upper: {element: spring, stiffness: 2000 N/mm, between: [base, n2]}
        ideal: {element: ideal_coulomb, limit: 316 N, between: [n2, n0]}
        friction: {element: coulomb, limit: 316 N, creep_velocity: 1 mm/s, between: [n0, n1]}
        lower: {element: spring, stiffness: 2000 N/mm, between: [n1, wall]}
        """,
}


@pytest.mark.parametrize("pairs", [1, 4, 16, 64])
@pytest.mark.parametrize("bends", BENDS)
def test_steps_are_solved_where_one_law_is_flat_and_another_one_bends(bends, pairs):
    """Where nothing but the bend of a stiff law holds a node, its place lies between two neighbouring numbers."""
    free = {word for word in ("n0", "n1", "n2") if word in BENDS[bends]}
    nodes = ", ".join(["base: driven", "wall: ground", *(f"{word}: free" for word in sorted(free))])
    network = system("{" + nodes + "}", BENDS[bends])
    sweep = Cosines(0.0, np.full(3, 1e-3), 2.0 * np.pi * np.array([1.0, 7.3, 20.0]))
    run = network.prepare(excitation(times(0.5), {"base": sweep}), pairs)
    assert network.solve(run).status == (Status.GOOD,)


def test_two_equal_sliders_creep_like_one_of_twice_the_velocity(state):
    """Each of them slips half of the way, whatever the force."""
    network = system(
        "{base: driven, wall: ground, m: free, n: free}",
        """
        spring: {element: spring, stiffness: 200 N/mm, between: [base, m]}
        upper: {element: coulomb, limit: 100 N, creep_velocity: 1 mm/s, between: [m, n]}
        lower: {element: coulomb, limit: 100 N, creep_velocity: 1 mm/s, between: [n, wall]}
        """,
    )
    motion, at = smooth_motion(np.random.default_rng(seed_of("two equal sliders")), 0.0, 3e-3), times(0.3)
    exact = slipping_force(motion.place, at.size, at[1], 2e5, 100.0, 2e-3)
    found = network.solve(network.prepare(excitation(at, {"base": motion}), 16))
    error = rms(found.force[0, 0] - exact) / rms(exact)
    state(f"two equal sliders behind a spring, at 1/16 ms: {error:.1e}")
    assert found.status == (Status.GOOD,) and error < 2e-3


@pytest.mark.parametrize("damping", [0.0, 500.0])
def test_the_force_of_friction_that_falls_with_speed_has_no_jump_where_the_path_begins_to_turn(damping):
    # a step over which the path may turn once, twice or not at all, as its last velocity says
    law, numbers = Stribeck(), {"stiffness": 2e5, "limit": 40.0, "breakaway": 60.0, "stribeck_velocity": 0.01}
    parameters = SimpleNamespace(**numbers, decay=2.0, exponent=1.0, bristle_damping=damping)
    rng, widest = np.random.default_rng(seed_of("paths that turn")), {}
    begins, rises = rng.uniform(-0.05, 0.05, (2, 50, 1))
    for count in (1_000, 16_000):
        path = Motion(0.0, DT * rises, begins, np.linspace(-0.1, 0.1, count), 0.0)
        force = law.step(path, SimpleNamespace(force=10.0), parameters, DT).force
        widest[count] = np.abs(np.diff(force)).max(axis=1)
    # a kink as steep as a square root leaves a quarter, a jump all
    assert np.all(widest[16_000] < 0.3 * widest[1_000])


def test_a_record_begins_at_rest_where_no_law_knows_rates():
    # what Newton's method leaves of the equilibrium of stiff springs must not drive the node away
    network = system(
        "{base: driven, wall: ground, n1: free}",
        """
        upper: {element: dahl, stiffness: 100 N/mm, limit: 50 N, between: [base, n1]}
        spring: {element: spring, stiffness: 1100 N/mm, between: [base, n1]}
        lower: {element: contact, stiffness: 3700 N/mm, between: [n1, wall]}
        """,
    )
    rng, place = np.random.default_rng(seed_of("from a place that is pressed")), 5.3e-3
    above, below = 10.0 ** rng.uniform(5.5, 7.0, (2, MANY))
    values = lanes(network, spring__stiffness=above, lower__stiffness=below)
    found = network.solve(network.prepare(excitation(times(0.1), {"base": smooth_motion(rng, place, 1e-3)})), values)
    assert set(found.status) == {Status.GOOD}
    # contact and spring share what the base was moved, before the friction has any force
    np.testing.assert_allclose(found.force[:, 0, 0], above * below / (above + below) * place, rtol=1e-5)
