"""Every verb that fits looks for faults of the measurement first, says what it found, and goes on with the rest."""

import json

import numpy as np
import pytest

TIME = np.arange(1500) * 2e-3
HEAD = """format: dashpot-dataset/1
name: mounts
defaults:
  channels:
    time: {column: t, unit: s}
    displacement: {column: x, unit: mm}
    force: {column: F, unit: N}
runs:
"""


@pytest.fixture
def folder(tmp_path):
    """Five sines on a spring of 100 N/mm with a dashpot; one force is turned, one is 1000 times as large."""
    rng = np.random.default_rng(1)
    lines = []
    for number, (amplitude, frequency) in enumerate([(1, 2), (2, 2), (3, 3), (1, 5), (2, 4)]):
        x = amplitude * np.sin(2.0 * np.pi * frequency * TIME)
        force = 100.0 * x + 0.8 * np.gradient(x, TIME) + rng.standard_normal(x.size)
        force *= {1: -1.0, 3: 1000.0}.get(number, 1.0)
        table = np.stack([TIME, x, force], axis=1)
        np.savetxt(tmp_path / f"r{number}.csv", table, delimiter=",", header="t,x,F", comments="", fmt="%.9g")
        lines.append(f"  - {{name: r{number}, file: r{number}.csv, kind: harmonic}}\n")
    (tmp_path / "dataset.yaml").write_text(HEAD + "".join(lines))
    return tmp_path


def test_check_names_the_runs_and_what_they_are(call, folder):
    code, out, err = call("check", folder)
    assert (code, out) == (1, "")
    turned, unit = err.splitlines()
    assert "run 'r1': it gives back" in turned and "multiplied by -1 here" in turned and "sign: -1" in turned
    assert "run 'r3'" in unit and "kN written as N" in unit and "multiplied by 0.001 here" in unit


def test_a_diagnosis_names_all_runs_at_fault_and_what_shows_it(call, folder, tmp_path):
    """No run is a repeat of another one: a wrong unit shows beside all others, a wrong sign in the energy."""
    out = "".join(call("diagnose", "kelvin_voigt", folder, "-o", tmp_path / "d")[1:])
    assert "(run 'r1')" in out and "(run 'r3')" in out and "1 more" not in out
    told = json.loads((tmp_path / "d" / "diagnosis.json").read_text())
    assert {fault["run"]: fault["evidence_of"] for fault in told["faults"]} == {"r1": "energy", "r3": "other_runs"}
    assert [cause["evidence_of"] for cause in told["causes"] if cause["cause"] == "gain"] == ["other_runs"]


def test_fit_and_compare_go_on_with_the_mended_runs(call, folder, tmp_path):
    code, _, err = call("fit", "kelvin_voigt", folder, "-o", tmp_path / "fit", "--quiet")
    assert code == 0
    assert "run 'r1': it gives back" in err and "run 'r3'" in err
    found = json.loads((tmp_path / "fit" / "fit.json").read_text())
    damping = next(value for key, value in found["parameters"].items() if key.endswith("damping"))
    assert damping["value"] == pytest.approx(800.0, rel=0.02)
    code, _, err = call("compare", "kelvin_voigt", "--data", folder, "-o", tmp_path / "compared", "--quiet")
    assert code == 0 and "run 'r1': it gives back" in err
    (model,) = json.loads((tmp_path / "compared" / "compare.json").read_text())["models"]
    assert model["rmse"]["all"] < 2.0 and set(model["per_run"]) == {f"r{number}" for number in range(5)}


@pytest.fixture
def all_turned(folder):
    """The same five runs, the force of all of them turned, and in newtons."""
    for number in range(5):
        path = folder / f"r{number}.csv"
        table = np.loadtxt(path, delimiter=",", skiprows=1)
        table[:, 2] *= {1: 1.0, 3: -1e-3}.get(number, -1.0)
        np.savetxt(path, table, delimiter=",", header="t,x,F", comments="", fmt="%.9g")
    return folder


def test_a_sign_that_is_wrong_in_all_runs_is_told_once_by_every_verb(call, all_turned, tmp_path):
    told = "work is given back over closed cycles, "
    assert [line.partition(told)[1] for line in call("check", all_turned)[2].splitlines()] == [told]
    _, _, err = call("fit", "kelvin_voigt", all_turned, "-o", tmp_path / "fit", "--quiet")
    assert err.count(told) == 1 and "all 5 runs" in err
    for verb, name in (("look", "look"), ("diagnose", "diagnosis")):
        more = () if verb == "look" else ("kelvin_voigt",)
        code, out, err = call(verb, *more, all_turned, "-o", tmp_path / verb, "--quiet")
        assert code == 0 and (out + err).count(told) <= 1
        found = json.loads((tmp_path / verb / f"{name}.json").read_text())
        assert {fault["run"] for fault in found["faults"]} == {f"r{number}" for number in range(5)}
        # in the headline, and once among the warnings
        assert (tmp_path / verb / "report.html").read_text().count(told) == 2
