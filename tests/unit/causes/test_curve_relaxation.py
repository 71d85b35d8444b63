"""Relaxation along the curve of a spring: the cure is what the columns showed, and a straight spring has none."""

import numpy as np
import pytest
from unit.causes.test_promises import NETWORK, REGISTRY, VIEW

from dashpot.kernel.eager import simulate_eagerly
from dashpot.model.reading import parse_network

CURVES = (
    "{polynomial: [200 N/mm, 1 N/mm^2, 2 N/mm^3]}",
    "{deflection: [-10 mm, -2 mm, 0 mm, 5 mm, 20 mm], force: [-1 kN, -300 N, 0 N, 2 kN, 12 kN]}",
)


def forms(text):
    found = REGISTRY.causes["relaxation"]().suspects(VIEW, parse_network(text, REGISTRY.elements))
    return [suspect for suspect in found if suspect.form.startswith("along")]


@pytest.mark.parametrize("curve", CURVES)
def test_the_cure_adds_what_the_columns_show(curve):
    text = NETWORK.replace("stiffness: 200 N/mm", f"stiffness: {curve}")
    [suspect] = forms(text)
    extended = parse_network(suspect.extend(text, [(0.2, suspect.grid[4])]), REGISTRY.elements)
    for run, drive in VIEW.drives.items():
        added = simulate_eagerly(extended, drive) - simulate_eagerly(parse_network(text, REGISTRY.elements), drive)
        shown = 0.2 * suspect.columns(VIEW, run)[4]
        assert np.std(added - shown) < 0.02 * np.std(shown)


def test_a_straight_spring_relaxes_as_a_maxwell_branch_does():
    assert forms(NETWORK) == []
