"""The errors that are told of a network with nodes are those of its simulation, not of the steps of a search."""

import numpy as np
import pytest
from unit.diagnose import machines

from dashpot.contract.registry import load_registry
from dashpot.fit.api import measure_errors, prepare
from dashpot.fit.objective import Objective, as_simulated
from dashpot.fit.scored import warm_up
from dashpot.kernel.api import simulate_runs
from dashpot.kernel.network import compile_network
from dashpot.model.reading import parse_network

REGISTRY = load_registry()
# friction of 60 N that sticks, so that the steps of a search are not those of a simulation
QUARTER_CAR = parse_network(
    """\
format: dashpot-network/1
name: quarter
gravity: 9.81 m/s^2
nodes: {platform: driven, wheel: {mass: 36 kg}, body: {mass: 346 kg}}
branches:
  tire: {between: [platform, wheel], element: spring, stiffness: 200 N/mm}
  loss: {between: [platform, wheel], element: damper, damping: 100 N*s/m}
  suspension: {between: [wheel, body], element: spring, stiffness: 25 N/mm}
  shock_absorber: {between: [wheel, body], element: damper, damping: 1500 N*s/m}
  friction: {between: [wheel, body], element: coulomb, limit: 60 N, creep_velocity: 0.1 mm/s}
""",
    REGISTRY.elements,
)
NAMES = ("first", "second")


@pytest.fixture(scope="module")
def data():
    moves = [machines.sweep(amplitude) for amplitude in (2e-3, 5e-3)]
    rng = np.random.default_rng(2)
    return machines.measured(rng, [machines.quarter_car(60.0, moves)], NAMES, moves)


def test_errors_are_those_of_the_simulated_forces(data):
    told, forces = measure_errors(QUARTER_CAR, prepare(data, 0)).per_run, simulate_runs(QUARTER_CAR, data)
    for run in data.runs:
        error = np.sqrt(np.mean((run.force - forces[run.name])[warm_up(run) :] ** 2))
        assert told[run.name] == pytest.approx(error, rel=1e-6)


def test_a_search_takes_fewer_steps(data):
    runs = list(prepare(data, 0).scored.values())
    told, searched = as_simulated(QUARTER_CAR, runs), Objective(compile_network(QUARTER_CAR), runs)
    for team in told.teams:
        assert told.steps.of(team) > searched.steps.of(team)
