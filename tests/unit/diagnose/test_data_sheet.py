"""What the data sheet of the force channel admits is ordinary; what is beyond it is a finding."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline
from unit.diagnose.laws import CASES
from unit.diagnose.rig import NETWORK, REGISTRY, TIME, dataset, plain, with_force

from dashpot.diagnose.data_sheet import admitted, error_admitted
from dashpot.diagnose.diagnose import diagnose
from dashpot.diagnose.whitening import Noise, whiten_effects
from dashpot.model.reading import parse_network

SHEET = {"gain": 0.01, "zero": 4.0, "delay": 1e-4}
AGAIN = {"again": "a3_p8", "once_more": "a3_p11"}


@given(st.integers(0, 2**32 - 1), st.integers(1, 4), st.floats(1e-3, 1e3))
def test_noise_with_errors_of_known_size_becomes_white(seed, errors, size):
    shapes = size * np.random.default_rng(seed).standard_normal((errors, 12))
    root = whiten_effects(np.eye(12), shapes)
    assert root @ (np.eye(12) + shapes.T @ shapes) @ root.T == pytest.approx(np.eye(12), abs=1e-8)


def test_nothing_admitted_changes_nothing():
    signals = np.arange(8.0).reshape(2, 4)
    assert whiten_effects(signals, np.zeros((0, 4))) is signals
    assert Noise({"run": 1}).beside_admitted("run", signals) is signals


def test_gain_zero_and_delay_are_errors_of_the_force():
    """Of 100 sin(w t): 1 % of it, 4 N, and minus its slope times 0.1 ms; beyond the warm-up.

    On the samples that the search works on, which are fewer than those of a long record.
    """
    time, w = np.linspace(0.0, 1.0, 5001), 2.0 * np.pi * 5.0
    force = 100.0 * np.sin(w * time)
    run = SimpleNamespace(name="run", first=1000, samples=4001, kind="sweep")
    view = SimpleNamespace(force=lambda run: force, step=lambda run: time[1], scored={"run": run})
    longer = SimpleNamespace(name="run", first=3000, samples=12001, kind="sweep")  # before samples were left out
    found = admitted({"run": SHEET}, view, [longer], Noise({"run": 1}))["run"]
    slope = -100.0 * w * np.cos(w * time) * 1e-4
    for shape, expected in zip(found, (0.01 * force, np.full(time.size, 4.0), slope), strict=True):
        assert shape[:-1] == pytest.approx(expected[1000:-1], abs=1e-4)
    square = np.mean((0.01 * force[1000:]) ** 2 + 4.0**2 + slope[1000:] ** 2)
    assert error_admitted({"run": SHEET}, view, [longer]) == pytest.approx(np.sqrt(square), rel=1e-4)
    assert admitted({}, view, [longer], Noise({"run": 1})) == {} and error_admitted({}, view, [longer]) == 0.0


def erring(seed=3):
    """Channels that err within the data sheet, in every run by another draw; nothing is missing in the network."""
    rng, data = np.random.default_rng(seed), dataset(repeats=AGAIN)
    forces = {}
    for run in data.runs:
        gain, zero, delay = rng.normal(0.0, tuple(SHEET.values()))
        late = CubicSpline(TIME, run.force)(np.clip(TIME - delay, 0.0, TIME[-1]))
        forces[run.name] = (1.0 + gain) * late + zero
    return with_force(data, forces)


def told(data, sheet):
    """The verdict, and the accepted causes, where the force channel has a data sheet."""
    runs = tuple(replace(run, sensors={"force": sheet}) for run in data.runs)
    found = diagnose(parse_network(NETWORK, REGISTRY.elements), replace(data, runs=runs), registry=REGISTRY).as_dict()
    return found["verdict"], [cause["cause"] for cause in found["causes"] if cause["accepted"]]


def test_errors_within_the_data_sheet_are_no_finding():
    assert told(erring(), SHEET) == ("nothing_missing", [])
    assert told(erring(), {})[0] != "nothing_missing"


@pytest.mark.parametrize(("zero", "named"), [(1.0, ["offset"]), (40.0, [])])
def test_a_zero_beyond_the_data_sheet_is_one(zero, named):
    data = dataset(repeats=AGAIN, fault={"again": lambda force: force + 40.0})
    assert told(data, {"zero": zero})[1] == named


@pytest.mark.parametrize(("delay", "named"), [(1e-5, ["delay"]), (1.0, [])])
def test_a_delay_of_all_runs_is_one_beyond_the_data_sheet(delay, named):
    law = CASES["delay"].law
    assert told(dataset(lambda motion: plain(motion) + law(motion)), {"delay": delay})[1] == named
