"""What a report takes from networks: identified curves, and the force of each branch."""

from __future__ import annotations

import numpy as np
import pytest

import dashpot as dp
from dashpot.report.networks import branch_forces, identified_curves
from dashpot.report.schematic.wording import branch_lines

TIME = np.arange(0.0, 1.0, 1e-3)
X, V = 1e-3 * np.sin(20.0 * TIME), 2e-2 * np.cos(20.0 * TIME)


@pytest.fixture
def data():
    return dp.Data.from_arrays(TIME, X, 2e5 * X, name="sine")


def test_branches_have_the_forces_of_their_laws_without_the_load_cell(data):
    spring, damper = {"element": "spring", "stiffness": 2e5}, {"element": "damper", "damping": 500.0}
    model = dp.Network("voigt", {"rubber": spring, "oil": damper}, measurement={"force": {"gain": 1.1}})
    found = branch_forces(model, data)
    assert found["rubber"]["sine"] == pytest.approx(2e5 * X)
    assert found["oil"]["sine"] == pytest.approx(500.0 * V, abs=1e-2)
    assert dp.simulate(model, data)["sine"] == pytest.approx(1.1 * (2e5 * X + 500.0 * V), abs=1e-2)


def test_a_single_branch_and_a_network_with_nodes_are_left_out(data):
    assert branch_forces(dp.Network("one", {"rubber": {"element": "spring", "stiffness": 2e5}}), data) == {}
    assert branch_forces(dp.load("axle_model_1"), data) == {}


def test_only_tables_that_were_searched_are_curves():
    table = {"deflection": ["0 mm", "5 mm"], "force": ["0 N", {"value": "1 kN", "interval": ["900 N", "1.1 kN"]}]}
    fixed = {"deflection": ["0 mm", "5 mm"], "force": ["0 N", "1 kN"]}
    model = dp.Network(
        "curves",
        {
            "found": {"element": "spring", "stiffness": table},
            "fixed": {"element": "spring", "stiffness": fixed},
            "straight": {"element": "spring", "stiffness": {"start": "5 N/mm"}},
        },
    )
    [(path, curve)] = identified_curves(model).items()
    assert path == "found.stiffness" and [curve[key] for key in ("over", "over_unit", "told", "unit")] == [
        "deflection",
        "m",
        "force",
        "N",
    ]
    assert curve["at"].tolist() == [0.0, 5e-3] and curve["value"].tolist() == [0.0, 1000.0]
    assert np.isnan(curve["low"][0]) and (curve["low"][1], curve["high"][1]) == (900.0, 1100.0)


def test_the_ends_of_a_long_table_stand_in_one_unit_beside_its_symbol():
    table = {"from": "quasi_static", "deflection": [f"{x} mm" for x in (0.006, 1, 2, 3, 4, 7.994)]}
    table |= {"force": [f"{x} N" for x in (0, 300, 600, 900, 1200, 2400)]}
    model = dp.Network("long", {"rubber": {"element": "spring", "stiffness": table}})
    assert branch_lines(model.leaves()[0])[-1] == "x: 0.006 mm … 7.994 mm"
