"""The dynamic stiffness of a network at the rows of a table; truth: its complex stiffness."""

from __future__ import annotations

import numpy as np
import pytest

from dashpot.cli import main

DATASET = """\
format: dashpot-dataset/1
name: supplier
tables:
  - file: t.csv
    settings: {amplitude: 1 mm}
    columns: {frequency: f, stiffness: K, loss_angle: d}
"""
RUNS = """\
runs:
  - name: a
    file: a.npz
    kind: random
    channels: {time: {column: t, unit: s}, displacement: {column: x, unit: mm}, force: {column: F, unit: N}}
"""
NETWORK = """\
format: dashpot-network/1
name: mount
branches:
  rubber: {element: spring, stiffness: 200 N/mm}
  oil: {element: damper, damping: 100 N*s/m}
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "t.csv").write_text("f,K,d\nHz,N/mm,deg\n5,200,3\n20,210,7\n")
    (tmp_path / "dataset.yaml").write_text(DATASET)
    (tmp_path / "n.yaml").write_text(NETWORK)
    return tmp_path


def test_a_table_holds_the_stiffness_of_the_network_beside_the_measured_one(folder):
    code = main(["simulate", str(folder / "n.yaml"), str(folder), "--table", "-o", str(folder / "out")])
    assert code == 0
    names, units, *lines = (folder / "out" / "stiffness.csv").read_text().splitlines()
    assert units.split(",")[:4] == ["Hz", "m", "m", "N/m"]
    for line, frequency, size in zip(lines, (5.0, 20.0), (200e3, 210e3), strict=True):
        found = dict(zip(names.split(","), map(float, line.split(",")), strict=True))
        assert found["frequency"] == frequency and found["amplitude"] == 1e-3
        assert found["storage"] + 1j * found["loss"] == pytest.approx(2e5 + 200j * np.pi * frequency, rel=1e-5)
        assert found["loss_angle"] == pytest.approx(np.degrees(np.arctan(200 * np.pi * frequency / 2e5)), rel=1e-4)
        assert found["measured_stiffness"] == pytest.approx(size)


def test_a_table_needs_tables(folder, capsys):
    assert main(["simulate", str(folder / "n.yaml"), "--table", "--rig", "tire_bench", "-o", str(folder / "out")]) != 0
    assert "--table goes with DATASET" in capsys.readouterr().err
    np.savez(folder / "a.npz", t=np.arange(400) / 1000, x=np.sin(0.1 * np.arange(400)), F=np.cos(0.1 * np.arange(400)))
    (folder / "dataset.yaml").write_text(DATASET.partition("tables")[0] + RUNS)
    assert main(["simulate", str(folder / "n.yaml"), str(folder), "--table", "-o", str(folder / "out")]) != 0
    assert "has no table of dynamic stiffness" in capsys.readouterr().err
