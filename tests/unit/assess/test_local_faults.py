"""Faults of single runs: found with their size, in fitted and in held-out runs; silence where there are none."""

from dataclasses import replace

import numpy as np
import pytest

from dashpot.assess.diagnose import diagnose
from dashpot.assess.gain import crossed
from dashpot.contract.registry import load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.model.reading import parse_network

NETWORK = """\
format: dashpot-network/1
name: straight
branches:
  stiffness: {element: spring, stiffness: {start: 150 N/mm}}
  damping: {element: damper, damping: {start: 100 N*s/m}}
"""
TIME = np.arange(3000) * 1e-3
NOISE = 5.0


def dataset(rng, fault=lambda name, force: 0.0, hidden=lambda x: 0.0):
    """Eight sweeps of a straight spring and dashpot, and what is hidden in it; r1 and r5 are held out."""
    runs = []
    for number in range(8):
        amplitude, preload = (1e-3, 3e-3)[number % 2], (5e-3, 10e-3)[number // 4]
        phase = 2.0 * np.pi * (TIME + 2.0 * TIME**2)
        x = preload + amplitude * np.sin(phase)
        force = 2e5 * x + 400.0 * np.gradient(x, 1e-3) + hidden(x)
        force = force + fault(f"r{number}", force) + NOISE * rng.standard_normal(x.size)
        channels = {"displacement": x, "force": force}
        runs.append(Run(f"r{number}", "sweep", TIME, channels, group=f"r{number}", held_out=number in (1, 5)))
    return Dataset("made", tuple(runs))


def causes(data):
    registry = load_registry()
    return diagnose(parse_network(NETWORK, registry.elements), data, registry=registry).as_dict()["causes"]


@pytest.mark.parametrize("run", ["r2", "r5"], ids=["fitted", "held_out"])
@pytest.mark.parametrize("word, shape, size", [
    ("offset", lambda force: 10.0 + 0.0 * force, 10.0),
    ("gain", lambda force: 0.02 * force, 0.02),
    ("drift", lambda force: np.linspace(0.0, 20.0, force.size), 20.0),
])  # fmt: skip
def test_the_fault_of_a_run_is_named_with_its_size(rng, run, word, shape, size):
    found = causes(dataset(rng, lambda name, force: shape(force) if name == run else 0.0))
    assert [cause["cause"] for cause in found] == [word]
    (told,) = (told for name, told in found[0]["parameters"].items() if name.endswith(f"of {run}"))
    # a second run is named by chance in one of a hundred draws, with next to nothing
    others = [other["value"] for other in found[0]["parameters"].values() if other is not told]
    assert len(others) <= 1 and all(abs(other) < 0.2 * size for other in others)
    low, high = told["interval"]
    assert told["value"] == pytest.approx(size, rel=0.1)
    assert low - 0.5 * (high - low) < size < high + 0.5 * (high - low)
    assert 0.0 < found[0]["gain"] < 1.0


def test_a_fault_that_looks_like_two_has_the_name_of_that_which_another_run_has_for_certain(rng):
    """1.5 N on a force of 1 kN that hardly changes may be a gain of 0.15 %; 10 N on one that does are an offset."""
    sizes = {"r0": 1.5, "r1": 10.0}
    (found,) = causes(dataset(rng, lambda name, _: sizes.get(name, 0.0)))
    assert (found["cause"], found["indistinguishable_from"]) == ("offset", [])
    assert {"offset of r0", "offset of r1"} <= found["parameters"].keys()


def test_hum_of_all_runs_is_taken_out_of_the_held_out_ones_too(rng):
    """30 N at 50 Hz and a fifth of it at 150 Hz, of another phase in every run: the noise is left."""

    def hum(name, force):
        angle = 2.0 * np.pi * 50.0 * TIME + int(name[1:])
        return 30.0 * (np.sin(angle) + 0.2 * np.sin(3.0 * angle))

    data, registry = dataset(rng, hum), load_registry()
    found = diagnose(parse_network(NETWORK, registry.elements), data, registry=registry).as_dict()
    assert [cause["cause"] for cause in found["causes"]] == ["hum"]
    told = found["causes"][0]["parameters"]
    assert told["amplitude"]["value"] == pytest.approx(30.0, rel=0.03)
    assert told["amplitude at 150 Hz"]["value"] == pytest.approx(6.0, rel=0.1)
    assert found["rmse"]["after"]["held_out"] == pytest.approx(NOISE, rel=0.1)


def test_what_no_known_cause_explains_in_a_run_is_said_of_that_run(rng):
    registry = load_registry()
    robbed = replace(registry, causes={word: cause for word, cause in registry.causes.items() if word != "gain"})
    data = dataset(rng, lambda name, force: 0.1 * (force - np.mean(force)) if name == "r2" else 0.0)
    found = diagnose(parse_network(NETWORK, registry.elements), data, registry=robbed).as_dict()
    assert (found["verdict"], found["causes"]) == ("unexplained", [])
    assert "run 'r2'" in found["leftover"]["what"]


def test_nothing_is_said_of_sound_runs(rng):
    """Of a hundred draws one may show something by chance, but not of two both."""
    assert causes(dataset(rng)) == [] or causes(dataset(rng)) == []


def test_an_error_that_the_data_sheet_admits_is_no_finding(rng):
    """2 N of offset under a zero error of 3 N; ten times as much is beyond it."""

    def told(size):
        data = dataset(rng, lambda name, force: size if name == "r2" else 0.0)
        sheet = {"force": {"zero": 3.0}}
        return causes(replace(data, runs=tuple(replace(run, sensors=sheet) for run in data.runs)))

    assert told(2.0) == []
    assert [cause["cause"] for cause in told(40.0)] == ["offset"]


@pytest.mark.parametrize(("stop", "named"), [(6e3, ["end_stop", "offset"]), (300e3, ["end_stop"])])
def test_a_fault_of_a_held_out_run_has_to_be_more_than_the_form_of_a_named_cause_may_err(rng, stop, named):
    """An offset of 0.4 of the noise beside a stop that makes 1 or 50 times as much as it."""
    data = dataset(rng, lambda name, _: 2.0 * (name == "r5"), lambda x: stop * np.maximum(x - 11e-3, 0.0))
    found = causes(data)
    alike = {cause["cause"]: "offset" for cause in found if "offset" in cause["indistinguishable_from"]}
    assert [alike.get(cause["cause"], cause["cause"]) for cause in found] == named


def test_crossed_strengths_gain_nothing_from_noise(rng):
    """Twenty shapes fitted to noise lower its square by 20/n; judged on other pieces, n/2 each, they raise it."""
    rises = []
    for _ in range(20):
        noise, rows = rng.standard_normal(3000), rng.standard_normal((20, 3000))
        rises.append(np.mean(crossed(noise, rows, 1e-3) ** 2) - np.mean(noise**2))
    # the rise of one draw deviates by 0.006
    assert np.mean(rises) == pytest.approx(20 / 1500, abs=0.008)


def test_crossed_strengths_take_out_what_is_there(rng):
    noise, row = rng.standard_normal(3000), np.sin(TIME)[None]
    left = crossed(noise + 7.0 * row[0], row, 1e-3)
    assert np.mean(left**2) == pytest.approx(np.mean(noise**2), rel=0.01)
