"""Dynamic stiffness of networks against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

import dashpot as dp
from dashpot.text.problem import InputError

FREQUENCY = np.array([0.5, 5.0, 25.0])
OMEGA = 2.0 * np.pi * FREQUENCY


def network(branches, **keys):
    return dp.Network("network", branches, **keys)


def test_linear_branches_have_their_complex_stiffness():
    model = network(
        {
            "spring": {"element": "spring", "stiffness": 2e5},
            "damper": {"element": "damper", "damping": 300.0},
            "maxwell": {"element": "maxwell", "stiffness": 6e4, "relaxation_time": 0.02},
            "inerter": {"element": "inerter", "inertance": 3.0},
        }
    )
    turning = 1j * OMEGA
    expected = 2e5 + 300.0 * turning + 6e4 * 0.02 * turning / (1.0 + 0.02 * turning) + 3.0 * turning**2
    found = model.dynamic_stiffness(FREQUENCY[:, None], [1e-4, 1e-3], 5e-3)
    assert found.shape == (3, 2)
    assert found == pytest.approx(np.repeat(expected[:, None], 2, axis=1), rel=1e-5)


def test_slow_relaxation_is_waited_for():
    model = network({"maxwell": {"element": "maxwell", "stiffness": 1e5, "relaxation_time": 5.0}})
    turn = 2.0j * np.pi * 10.0 * 5.0
    assert model.dynamic_stiffness(10.0, 1e-3) == pytest.approx(1e5 * turn / (1.0 + turn), rel=2e-4)


def test_a_carried_mass_resonates():
    model = network(
        {
            "mount": {"element": "spring", "stiffness": 2e5, "between": ["platform", "engine"]},
            "loss": {"element": "damper", "damping": 2e3, "between": ["platform", "engine"]},
        },
        nodes={"platform": "driven", "engine": {"mass": "40 kg"}},
    )
    carrying, mass = 2e5 + 2e3j * OMEGA, -40.0 * OMEGA**2
    assert model.dynamic_stiffness(FREQUENCY, 1e-3) == pytest.approx(carrying * mass / (carrying + mass), rel=2e-3)


def test_a_load_cell_that_lags_turns_the_stiffness():
    model = network({"spring": {"element": "spring", "stiffness": 2e5}}, measurement={"force": {"delay": "1 ms"}})
    assert model.dynamic_stiffness(FREQUENCY, 1e-3) == pytest.approx(2e5 * np.exp(-1e-3j * OMEGA), rel=1e-5)


def test_numbers_over_settings_need_their_setting():
    warm = {"fixed": 2e5, "over": {"setting": "temperature", "slope": 1e3, "at": 300.0}}
    model = network({"spring": {"element": "spring", "stiffness": warm}})
    assert model.dynamic_stiffness(5.0, 1e-3, temperature=310.0) == pytest.approx(2.1e5, rel=1e-9)
    with pytest.raises(InputError, match="temperature"):
        model.dynamic_stiffness(5.0, 1e-3)


def test_frequencies_and_amplitudes_may_be_texts():
    spring = dp.declare("format: dashpot-network/1\nname: s\nbranches: {a: {element: spring, stiffness: 200 N/mm}}")
    found = spring.dynamic_stiffness([["1 Hz"], ["600 rpm"]], ["0.5 mm", "1 mm"], "2 mm")
    assert found.shape == (2, 2) and found == pytest.approx(np.full((2, 2), 2e5 + 0j))
    with pytest.raises(ValueError, match=r"got the shapes \(2,\), \(3,\), \(\)"):
        spring.dynamic_stiffness([1.0, 2.0], [1e-3, 2e-3, 3e-3])


def test_what_has_no_dynamic_stiffness_is_told():
    spring = network({"spring": {"element": "spring", "stiffness": 2e5}})
    with pytest.raises(ValueError, match="expected frequencies .* above 0"):
        spring.dynamic_stiffness(0.0, 1e-3)
    with pytest.raises(InputError, match="one driven end, got 2"):
        dp.load("axle_model_1").dynamic_stiffness(5.0, 1e-3)


def test_what_does_not_settle_is_told():
    free = network(
        {"mount": {"element": "spring", "stiffness": 2e5, "between": ["platform", "engine"]}},
        nodes={"platform": "driven", "engine": {"mass": "40 kg"}},
    )
    with pytest.warns(RuntimeWarning, match="does not settle within 256 periods of 5.1 Hz"):
        free.dynamic_stiffness(5.1, 1e-3)
