"""The posterior on the command line."""

from __future__ import annotations

import csv
import json
import sys

import numpy as np
import pytest
from seeds import seed_of

import dashpot as dp
from dashpot.cli import main

NETWORK = """format: dashpot-network/1
name: mount
branches:
  rubber: {element: spring, stiffness: {start: 1e5}}
  oil: {element: damper, damping: {start: 1000}}
  twice: {element: spring, stiffness: {expression: 0.5 * rubber.stiffness}}
"""


@pytest.fixture
def folder(tmp_path):
    """A network and the dataset of a sine."""
    time = np.arange(0.0, 6.0, 2e-3)
    x = 1e-3 * np.sin(2.0 * np.pi * 3.0 * time)
    v = 6e-3 * np.pi * np.cos(2.0 * np.pi * 3.0 * time)
    noise = np.random.default_rng(seed_of("cli sampler")).standard_normal(time.size)
    data = dp.Data.from_arrays(time, x, 1.5e5 * x + 500.0 * v + noise, name="sine")
    dp.write_dataset(data, tmp_path / "data")
    (tmp_path / "mount.yaml").write_text(NETWORK)
    return tmp_path


def test_the_posterior_is_written_as_json_tables_and_report(folder, monkeypatch, capsys):
    pytest.importorskip("emcee", reason="the extra sampler is not installed")
    monkeypatch.chdir(folder)
    assert main(["fit", "mount.yaml", "data/dataset.yaml", "-o", "out", "--sampler", "emcee", "--jobs", "1"]) == 0
    told = json.loads((folder / "out/fit.json").read_text())["posterior"]
    assert told["converged"]
    assert list(told["parameters"]) == ["rubber.stiffness", "oil.damping", "twice.stiffness"]
    # what follows from a parameter follows it in every draw
    rubber, twice = (told["parameters"][f"{name}.stiffness"] for name in ("rubber", "twice"))
    assert twice["interval"] == pytest.approx([0.5 * each for each in rubber["interval"]])
    rows = list(csv.reader((folder / "out/draws.csv").open()))
    assert rows[0][:3] == ["step", "walker", "rubber.stiffness (N/mm)"]
    median = np.median([float(row[2]) for row in rows[1:]])
    assert median == pytest.approx(1e-3 * rubber["median"], rel=1e-3)
    assert (folder / "out/posterior.csv").read_text().startswith("parameter,posterior: median")
    assert "Traces of the draws" in (folder / "out/report.html").read_text(encoding="utf-8")


def test_without_emcee_nothing_is_begun(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)
    monkeypatch.setitem(sys.modules, "emcee", None)
    assert main(["fit", "mount.yaml", "data/dataset.yaml", "-o", "out", "--sampler", "emcee"]) == 1
    assert "pip install 'dashpot[sampler]'" in capsys.readouterr().err
    assert not (folder / "out").exists()


def test_steps_without_a_sampler_are_refused(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)
    assert main(["fit", "mount.yaml", "data/dataset.yaml", "-o", "out", "--sampler-steps", "500"]) == 2
    assert "name it with --sampler" in capsys.readouterr().err
