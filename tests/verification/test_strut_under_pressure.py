"""A strut of gas, rubber and a valve behind oil, measured under three pressures: a fit finds its numbers.

The truth is integrated here, with laws written anew.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from dashpot import load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.data.stream import open_dataset
from dashpot.data.writing import dataset_files
from dashpot.fit.api import fit_network
from dashpot.kernel.api import simulate_runs
from dashpot.kernel.settings import require_settings
from dashpot.model.reading import parse_network
from dashpot.text.problem import InputError

REGISTRY = load_registry()
TIME = 1e-3 * np.arange(1500)
AREA, LENGTH, POLYTROPE = 1e-3, 0.08, 1.3
RUBBER, DAMPING, KNEE, OIL = 3e4, 3e3, 0.05, 2e5
NOISE = 1.0
STRUT = """\
format: dashpot-network/1
name: strut
branches:
  gas:
    element: gas_spring
    force: {start: 500 N, over: {setting: pressure, at: 2 bar, slope: {start: 0 N/bar}}}
    length: {start: 100 mm}
    exponent: 1.3
  rubber: {element: spring, stiffness: {start: 10 N/mm}}
  oil:
    element: valve
    stiffness: {start: 100 N/mm}
    compression: {start: 1 N*s/mm}
    rebound: {start: 1 N*s/mm}
    compression_knee: {start: 0.1 m/s}
    rebound_knee: {start: 0.1 m/s}
"""


def force_of(pressure, amplitude, omega):
    def rate(t, w):
        slope = DAMPING / (1.0 + abs(w[0]) / KNEE) ** 2
        return [OIL * (amplitude * omega * np.cos(omega * t) - w[0]) / slope]

    x = amplitude * np.sin(omega * TIME)
    answer = solve_ivp(rate, (0.0, TIME[-1]), [amplitude * omega], t_eval=TIME, method="LSODA", rtol=1e-8, atol=1e-11)
    w = answer.y[0]
    return x, AREA * pressure * (1.0 - x / LENGTH) ** -POLYTROPE + RUBBER * x + DAMPING * w / (1.0 + np.abs(w) / KNEE)


def strut():
    rng, runs = np.random.default_rng(5), []
    for pressure in (1e5, 2e5, 3e5):
        for amplitude, frequency in ((20e-3, 1.5), (4e-3, 10.0)):
            x, force = force_of(pressure, amplitude, 2.0 * np.pi * frequency)
            name = f"p{pressure / 1e5:g}_{frequency:g}"
            channels = {"displacement": x, "force": force + NOISE * rng.standard_normal(x.size)}
            runs.append(Run(name, "harmonic", TIME, channels, {"pressure": pressure}, group=name))
    return Dataset("strut", tuple(runs))


@pytest.fixture(scope="module")
def found():
    return fit_network(parse_network(STRUT, REGISTRY.elements), strut(), registry=REGISTRY)


def test_a_fit_finds_the_numbers_of_the_strut(found):
    numbers = {slot.path: slot.value.number for slot in found.fitted.slots()}
    truth = {
        "gas.force": AREA * 2e5,
        "gas.force.slope": AREA,
        "gas.length": LENGTH,
        "rubber.stiffness": RUBBER,
        "oil.stiffness": OIL,
        "oil.compression": DAMPING,
        "oil.rebound": DAMPING,
        "oil.compression_knee": KNEE,
        "oil.rebound_knee": KNEE,
    }
    assert {path: numbers[path] for path in truth} == pytest.approx(truth, rel=0.02)
    assert found.errors.train == pytest.approx(NOISE, rel=0.05)
    assert found.errors.held_out == pytest.approx(NOISE, rel=0.05)


def test_the_file_that_was_written_gives_the_error_that_was_told(found):
    written = parse_network(found.identified_text, REGISTRY.elements)
    for run in found.dataset.runs:
        force = simulate_runs(written, Dataset("one", (run,)))[run.name]
        first = run.time.size - 1000
        assert np.std(force[first:] - run.force[first:]) == pytest.approx(NOISE, rel=0.15)


def test_a_dataset_file_without_the_setting_is_refused_before_a_run_is_read(tmp_path):
    for name, text in dataset_files("strut", strut().runs).items():
        text = text.replace("pressure: 2", "inflation: 2") if name.endswith(".yaml") else text
        (tmp_path / name).write_text(text)
    runs = open_dataset(tmp_path / "dataset.yaml", {})
    with pytest.raises(InputError) as caught:
        require_settings(parse_network(STRUT, REGISTRY.elements), runs.conditions)
    assert {f"run '{name}'" in str(caught.value) for name in ("p2_1.5", "p2_10")} == {True}
    assert "run 'p1_1.5'" not in str(caught.value)
