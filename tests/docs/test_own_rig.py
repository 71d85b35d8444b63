"""The page about rigs, specimens and exports of one's own: its code runs, and gives what the page says."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from architecture.source import ROOT
from docs.test_pages import blocks

import dashpot as dp
from dashpot import load_registry

PAGE = ROOT / "docs" / "how-to" / "own-rig.md"


@pytest.fixture(scope="module")
def names():
    """What the code blocks define, run one after the other."""
    found: dict = {}
    exec("\n".join(blocks(PAGE, "python")), found)
    return found


def test_the_rates_of_the_planned_motion_are_its_derivatives(names):
    runs = list(names["Steps"](preload=5e-3, frequency=4.0, amplitudes=(1e-3,)).runs())
    [path] = runs[0].motion.values()
    assert np.mean(path.displacement) == pytest.approx(5e-3, rel=1e-9)
    assert np.ptp(path.displacement) == pytest.approx(2e-3, rel=1e-9)
    for rate, motion in ((path.velocity, path.displacement), (path.acceleration, path.velocity)):
        slope = np.gradient(motion, runs[0].sample_time, edge_order=2)
        assert rate == pytest.approx(slope, abs=1e-2 * np.abs(rate).max())


def test_a_spring_on_the_rig_gives_its_stiffness_times_the_motion(names):
    spring = dp.declare("format: dashpot-network/1\nname: s\nbranches: {k: {element: spring, stiffness: 2 N/mm}}")
    registry = replace(load_registry(), rigs={"amplitude_ladder": names["Steps"]})
    measured = dp.measure(spring, "amplitude_ladder", preload="5 mm", amplitudes="1 mm, 2 mm", registry=registry)
    assert [run.settings["amplitude"] for run in measured.runs] == [1e-3, 2e-3]
    for run in measured.runs:
        assert np.mean(run.displacement) == pytest.approx(5e-3, rel=1e-6)
        assert run.force == pytest.approx(2e3 * run.displacement)


def test_the_specimen_writes_the_same_bytes_for_the_same_seed(names, tmp_path):
    paths = [names["Bushing"]().measure(tmp_path / word, seed=3) for word in "ab"]
    first, second = ((path.parent / "slow.csv").read_bytes() for path in paths)
    assert first == second
    run = dp.load_dataset(paths[0]).runs[0]
    cubic = 200e3 * run.displacement + 4e9 * run.displacement**3
    assert np.std(run.force - cubic) == pytest.approx(1.0, rel=0.1)


def test_the_export_lists_every_parameter(names):
    [(file, content)] = names["Table"]().files(dp.load("gehmann")).items()
    lines = content.decode().splitlines()
    assert file == "gehmann.csv"
    assert lines[1:] == ["maxwell.stiffness,15000.0,N/m", "maxwell.relaxation_time,0.02,s"]
