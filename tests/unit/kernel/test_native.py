"""Where compiled networks are kept."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from unit.kernel.networks import compiled, network

from dashpot.kernel.native import cache_folder
from dashpot.kernel.network import compile_network
from dashpot.testing import random_drive
from dashpot.text.problem import InputError

DAMPER = "it: {element: damper, damping: 5}"
OTHER = "other: {element: damper, damping: 7}"
ASK = """
import sys
sys.path[:0] = {path!r}
from unit.kernel.networks import compiled
print(compiled("it: {entry}").native.file, end="")
"""


def compile_elsewhere(entry: str) -> str:
    """The file of a network that another process compiles."""
    code = ASK.format(path=sys.path, entry=entry)
    return subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    monkeypatch.setenv("DASHPOT_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


def test_the_cache_lies_where_the_environment_says(monkeypatch):
    monkeypatch.setenv("DASHPOT_CACHE", "/somewhere/else")
    assert cache_folder() == Path("/somewhere/else")
    monkeypatch.delenv("DASHPOT_CACHE")
    monkeypatch.setenv("XDG_CACHE_HOME", "/of/the/user")
    assert cache_folder() == Path("/of/the/user/dashpot")
    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.delenv("LOCALAPPDATA", raising=False)
    assert cache_folder() == Path.home() / ".cache" / "dashpot"


def test_networks_that_differ_in_numbers_and_names_share_one_file(folder):
    files = {compiled(branches).native.file for branches in (DAMPER, OTHER)}
    assert len(files) == 1
    assert files == set((folder / "kernels").glob("*.py"))
    assert compiled(DAMPER).native is compiled(OTHER).native


def test_another_process_takes_the_machine_code_from_the_cache(folder):
    file = Path(compile_elsewhere("{element: damper, damping: 5}"))
    kept = [file, *(folder / "kernels" / "__pycache__").glob("*.nb*")]
    assert len(kept) > 1
    stamps = {path: path.stat().st_mtime_ns for path in kept}
    assert compile_elsewhere("{element: damper, damping: 7}") == str(file)
    assert {path: path.stat().st_mtime_ns for path in kept} == stamps


def test_a_damaged_file_is_written_again(folder):
    file = compiled("it: {element: inerter, inertance: 5}").native.file
    text = file.read_text()
    file.write_text("raise SystemExit('damaged')\n")
    assert compile_elsewhere("{element: inerter, inertance: 5}") == str(file)
    assert file.read_text() == text


def test_no_half_written_file_stays_behind(folder):
    compiled(DAMPER)
    assert not list((folder / "kernels").glob("*.part"))


def test_a_folder_that_cannot_be_written_is_told_with_the_way_out(tmp_path, monkeypatch):
    (tmp_path / "taken").write_text("a file, not a folder")
    monkeypatch.setenv("DASHPOT_CACHE", str(tmp_path / "taken"))
    with pytest.raises(InputError, match="compiled networks cannot be kept here: .* DASHPOT_CACHE name a folder"):
        compile_network(network(DAMPER))


def test_a_compiled_network_answers_a_lane_and_a_block_alike(folder):
    found = compiled(DAMPER)
    run = found.prepare(random_drive(np.random.default_rng(1), "sweep", 1e-3, 0.01, 50))
    assert found.simulate(run).shape == (50,)
    assert found.simulate(run, found.start).shape == (50,)
    assert found.simulate(run, found.start[None]).shape == (1, 50)
    with pytest.raises(ValueError, match="zip"):
        found.simulate(run, np.ones((2, 5)))
