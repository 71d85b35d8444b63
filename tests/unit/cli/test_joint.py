"""Joint fits on the command line."""

from __future__ import annotations

import csv
import json

import numpy as np
import pytest
from seeds import seed_of

import dashpot as dp
from dashpot.cli import main
from dashpot.fit.scored import warm_up

STIFFNESS, LOSS = {"soft": 1e5, "hard": 4e5}, 500.0
NETWORK = """format: dashpot-network/1
name: {name}
branches:
  rubber: {{element: spring, stiffness: {{start: 2e5}}}}
  oil: {{element: damper, damping: {{start: 1000}}}}
"""
JOINT = """format: dashpot-joint/1
name: two_mounts
specimens:
  soft: {network: soft.yaml, data: soft}
  hard: {network: hard.yaml, data: hard}
shared: [oil.damping]
"""


@pytest.fixture
def folder(tmp_path):
    """Two mounts of one oil."""
    time = np.arange(0.0, 3.0, 2e-3)
    x = 1e-3 * np.sin(2.0 * np.pi * 3.0 * time)
    v = 6e-3 * np.pi * np.cos(2.0 * np.pi * 3.0 * time)
    chance = np.random.default_rng(seed_of("cli joint"))
    for name, stiffness in STIFFNESS.items():
        force = stiffness * x + LOSS * v + chance.standard_normal(time.size)
        dp.write_dataset(dp.Data.from_arrays(time, x, force, name="sine"), tmp_path / name)
        (tmp_path / f"{name}.yaml").write_text(NETWORK.format(name=name))
    (tmp_path / "two_mounts.yaml").write_text(JOINT)
    return tmp_path


def test_the_files_hold_the_common_parameter_and_the_errors_that_are_told(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)
    assert main(["joint", "two_mounts.yaml", "-o", "together"]) == 0
    told = json.loads((folder / "together/joint.json").read_text())
    [shared] = told["shared"]
    assert shared["value"] == pytest.approx(LOSS, rel=0.014)  # five standard errors of a regression
    [row] = csv.DictReader((folder / "together/shared.csv").open())
    assert row["parameter"] == shared["number"]
    assert (folder / "together/report.html").is_file()
    for name, fit in told["specimens"].items():
        [run] = dp.load_dataset(name).runs
        force = dp.simulate(dp.load(f"together/{name}.yaml"), dp.load_dataset(name))["sine"]
        residual = (run.force - force)[warm_up(run) :]
        assert np.sqrt(np.mean(residual**2)) == pytest.approx(fit["rmse"]["all"], rel=1e-6)


def test_an_unknown_specimen_is_told_before_anything_is_fitted(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)
    (folder / "two_mounts.yaml").write_text(
        JOINT.replace("shared: [oil.damping]", "shared: [{soft: oil.damping, hrad: oil.damping}]")
    )
    assert main(["joint", "two_mounts.yaml", "-o", "together"]) == 1
    assert "hrad" in capsys.readouterr().err
    assert not (folder / "together").exists()


def test_a_specimen_whose_name_cannot_be_that_of_a_file_is_told_before_anything_is_fitted(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)
    (folder / "two_mounts.yaml").write_text(JOINT.replace("soft: {", "../soft: {"))
    assert main(["joint", "two_mounts.yaml", "-o", "together"]) == 1
    assert "two_mounts.yaml:4:12: '../soft' cannot be the name of a specimen. leave out" in capsys.readouterr().err
    assert not (folder / "together").exists()
