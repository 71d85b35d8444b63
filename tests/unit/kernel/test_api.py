"""Simulating the runs of a dataset."""

from __future__ import annotations

import numpy as np
import pytest
from unit.kernel.networks import network

from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.kernel.api import simulate_runs
from dashpot.text.problem import InputError

DT = 1e-3
TIME = DT * np.arange(600)


def run(name: str, frequency: float) -> Run:
    channels = {"displacement": 1e-3 * np.sin(2.0 * np.pi * frequency * TIME), "force": np.zeros(600)}
    return Run(name, "harmonic", TIME, channels, source="a.csv")


DATASET = Dataset("bench", (run("slow", 1.0), run("fast", 9.0)))


def test_the_force_of_every_run_is_answered_by_its_name():
    found = simulate_runs(network("it: {element: spring, stiffness: 2e5}"), DATASET)
    assert list(found) == ["slow", "fast"]
    for name, force in found.items():
        assert force == pytest.approx(2e5 * DATASET.run(name).displacement, abs=1e-9)


def test_the_force_is_what_the_load_cell_shows():
    measurement = "measurement: {force: {gain: 1.5, offset: 10 N, delay: 2 ms}}\n"
    found = simulate_runs(network("it: {element: spring, stiffness: 2e5}", measurement), DATASET)["fast"]
    expected = 1.5 * 2e5 * 1e-3 * np.sin(2.0 * np.pi * 9.0 * (TIME - 2e-3)) + 10.0
    assert found[5:] == pytest.approx(expected[5:], abs=1e-3)


def test_velocities_are_taken_from_the_displacement():
    found = simulate_runs(network("it: {element: damper, damping: 100}"), DATASET)["fast"]
    expected = 100.0 * 1e-3 * 2.0 * np.pi * 9.0 * np.cos(2.0 * np.pi * 9.0 * TIME)
    assert found[5:-5] == pytest.approx(expected[5:-5], rel=1e-5)


def test_a_network_may_be_named_or_lie_in_a_file(tmp_path):
    spec = network("it: {element: maxwell, stiffness: 1e4, relaxation_time: 10 ms}")
    file = tmp_path / "n.yaml"
    file.write_text(spec.document.text)
    assert np.array_equal(simulate_runs(file, DATASET)["slow"], simulate_runs(spec, DATASET)["slow"])


def test_a_curve_that_is_still_to_come_from_data_is_told():
    with pytest.raises(
        InputError, match="the curve 'stiffness.stiffness' is to be taken from data .* fit the network first"
    ):
        simulate_runs("gehmann", DATASET)


def test_a_run_without_displacement_is_told():
    odd = Run("odd", "harmonic", TIME, {"force": np.zeros(600)}, source="a.csv")
    with pytest.raises(InputError, match="a.csv: run 'odd' has no channel 'displacement'"):
        simulate_runs(network("it: {element: spring, stiffness: 2e5}"), Dataset("bench", (odd,)))
