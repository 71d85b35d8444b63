"""Simulated forces are written so that they read back exactly."""

from __future__ import annotations

import sys
from types import SimpleNamespace

import numpy as np
import pytest

from dashpot.text.problem import Place, Problem

NAMES = ("slow", "odd[1]", "file")
FORCES = {"slow": np.array([0.1, 1 / 3]), "odd[1]": np.array([-2.5, 1e-300]), "file": np.array([0.0, -0.0])}
CHANNELS = {"displacement": np.array([0.0, 1e-3]), "force": np.zeros(2)}


class Stream:
    """Three runs."""

    problems = (Problem(Place(), "run 'four' is set aside"),)
    names = NAMES
    conditions = dict.fromkeys(NAMES, {})

    def __iter__(self):
        return iter(SimpleNamespace(name=name, time=np.array([0.0, 0.1]), channels=CHANNELS) for name in NAMES)


def solve_each(spec, runs, count, *, refine, tolerance, progress):
    assert count == len(NAMES)
    for run in runs:
        force = FORCES[run.name]
        yield run, SimpleNamespace(force={"": force}, motion={"hub": force}, error={"": 0.25}, peak={"": 0.5})


@pytest.fixture(autouse=True)
def bench(monkeypatch, layers):
    stream = SimpleNamespace(open_dataset=lambda path, readers, allow_outside: Stream())
    monkeypatch.setitem(sys.modules, "dashpot.data.stream", stream)
    api = SimpleNamespace(
        solve_each=solve_each, forces_by_name=lambda found: {name: each.force[""] for name, each in found.items()}
    )
    monkeypatch.setitem(sys.modules, "dashpot.kernel.api", api)
    settings = SimpleNamespace(require_settings=lambda spec, runs: None)
    monkeypatch.setitem(sys.modules, "dashpot.kernel.settings", settings)


def test_each_run_becomes_a_csv_file(call, tmp_path):
    assert call("simulate", "spring", "--data", "bench.yaml", "-o", tmp_path / "out")[0] == 0
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"slow.csv", "odd[1].csv", "file.csv"}
    text = (tmp_path / "out" / "slow.csv").read_text()
    head = "time,displacement,displacement@hub,force\ns,m,m,N\n"
    assert text == head + "0.0,0.0,0.1,0.1\n0.1,0.001,0.3333333333333333,0.3333333333333333\n"


def test_what_was_found_in_reading_is_told(call, tmp_path):
    code, _, error = call("simulate", "spring", "--data", "bench.yaml", "-o", tmp_path / "out")
    assert code == 0 and "run 'four' is set aside" in error


def test_the_estimated_error_is_told(call, tmp_path):
    told = "".join(call("simulate", "spring", "--data", "bench.yaml", "-o", tmp_path / "out")[1:])
    assert "estimated numerical error of the forces at most 0.25 N rms" in told


def test_an_archive_holds_the_forces_by_run_and_its_bytes_repeat(call, tmp_path):
    for name in ("a.npz", "b.npz"):
        assert call("simulate", "spring", "--data", "bench.yaml", "-o", tmp_path / name)[0] == 0
    with np.load(tmp_path / "a.npz") as archive:
        assert {name: archive[name].tolist() for name in archive} == {k: v.tolist() for k, v in FORCES.items()}
    assert (tmp_path / "a.npz").read_bytes() == (tmp_path / "b.npz").read_bytes()


@pytest.mark.parametrize("output, existing", [("out.npz", "out.npz"), ("out", "out/odd[1].csv")])
def test_nothing_is_overwritten_unasked(call, tmp_path, output, existing):
    arguments = ["simulate", "spring", "--data", "bench.yaml", "-o", tmp_path / output]
    assert call(*arguments)[0] == 0
    code, _, error = call(*arguments)
    assert code == 1
    assert f"{tmp_path / existing}: exists already" in error
    assert call(*arguments, "--force")[0] == 0
