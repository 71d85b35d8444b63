"""``dashpot simulate --energy`` on a small bench, from the command line to the file."""

from __future__ import annotations

import csv

import pytest

BENCH = """format: dashpot-rig/1
name: short
tests:
  - {rig: hydropulser, amplitudes: [1 mm], preloads: [0 mm], direction: up, duration: 1 s, start: 5 Hz}
"""
NETWORK = """format: dashpot-network/1
name: pair
branches:
  spring: {element: spring, stiffness: 20 N/mm}
  dashpot: {element: damper, damping: 300}
"""


@pytest.fixture
def said(call, tmp_path):
    (tmp_path / "bench.yaml").write_text(BENCH)
    (tmp_path / "pair.yaml").write_text(NETWORK)
    arguments = ["simulate", tmp_path / "pair.yaml", "--rig", tmp_path / "bench.yaml", "-o", tmp_path / "out"]
    code, text, error = call(*arguments, "--energy")
    assert code == 0, error
    return text


def test_the_file_holds_every_part_of_every_run(said, tmp_path):
    with (tmp_path / "out" / "energy.csv").open(newline="") as file:
        spring, dashpot = csv.DictReader(file)
    assert [spring["part"], dashpot["element"]] == ["spring", "damper"]
    assert float(spring["dissipated (J)"]) == 0.0
    assert float(dashpot["dissipated (J)"]) == float(dashpot["work (J)"]) > 0.0
    assert spring["run"] == dashpot["run"] != ""


def test_the_terminal_shows_the_sum_of_each_run(said):
    assert all(word in said for word in ("put in (J)", "stored (J)", "dissipated (J)", "missing (J)"))
