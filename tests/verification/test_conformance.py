"""Random networks of all kinds, motions and sampling rates against an integrator that shares nothing with dashpot."""

from __future__ import annotations

import numpy as np
import pytest
from verification.conformance import CASES, measure, rms
from verification.conformance_cases import settled_case
from verification.truth import branches as law
from verification.truth.hybrid import hybrid_force

SAMPLE = 6
LARGEST, HELD = 1e-3, 0.95  # of the root mean square of a force; share of the bounds


def holds(cases, state):
    errors = np.array([case.error for case in cases])
    held, held_peak = (np.mean([getattr(case, key) for case in cases]) for key in ("inside", "inside_peak"))
    state(
        f"{len(cases)} random networks: error {np.median(errors):.1e} in the median, {errors.max():.1e} at most; "
        f"within the bounds {100 * held:.0f} % (RMS), {100 * held_peak:.0f} % (peak)"
    )
    assert errors.max() <= LARGEST
    assert held >= HELD and held_peak >= HELD


def test_random_networks_are_within_a_thousandth_and_their_bounds_hold(state):
    # every fourth one, so that both families, all motions and several sampling rates are among them
    holds([measure(settled_case(4 * number + number % 2)) for number in range(SAMPLE)], state)


@pytest.mark.slow
def test_three_hundred_random_networks_are_within_a_thousandth_and_their_bounds_hold(state):
    holds([measure(settled_case(number)) for number in range(CASES)], state)


def test_nodes_between_stiff_friction_and_contacts_are_balanced(state):
    # two creep velocities of 1e-6 m/s beside a contact: a step that ended where only one of two nodes was balanced
    case = measure(settled_case(147))
    state(f"two nodes between stiff friction and a contact: {case.error:.1e} of the RMS force, bound {case.bound:.1e}")
    assert case.error < LARGEST and case.inside and case.inside_peak


def test_the_integrator_passes_no_reversal_of_the_driven_node():
    # a slider at its limit on the ground, alone: F = limit - stiffness * way back, from the turn at 0.3 of a sample on
    k, limit, amplitude, dt, turn = 2e6, 10.0, 3e-3, 1e-3, 0.0503
    kinds, ends = np.array([law.LOOSE]), np.array([[-1, -2]])
    numbers = np.array([[k, limit, 0.0, 0.0, 0.0, 0.0]])
    waves = np.array([[amplitude, 0.5 * np.pi / turn, -0.5 * np.pi]])
    motion = waves, np.zeros((0, 3)), np.array([0.0, 1.0, 0.0])
    found = hybrid_force(60, dt, np.zeros(0), kinds, ends, numbers, motion, 3e-3, 1e-8)
    back = amplitude * (1.0 - np.sin(0.5 * np.pi / turn * dt * np.arange(60)))
    exact = np.maximum(limit - k * back, -limit)
    assert np.abs(found - exact)[51:].max() < 1e-8 * limit


def test_the_integrator_finds_a_closed_form():
    # a mass between a spring and the ground's dashpot under a sine: the steady state of the transfer function
    k, c, m, omega, amplitude, dt = 4e4, 300.0, 2.0, 2.0 * np.pi * 9.0, 2e-3, 1e-3
    kinds, ends = np.array([law.SPRING, law.DAMPER]), np.array([[-1, 0], [0, -2]])
    numbers = np.array([[k, 0.0, 0.0, 0.0, 0.0, 0.0], [c, 0.0, 0.0, 0.0, 0.0, 0.0]])
    waves = np.array([[amplitude, omega, -0.5 * np.pi]])
    motion = waves, np.zeros((0, 3)), np.array([0.0, 1.0, 0.0])
    found = hybrid_force(2001, dt, np.array([m]), kinds, ends, numbers, motion, 2e-3, 1e-9)
    t = dt * np.arange(2001)
    moved = amplitude * k / (k - m * omega**2 + 1j * omega * c)
    exact = np.imag(k * (amplitude - moved) * np.exp(1j * omega * t))
    late = t > 1.0
    assert rms((found - exact)[late]) < 1e-6 * rms(exact)
