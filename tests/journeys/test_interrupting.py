"""Ctrl-C ends the command at once, with one line, an exit code of its own, and no half-written file."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

pytestmark = pytest.mark.skipif(os.name == "nt", reason="signals are sent otherwise there")

PROGRAM = "import sys; from dashpot.cli import main; sys.exit(main())"
DATASET = """\
format: dashpot-dataset/1
defaults: {kind: random, channels: {time: t, displacement: x, force: F}}
runs: [{name: a, file: a.csv}, {name: b, file: b.csv}]
"""
STUDY = """\
format: dashpot-study/1
name: long
data: data
stages: [{name: curve, take: curves}, {name: all, optimizer: cmaes, budget: 1000000}]
models: [gehmann]
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    root = tmp_path_factory.mktemp("interrupting")
    (root / "data").mkdir()
    (root / "data" / "dataset.yaml").write_text(DATASET)
    (root / "long.yaml").write_text(STUDY)
    rng = np.random.default_rng(0)
    time_ = np.arange(8000) * 1e-3
    for name in "ab":
        x = 0.02 + 1e-5 * np.cumsum(rng.standard_normal(time_.size))
        rows = np.column_stack([time_, x, 2e5 * x + rng.standard_normal(time_.size)])
        np.savetxt(root / "data" / f"{name}.csv", rows, "%.9g", ",", header="t,x,F", comments="")
    return root


def interrupted(folder: Path, arguments: str, cache: Path) -> tuple[int, str, float]:
    """Exit code and words of a command that is interrupted at its first line, and how long it took to end."""
    process = subprocess.Popen(
        [sys.executable, "-c", PROGRAM, *arguments.split()],
        cwd=folder,
        env={**os.environ, "DASHPOT_CACHE": str(cache)},
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
    )
    assert process.stderr is not None
    first = process.stderr.readline()
    assert first.endswith("...\n"), first
    began = time.monotonic()
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=60)
    return process.returncode, first + error, time.monotonic() - began


COMMANDS = {
    "a fit with workers": ("fit tire_model_5 data -o out --jobs 2", "out"),
    "a comparison": ("compare tire_model_5 gehmann --data data -o table", "table"),
    "a study": ("study long.yaml -o studied", "studied"),
}


@pytest.mark.parametrize("arguments, output", COMMANDS.values(), ids=COMMANDS)
def test_ctrl_c_ends_with_a_line_and_leaves_no_half_file(folder, tmp_path, arguments, output):
    # the first line comes before the network is compiled: the cache is empty
    code, told, seconds = interrupted(folder, arguments, tmp_path / "cache")
    assert code == 3
    assert told.endswith("\ninterrupted; the same command goes on\n") and "Traceback" not in told
    assert seconds < 20.0
    left = [path for path in (folder / output).rglob("*") if path.is_file()]
    assert all("checkpoint" in path.parts for path in left), left
    assert not list(tmp_path.rglob("*.part"))


def test_an_interrupted_study_keeps_its_checkpoint_and_goes_on(folder, tmp_path):
    code, *_ = interrupted(folder, "study long.yaml -o resumed", tmp_path / "cache")
    assert code == 3
    assert (folder / "resumed" / "checkpoint" / "study.txt").is_file()
    code, told, _ = interrupted(folder, "study long.yaml -o resumed", tmp_path / "cache")
    assert code == 3 and "another study" not in told


SHORT = """\
format: dashpot-study/1
name: short
data: data
stages: [{name: all, optimizer: cmaes, budget: 200}]
models: [plain.yaml]
"""
PLAIN = """\
format: dashpot-network/1
name: plain
branches: {k: {element: spring, stiffness: {start: 150 N/mm, bounds: [10 N/mm, 1 kN/mm]}}}
"""
KILLED = """\
import os, sys
replace = os.replace
def at_a_result(source, target):
    if str(target).endswith("study.json"):
        os._exit(137)  # as if the process were killed
    replace(source, target)
os.replace = at_a_result
"""


def test_a_study_that_is_killed_while_its_results_are_written_goes_on(folder):
    (folder / "short.yaml").write_text(SHORT)
    (folder / "plain.yaml").write_text(PLAIN)

    def call(before: str, output: str) -> subprocess.CompletedProcess:
        arguments = ["study", "short.yaml", "-o", output]
        program = [sys.executable, "-c", before + PROGRAM, *arguments]
        return subprocess.run(program, cwd=folder, capture_output=True, text=True)

    assert call("", "whole").returncode == 0
    assert call(KILLED, "killed").returncode == 137
    assert (folder / "killed" / "plain.yaml").exists() and not (folder / "killed" / "study.json").exists()
    # whatever searches again has no method to do it with: all is answered from the checkpoint
    no_search = "import dashpot.fit.study.stage as stage; stage.run_search = None\n"
    again = call(no_search, "killed")
    assert again.returncode == 0, again.stderr
    files = {path.relative_to(folder / "whole"): path.read_bytes() for path in (folder / "whole").rglob("*")}
    assert files == {path.relative_to(folder / "killed"): path.read_bytes() for path in (folder / "killed").rglob("*")}
    assert "exists already" in call("", "killed").stderr


def test_ctrl_c_while_python_still_starts_has_no_traceback(folder):
    # pressed while the command imports its library of options
    program = (
        "import sys\nclass Finder:\n    def find_spec(self, name, *_):\n        if name == 'click':\n"
        "            raise KeyboardInterrupt\nsys.meta_path.insert(0, Finder())\n" + PROGRAM
    )
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert ended.returncode == 3
    assert ended.stderr == "interrupted; nothing was begun\n"


def test_a_reader_that_has_enough_ends_the_command_quietly(folder):
    script = f'"{sys.executable}" -c "{PROGRAM}" list | head -n 1'
    ended = subprocess.run(script, shell=True, capture_output=True, text=True)
    assert ended.stdout.count("\n") == 1 and ended.stderr == ""
