"""A fit takes as many steps as keep its numerical error small, run by run; all lanes of a block take the same ones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from dashpot import load_registry
from dashpot.data.drive import drive_from_samples
from dashpot.data.excitation import Excitation
from dashpot.fit import enough_steps
from dashpot.fit.enough_steps import FINEST, EnoughSteps
from dashpot.fit.objective import Objective
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.network import compile_network
from dashpot.kernel.within import TOLERANCE, told_within
from dashpot.model.reading import parse_network

ELEMENTS = load_registry().elements
DT, SAMPLES = 2e-3, 250
STOPPED = """
format: dashpot-network/1
name: stopped
nodes: {base: driven, hub: {mass: 2 kg}, wall: ground}
branches:
  spring: {element: spring, stiffness: 40 N/mm, between: [base, hub]}
  loss: {element: damper, damping: 150 N*s/m, between: [hub, wall]}
  stop: {element: end_stop, stiffness: 400 N/mm, compression: 1 mm, rebound: -1 mm, between: [hub, wall]}
"""
ALONE = "format: dashpot-network/1\nname: alone\nbranches: {k: {element: spring, stiffness: 10 N/mm}}\n"


def compiled(text):
    return compile_network(parse_network(text, ELEMENTS))


def moved(amplitude, frequency=9.0):
    return drive_from_samples(DT, amplitude * (1.0 - np.cos(2.0 * np.pi * frequency * DT * np.arange(SAMPLES))))


def scored(name, amplitude, frequency=9.0):
    drive = moved(amplitude, frequency)
    return ScoredRun(name, "harmonic", drive, np.zeros(SAMPLES), 0, "base", whole=Excitation.of_drive(drive))


@pytest.fixture(scope="module")
def network():
    return compiled(STOPPED)


@pytest.fixture(scope="module")
def truth(network):
    drive = Excitation.of_drive(moved(3e-3))
    return network.solve(network.prepare(drive, 256)).force[0, 0]


def away(found, truth):
    return np.sqrt(np.mean((found - truth) ** 2) / np.mean(truth**2))


def test_a_run_that_meets_a_stop_takes_more_steps_than_one_that_does_not(network):
    steps = EnoughSteps(network, [scored("small", 1e-5, 2.0), scored("large", 3e-3)])
    for team in ((0,), (1,)):
        steps.suffice(team, network.start)
    assert steps.of((0,)) < steps.of((1,)) <= FINEST


def test_the_force_that_a_fit_is_linearised_at_is_within_the_tolerance(network, truth):
    objective = Objective(network, [scored("large", 3e-3)])
    [usual] = network.solve(network.prepare(Excitation.of_drive(moved(3e-3)))).force[0]
    [rows] = objective.linearise(network.start, np.eye(network.start.size)[:1], lambda number, rows: rows.copy())
    assert away(rows[0] / objective.factor(0), truth) <= TOLERANCE < away(usual, truth)
    # steps that were needed once stay
    assert away(objective.forces(network.start)[0][0], truth) <= TOLERANCE


def test_steps_are_not_measured_where_the_solution_itself_tells_that_they_are_enough(network, monkeypatch):
    objective, asked = Objective(network, [scored("small", 1e-5, 2.0), scored("large", 3e-3)]), []
    for team in objective.teams:
        objective.steps.of(team)
    monkeypatch.setattr(objective.steps, "suffice", lambda team, values: asked.append(team))
    for _ in objective.linearise(network.start, np.eye(network.start.size)[:1], lambda number, rows: None):
        pass
    assert asked == [(1,)]


def test_what_a_solution_tells_is_a_bound(network, truth):
    drive = Excitation.of_drive(moved(3e-3))
    for refine in (1, 4, 16, 64):
        found = network.solve(network.prepare(drive, refine))
        for tolerance in (1e-1, 1e-2, 1e-3, 1e-4):
            assert not told_within(found, tolerance) or away(found.force[0, 0], truth) <= tolerance
    assert told_within(found, 1e-2) and not told_within(found, 0.0)


def test_changes_are_differences_of_lanes_with_the_same_steps(network):
    objective, move = Objective(network, [scored("large", 3e-3)]), np.zeros((1, network.start.size))
    move[0, network.paths.index("stop.stiffness")] = 1e-3 * network.start[network.paths.index("stop.stiffness")]
    [rows] = objective.linearise(network.start, move, lambda number, rows: rows.copy())
    rows /= objective.factor(0)
    run = network.prepare(Excitation.of_drive(moved(3e-3)), objective.steps.of((0,)))
    base, other = network.forces(run, np.concatenate([network.start[None], network.start + move]))[:, 0]
    np.testing.assert_array_equal(rows[1], other - base)


def test_a_lane_that_cannot_be_solved_and_a_network_without_nodes_take_the_usual_steps(network):
    steps, broken = EnoughSteps(network, [scored("large", 3e-3)]), np.full_like(network.start, np.nan)
    steps.suffice((0,), broken)
    assert EnoughSteps(compiled(ALONE), [scored("any", 3e-3)]).of((0,)) == 1
    assert steps._refine[(0,)] == 1


def test_what_was_measured_to_be_enough_is_not_measured_again_where_the_steps_agree_as_well(network, monkeypatch):
    steps, run = EnoughSteps(network, [scored("large", 3e-3)]), network.prepare(Excitation.of_drive(moved(3e-3)))
    steps._refine[(0,)] = 1
    measured = []
    monkeypatch.setattr(enough_steps, "steps_within", lambda *given: measured.append(given) or 1)
    solution = network.solve(run)
    assert not told_within(solution)
    assert all(steps.tell((0,), solution, network.start) for _ in range(3)) and len(measured) == 1
    worse = replace(solution, error=1.01 * solution.error)
    assert steps.tell((0,), worse, network.start) and len(measured) == 2
    # when they are more, nothing is known of these
    monkeypatch.setattr(enough_steps, "steps_within", lambda *given: measured.append(given) or 2)
    assert not steps.tell((0,), replace(solution, error=2.0 * solution.error), network.start)
    assert steps.tell((0,), solution, network.start) and len(measured) == 4
