"""Sorted programs on disk: no other process sorts them again, and none is taken for that of another law."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

PARALLEL = "it: {element: maxwell, stiffness: 5, relaxation_time: 0.1}"
SERIES = "it: {series: {k: {element: spring, stiffness: 5}, c: {element: damper, damping: 0.2}}}"
ASK = """
import json, sys
sys.path[:0] = {path!r}
import numpy as np
from dashpot.data.drive import drive_from_samples
from dashpot.kernel.compiler import compile
from unit.kernel.networks import compiled
{before}
found = compiled({network!r})
force = found.simulate(found.prepare(drive_from_samples(1e-3, 1e-3 * np.sin(np.arange(50) / 5.0))))
print(json.dumps(force.tolist()), end="")
"""
SORTS_NOTHING = "compile.sort_tiers = compile._sorted_equations = None"
PRINTS_NOTHING = """
from dashpot.kernel.targets.llvm import source, system_source
source.print_source = system_source.print_system = None
"""
OTHER_LAW = """
from dashpot.model.element import Response
from dashpot_elements import maxwell
inner = maxwell.fading_travel
maxwell.fading_travel = lambda *motion: 2.0 * inner(*motion)
"""


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    monkeypatch.setenv("DASHPOT_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache" / "kernels"


def force_elsewhere(network: str, before: str = "") -> list[float]:
    """The force of a network in another process, which does something before."""
    code = ASK.format(path=sys.path, network=network, before=before)
    return json.loads(subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout)


@pytest.mark.parametrize("network", [PARALLEL, SERIES])
def test_another_process_sorts_and_prints_nothing(folder, network):
    force = force_elsewhere(network)
    assert force_elsewhere(network, SORTS_NOTHING + PRINTS_NOTHING) == force


def test_a_law_of_the_same_name_that_computes_something_else_is_another_one(folder):
    """Here a function that the law calls has changed: nothing in the class of the element tells of it."""
    force = force_elsewhere(PARALLEL)
    other = force_elsewhere(PARALLEL, OTHER_LAW)
    assert other == pytest.approx([2.0 * each for each in force]) and any(force)


DAMAGES = [lambda text: b"", lambda text: text[:-1], lambda text: text.replace(b"add", b"subtract")]


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_file_that_is_not_as_it_was_kept_is_not_read(folder, damage):
    force = force_elsewhere(PARALLEL)
    programs = {file: file.read_bytes() for file in folder.glob("*.program")}
    for file, text in programs.items():
        file.write_bytes(damage(text))
    assert force_elsewhere(PARALLEL, PRINTS_NOTHING) == force
    assert programs and {file: file.read_bytes() for file in folder.glob("*.program")} == programs
