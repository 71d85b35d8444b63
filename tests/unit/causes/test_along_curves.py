"""Relaxation and damping along the curve of a spring: the cure is what the columns showed; a straight one has none."""

import numpy as np
import pytest
from unit.causes.test_promises import NETWORK, REGISTRY, VIEW

from dashpot.kernel.eager import simulate_eagerly
from dashpot.model.reading import parse_network

CURVES = (
    "{polynomial: [200 N/mm, 1 N/mm^2, 2 N/mm^3]}",
    "{deflection: [-10 mm, -2 mm, 0 mm, 5 mm, 20 mm], force: [-1 kN, -300 N, 0 N, 2 kN, 12 kN]}",
)


def forms(text, cause="relaxation", begins="along"):
    found = REGISTRY.causes[cause]().suspects(VIEW, parse_network(text, REGISTRY.elements))
    return [suspect for suspect in found if suspect.form.startswith(begins)]


def damped(text):
    return forms(text, "preload_dependent_damping", "damping in proportion")


def bent(curve):
    return NETWORK.replace("stiffness: 200 N/mm", f"stiffness: {curve}")


def added(text, suspect, atom, drive):
    """What the written network has more than the one before."""
    extended = parse_network(suspect.extend(text, [atom]), REGISTRY.elements)
    return simulate_eagerly(extended, drive) - simulate_eagerly(parse_network(text, REGISTRY.elements), drive)


@pytest.mark.parametrize("curve", CURVES)
def test_the_cure_adds_what_the_columns_show(curve):
    [suspect] = forms(bent(curve))
    for run, drive in VIEW.drives.items():
        found, shown = added(bent(curve), suspect, (0.2, suspect.grid[4]), drive), 0.2 * suspect.columns(VIEW, run)[4]
        assert np.std(found - shown) < 0.02 * np.std(shown)


@pytest.mark.parametrize("curve", CURVES)
def test_a_damping_in_proportion_to_the_slope_is_written_as_it_was_shown(curve):
    [suspect] = damped(bent(curve))
    for run, drive in VIEW.drives.items():
        found, [shown] = added(bent(curve), suspect, (2e-3, 0.0), drive), 2e-3 * suspect.columns(VIEW, run)
        assert np.std(found - shown) < 0.02 * np.std(shown)


def test_a_straight_spring_relaxes_as_a_maxwell_branch_does():
    assert forms(NETWORK) == []


def test_a_damping_in_proportion_to_a_slope_that_hardly_changes_is_a_dashpot():
    assert damped(NETWORK) == []
    assert damped(bent("{polynomial: [200 N/mm, 0.1 N/mm^2]}")) == []
