"""Relaxation that changes with preload: what its cures add is a Maxwell force times a curve through the knots."""

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator
from seeds import seed_of
from unit.causes.test_promises import DAMPING, NETWORK, REGISTRY, VIEW

from dashpot.kernel.eager import simulate_eagerly
from dashpot.model.reading import parse_network

STIFFNESS, TIME = 4e4, 30e-3
RELAXING = NETWORK + f"  soft: {{element: maxwell, stiffness: {STIFFNESS:g} N/m, relaxation_time: {TIME:g} s}}\n"


@pytest.fixture
def rng():
    seed = seed_of("test_preload")
    print(f"seed {seed}")
    return np.random.default_rng(seed)


def suspects(network):
    found = REGISTRY.causes["preload_dependent_damping"]().suspects(VIEW, parse_network(network, REGISTRY.elements))
    return {suspect.form: suspect for suspect in found}


def force(text, run):
    return simulate_eagerly(parse_network(text, REGISTRY.elements), VIEW.drives[run])


def times_curve(suspect, factors, run):
    """The Maxwell branch of RELAXING times a monotone cubic through factors at the knots."""
    curve = PchipInterpolator(suspect.grid, factors)(VIEW.displacement(run))
    return (force(RELAXING, run) - force(NETWORK, run)) * curve


def test_a_factor_on_a_maxwell_branch_multiplies_its_force(rng):
    suspect = suspects(RELAXING)["4 knots on 'soft'"]
    changes = rng.uniform(-0.5, 2.0, len(suspect.grid))
    changes[rng.integers(len(changes))] = 0.0  # the knot that changes least keeps the factor one
    extended = suspect.extend(RELAXING, list(zip(changes, suspect.grid, strict=True)))
    for run in VIEW.runs:
        added, branch = force(extended, run) - force(RELAXING, run), force(RELAXING, run) - force(NETWORK, run)
        # a file holds five digits of a factor
        assert added == pytest.approx(times_curve(suspect, changes, run), abs=2e-4 * np.abs(branch).max())


def test_where_the_branch_is_gone_the_factor_has_a_branch_of_its_own(rng):
    """As when the cause that brought the branch turns out to be superfluous."""
    suspect = suspects(RELAXING)["4 knots on 'soft'"]
    factors = rng.uniform(0.2, 2.0, len(suspect.grid))
    extended = suspect.extend(NETWORK, list(zip(factors, suspect.grid, strict=True)))
    for run in VIEW.runs:
        added, branch = force(extended, run) - force(NETWORK, run), force(RELAXING, run) - force(NETWORK, run)
        # no factor is zero: a thousandth of their range is added to all
        assert added == pytest.approx(times_curve(suspect, factors, run), abs=3e-3 * np.abs(branch).max())


def test_a_new_branch_has_a_relaxation_time_of_the_grid_and_strengths_of_one_sign(rng):
    forms = REGISTRY.causes["preload_dependent_damping"]().suspects(VIEW, parse_network(NETWORK, REGISTRY.elements))
    new = [suspect for suspect in forms if suspect.form.startswith("relaxation")]
    assert all(suspect.sign == 1 and suspect.joint for suspect in new)
    suspect = new[len(new) // 2]
    strengths = rng.uniform(5e3, 5e4, len(suspect.grid))
    extended = suspect.extend(NETWORK, list(zip(strengths, suspect.grid, strict=True)))
    slots = {slot.path: slot.value.number for slot in parse_network(extended, REGISTRY.elements).slots()}
    numbers = {"stiffness": 1.0, "relaxation_time": slots["preload_dependent_damping.relaxation_time"]}
    for run in VIEW.runs:
        added = force(extended, run) - force(NETWORK, run)
        (alone,) = VIEW.respond(run, "maxwell", [numbers])
        curve = PchipInterpolator(suspect.grid, strengths)(VIEW.displacement(run))
        assert added == pytest.approx(alone * curve, abs=0.01 * np.std(added))


def test_damping_of_one_sign_only_where_no_dashpot_can_give_way():
    spring = NETWORK.replace(f"  damping: {{element: damper, damping: {DAMPING:g} N*s/m}}\n", "")
    assert suspects(NETWORK)["4 knots"].sign == 0
    assert suspects(spring)["4 knots"].sign == 1


def test_a_single_knot_is_written_as_a_curve_through_all():
    """Strengths of one sign may leave one knot only: at the others there is next to nothing."""
    suspect = suspects(NETWORK)["relaxation with 4 knots"]
    extended = parse_network(suspect.extend(NETWORK, [(5e4, suspect.grid[2])]), REGISTRY.elements)
    (scale,) = [branch.scale for branch in extended.leaves() if branch.scale]
    assert scale.at == pytest.approx(suspect.grid)
    factors = [value.number for value in scale.values]
    assert factors[2] == 1.0 and max(np.delete(factors, 2)) < 0.1
