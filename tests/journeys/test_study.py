"""A study that is killed again and again ends with the same bytes as one that was left alone."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

STUDY = """\
format: dashpot-study/1
name: short
about: "Two models on a small virtual measurement."
data: data
amplitude: 2 mm
stages:
  - {name: curve, take: curves}
  - name: dynamics
    free: "*"
    fixed: "stiffness.*"
    runs: dynamic
    optimizer: pso+least_squares
    starts: 2
    budget: 2000
    options: {pso.particles: 16, pso.iterations: 45}
  - {name: joint, free: "*", budget: 400}
models: [kelvin_voigt, {network: gehmann, start_from: kelvin_voigt}]
"""
SPECIMEN = """\
format: dashpot-network/1
name: specimen
branches:
  rubber: {element: spring, stiffness: {polynomial: [180 N/mm, 2 N/mm^2]}}
  slow: {element: maxwell, stiffness: 30 N/mm, relaxation_time: 30 ms}
  oil: {element: damper, damping: 80 N*s/m}
"""
BENCH = """\
format: dashpot-rig/1
name: short
tests:
  - {rig: triangle, depth: 12 mm, speed: 4 mm/s, loops: 2}
  - {rig: hydropulser, amplitudes: [1 mm, 2 mm], preloads: [4 mm, 8 mm], duration: 2 s, direction: up, stop: 20 Hz}
measuring: {force_noise: 5 N, noise_memory: 10 ms}
"""
RESULTS = ("study.json", "report.html", "models.csv", "kelvin_voigt.yaml", "gehmann.yaml")
PATIENCE = 120.0


def dashpot(folder: Path, *arguments: str) -> subprocess.Popen:
    """The command under way in a folder."""
    return subprocess.Popen(
        [sys.executable, "-m", "dashpot", *arguments],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def finished(folder: Path, *arguments: str) -> tuple[int, str]:
    """Exit code and everything said."""
    process = dashpot(folder, *arguments)
    said = "".join(process.communicate(timeout=PATIENCE))
    return process.returncode, said


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """A study, its data, and its results when nobody interferes."""
    made = tmp_path_factory.mktemp("study")
    for name, text in (("short.yaml", STUDY), ("specimen.yaml", SPECIMEN), ("bench.yaml", BENCH)):
        (made / name).write_text(text)
    assert finished(made, "simulate", "specimen.yaml", "--rig", "bench.yaml", "-o", "data")[0] == 0
    code, said = finished(made, "study", "short.yaml", "-o", "whole", "--jobs", "2")
    assert code == 0, said
    return made


def stopped_while_searching(folder: Path, output: str, how: int, grown: int) -> int:
    """Start the study and end it with a signal when its records have grown by so many bytes; the exit code."""
    records = folder / output / "checkpoint"
    process = dashpot(folder, "study", "short.yaml", "-o", output, "--jobs", "1")
    before = recorded(records)
    deadline = time.monotonic() + PATIENCE
    while process.poll() is None and recorded(records) < before + grown and time.monotonic() < deadline:
        time.sleep(0.002)
    process.send_signal(how)
    process.communicate(timeout=PATIENCE)
    return process.returncode


def recorded(folder: Path) -> int:
    """Bytes of all records; those of a finished search count as many."""
    total = 0
    for path in folder.glob("*-*"):
        try:
            total += path.stat().st_size if path.suffix == ".blocks" else 1_000_000
        except FileNotFoundError:
            total += 1_000_000
    return total


def test_the_killed_study_ends_like_the_one_left_alone(folder):
    assert stopped_while_searching(folder, "cut", signal.SIGKILL, 4_000) == -signal.SIGKILL
    assert (folder / "cut" / "checkpoint").exists() and not (folder / "cut" / "study.json").exists()
    assert stopped_while_searching(folder, "cut", signal.SIGINT, 4_000) == 3
    assert stopped_while_searching(folder, "cut", signal.SIGKILL, 1_004_000) == -signal.SIGKILL
    code, said = finished(folder, "study", "short.yaml", "-o", "cut", "--jobs", "1")
    assert code == 0, said
    for name in RESULTS:
        assert (folder / "cut" / name).read_bytes() == (folder / "whole" / name).read_bytes(), name
    assert not (folder / "cut" / "checkpoint").exists()


def test_the_models_come_as_near_to_the_noise_as_their_structure_allows(folder):
    found = json.loads((folder / "whole" / "study.json").read_text())
    voigt, gehmann = (model["rmse"]["train"] for model in found["models"])
    assert gehmann < 0.5 * voigt
    assert [stage["name"] for stage in found["models"][1]["stages"]] == ["dynamics", "joint"]
    assert all(stage["evaluations"] <= 2000 for model in found["models"] for stage in model["stages"])


def test_results_are_not_overwritten_unasked(folder):
    code, said = finished(folder, "study", "short.yaml", "-o", "whole")
    assert code == 1 and "study.json: exists already" in said


def test_a_dry_run_writes_nothing_and_names_the_budget(folder):
    before = sorted(folder.iterdir())
    code, said = finished(folder, "study", "short.yaml", "--dry-run")
    assert code == 0 and "gehmann: " in said and "2400 parameter vectors" in said
    assert sorted(folder.iterdir()) == before
