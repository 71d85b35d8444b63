"""Lanes are made ready for the constants of many runs at once: in each run they are what they are in it alone."""

from __future__ import annotations

import numpy as np
import pytest
from unit.kernel.networks import compiled

from dashpot.data.drive import drive_from_samples
from dashpot.data.excitation import Excitation
from dashpot.kernel.network import MAKES

OVER = "{fixed: 2e5 N/m, over: {setting: pressure, at: 1 bar, slope: 3e4 N/m/bar}}"
TABLE = "{deflection: [-2 mm, 0 mm, 3 mm], force: [-300 N, 0 N, 500 N]}"
BRANCHES = f"""\
    rubber: {{element: maxwell, stiffness: {OVER}, relaxation_time: 20 ms}}
    curve: {{element: spring, stiffness: {TABLE}}}
"""


def excitations(count):
    """So many short runs, each at a pressure of its own; every third with another step."""
    time = 1e-3 * np.arange(60)
    for number in range(count):
        step = 2e-3 if number % 3 == 0 else 1e-3
        drive = drive_from_samples(step, 1e-3 * np.sin(40.0 * time / (1.0 + 0.01 * number)))
        yield Excitation({"": drive}, settings={"pressure": 1e4 * (1 + number)}, dt=step, samples=60)


@pytest.mark.parametrize("count", [3, MAKES + 20])
def test_lanes_are_the_same_bits_beside_other_runs_and_alone(count):
    together = compiled(BRANCHES)
    lanes = together.start * np.array([[1.0], [1.1], [0.7]])
    runs = [together.prepare(excitation) for excitation in excitations(count)]
    together.expect(runs[:2])
    for values in (lanes, 1.2 * lanes, lanes):
        for run, excitation in zip(runs, excitations(count), strict=True):
            alone = compiled(BRANCHES)
            assert np.array_equal(together.simulate(run, values), alone.simulate(alone.prepare(excitation), values))
