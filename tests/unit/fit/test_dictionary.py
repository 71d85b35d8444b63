"""The start from a dictionary of branches."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of
from unit.kernel.networks import network

from dashpot.fit.coordinates import search_coordinates
from dashpot.fit.dictionary import SHAPES, dictionary_start
from dashpot.fit.objective import Objective
from dashpot.fit.ranges import natural_sizes, with_ranges
from dashpot.fit.refine import refine
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.network import compile_network
from dashpot.testing import random_drive

DT, SAMPLES = 1e-3, 6000
TIRE = """
    carcass: {element: spring, stiffness: {start: 100 N/mm}}
    damping: {element: damper, damping: {start: 30 N*s/m}}
    rubber: {repeat: 2, element: maxwell, stiffness: {start: 1 N/mm}, relaxation_time: {start: [90 ms, 20 ms]}}
    filler: {repeat: 2, element: prandtl, stiffness: {start: 1 N/mm}, limit: {start: [1 N, 4 N]}}
"""


@pytest.fixture
def rng() -> np.random.Generator:
    seed = seed_of("test_dictionary")
    print(f"seed {seed}")
    return np.random.default_rng(seed)


def posed(rng, branches, true, noise=0.0, more=""):
    """The objective and the coordinates of branches on three runs of a network whose numbers are ``true``."""
    spec = network(branches, more)
    compiled, runs = compile_network(spec), []
    for number, amplitude in enumerate((1e-3, 2e-3, 5e-3)):
        drive = random_drive(rng, "multisine", DT, amplitude, SAMPLES)
        force = compiled.simulate(compiled.prepare(drive), np.asarray(true)) + noise * rng.standard_normal(SAMPLES)
        runs.append(ScoredRun(f"r{number}", "random", drive, force, 100))
    ranged = with_ranges(spec, natural_sizes(runs))
    return Objective(compile_network(ranged), runs), search_coordinates(ranged)


def test_what_is_linear_is_solved_at_once(rng):
    branches = """
        carcass: {element: spring, stiffness: {start: 3 N/mm}}
        damping: {element: damper, damping: {start: 30 N*s/m}}
        offset: {element: spring, stiffness: 5 N/mm}
    """
    objective, coordinates = posed(rng, branches, [2e5, 700.0, 5e3], noise=50.0)
    start = dictionary_start(objective, coordinates)
    rows, aims = [], []
    for run in objective.runs:
        x, v = run.drive.displacement[100:], run.drive.velocity[100:]
        rows.append(np.column_stack([x, v]))
        aims.append(run.force[100:] - 5e3 * x)
    expected = np.linalg.lstsq(np.concatenate(rows), np.concatenate(aims), rcond=None)[0]
    assert np.allclose(np.exp(start.point), expected, rtol=1e-6)
    assert start.evaluations == 2


def test_a_shape_on_the_grid_is_found_with_its_strength(rng):
    objective, coordinates = posed(rng, TIRE, [2e5, 700.0, 1e3, 0.09, 1e3, 0.02, 1e3, 1.0, 1e3, 4.0])
    sizes = natural_sizes(objective.runs)
    times = np.geomspace(2.0 * sizes.shortest, sizes.longest, SHAPES)[[4, 9]]
    truth = [2e5, 700.0, 8e3, times[0], 12e3, times[1], 1e-3, 1.0, 1e-3, 1.0]
    objective, coordinates = posed(np.random.default_rng(1), TIRE.split("filler")[0], truth[:6])
    found = dict(zip(coordinates.paths, np.exp(dictionary_start(objective, coordinates).point), strict=True))
    strengths = {found[f"rubber_{k}.relaxation_time"]: found[f"rubber_{k}.stiffness"] for k in (1, 2)}
    assert np.allclose(sorted(strengths), np.sort(times), rtol=0.05)
    assert np.allclose([strengths[time] for time in sorted(strengths)], [8e3, 12e3], rtol=0.05)


def test_a_few_steps_from_there_reach_the_noise(rng):
    """Of five draws four do within the budget; the other one may still be on its way."""

    def over_noise():
        true = np.array([2e5, 700.0, 8e3, 0.15, 12e3, 0.012, 20e3, 8.0, 12e3, 40.0])
        true *= np.exp(rng.uniform(-0.5, 0.5, true.size))
        objective, coordinates = posed(rng, TIRE, true, noise=10.0)
        start = dictionary_start(objective, coordinates)
        found = refine(objective, coordinates, start.point, budget=2 * 96 - start.evaluations)
        return found.loss / objective.losses(true[None])[0]

    reached = np.sort([over_noise() for _ in range(5)])
    assert reached[3] < 1.01
    assert reached[4] < 1.1


def test_no_start_where_the_force_is_not_a_sum_of_branches(rng):
    series = "it: {series: {a: {element: spring, stiffness: 5 N/mm}, b: {element: damper, damping: {start: 9 N*s/m}}}}"
    drive = random_drive(rng, "multisine", DT, 1e-3, 300)
    spec = with_ranges(network(series), natural_sizes([ScoredRun("r", "random", drive, np.zeros(300), 0)]))
    objective = Objective(compile_network(spec), [ScoredRun("r", "random", drive, np.zeros(300), 0)])
    assert dictionary_start(objective, search_coordinates(spec)) is None


def test_no_start_where_the_load_cell_alters_the_force(rng):
    branches = "it: {element: spring, stiffness: {start: 5 N/mm}}"
    objective, coordinates = posed(
        rng, branches, [5e3, 1.0], more="measurement: {force: {gain: {start: 1.1, bounds: [0.5, 2]}}}"
    )
    assert dictionary_start(objective, coordinates) is None


def test_no_start_where_no_searched_number_is_proportional_to_a_force(rng):
    """Of a slider with a known stiffness the limit alone does not scale the force."""
    branches = "it: {element: dahl, stiffness: 5 N/mm, limit: {start: 3 N, bounds: [1 N, 9 N]}}"
    objective, coordinates = posed(rng, branches, [5e3, 3.0])
    assert dictionary_start(objective, coordinates) is None
