"""Networks of sharply bent laws: every step is solved, and dry friction behind a spring is what a bisection finds."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of
from verification.random_systems import draw_system
from verification.systems import excitation, lanes, rms, system, times
from verification.truth.motion import Cosines, smooth_motion
from verification.truth.slipping import slipping_force

from dashpot.kernel.system import Status

SLIDER = """
leg:
  series:
    k: {element: spring, stiffness: 100 N/mm}
    c: {element: coulomb, limit: 100 N, creep_velocity: 1 mm/s}
"""
SLOWEST, FEW, MANY = 1e-7, 12, 256
NETWORKS, DRAWS = 60, 10


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


@pytest.mark.parametrize("draw", range(DRAWS))
def test_random_networks_are_solved(draw):
    rng = np.random.default_rng(seed_of(f"random systems {draw}"))
    for _ in range(NETWORKS // DRAWS):
        nodes, branches = draw_system(rng)
        network = system(nodes, branches)
        run = network.prepare(excitation(times(0.5), {"base": smooth_motion(rng, 0.0, 3e-3)}))
        assert network.solve(run).status == (Status.GOOD,), f"{nodes}\n{branches}"
