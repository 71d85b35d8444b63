"""A corrected dataset, written beside a network, is a dataset like any other for every verb."""

from __future__ import annotations

import json

import numpy as np
import pytest

from dashpot.data.correction import Correction, corrected_text
from dashpot.data.dataset import read_dataset
from dashpot_formats import dashpot_formats

NETWORK = """\
format: dashpot-network/1
name: rod
branches:
  rod: {element: spring, stiffness: {start: 80 N/mm, bounds: [10 N/mm, 1 kN/mm]}}
"""
DATASET = """\
format: dashpot-dataset/1
defaults:
  kind: random
  channels: {time: t, displacement: x, force: F}
runs:
  - file: one.npz
  - file: two.npz
  - file: three.npz
"""
STIFFNESS = 2e5
TIME = 2e-3 * np.arange(1000)
FAULTS = {"one": Correction(offset=40.0, drift=90.0), "two": Correction(gain=1.25, hum=(49.5, 30.0, -12.0))}


@pytest.fixture
def corrected(tmp_path):
    """The folder of a dataset that corrects the faults of one measured beside it."""
    measured, out = tmp_path / "measured", tmp_path / "out"
    measured.mkdir()
    out.mkdir()
    for number, name in enumerate(("one", "two", "three")):
        x = 1e-3 * np.sin(2 * np.pi * (3.0 + number) * TIME) + 4e-4 * np.cos(2 * np.pi * 11.3 * TIME)
        fault = FAULTS.get(name, Correction())
        shown = STIFFNESS * x + Correction(offset=-fault.offset, drift=-fault.drift).apply(np.zeros(TIME.size), 2e-3)
        if fault.hum:
            phase = 2 * np.pi * fault.hum[0] * TIME
            shown += fault.hum[1] * np.cos(phase) + fault.hum[2] * np.sin(phase)
        np.savez(measured / f"{name}.npz", t=TIME, x=x, F=shown / fault.gain if name != "three" else 7 * x)
    (measured / "dataset.yaml").write_text(DATASET)
    (tmp_path / "rod.yaml").write_text(NETWORK)
    dataset = read_dataset(measured, {reader.word: reader() for reader in dashpot_formats()})
    text = corrected_text(dataset, FAULTS, {"three": "it slipped"}, out)
    (out / "dataset.yaml").write_text(text)
    return out


def test_check_praises_it_and_tells_of_the_run_that_is_set_aside(call, corrected):
    code, out, err = call("check", corrected)
    assert (code, out.strip()) == (0, f"{corrected}: good, with 1 warning")
    assert err.strip().endswith("warning: run 'three' (three.npz) is set aside: it slipped")


def test_simulate_leaves_out_what_is_set_aside(call, corrected, tmp_path):
    code, _, err = call("simulate", tmp_path / "rod.yaml", "--data", corrected, "-o", tmp_path / "simulated.npz")
    assert code == 0
    assert err.count("run 'three' (three.npz) is set aside: it slipped") == 1
    assert sorted(np.load(tmp_path / "simulated.npz")) == ["one", "two"]


@pytest.mark.parametrize("verb", ["fit", "compare"])
def test_what_was_hidden_by_the_faults_is_found(call, corrected, tmp_path, verb):
    data = [corrected] if verb == "fit" else ["--data", corrected]
    code, out, err = call(verb, tmp_path / "rod.yaml", *data, "-o", tmp_path / verb, "--json", "--quiet")
    assert code == 0
    assert err.count("is set aside: it slipped") == 1
    found = json.loads(out)
    parameters = found["parameters"] if verb == "fit" else found["models"][0]["parameters"]
    assert parameters["rod.stiffness"]["value"] == pytest.approx(STIFFNESS, rel=1e-9)
