"""Runs know how far the specimen was deflected in those before them."""

from __future__ import annotations

import numpy as np
import pytest
from unit.data.test_dataset import read, write_run

import dashpot as dp
from dashpot.data.excitation import settings_of

RUNS = """
- {name: a, file: a.npz}
- {name: b, file: b.npz}
- {name: c, file: c.npz}
"""
# mm, to either side
STROKES = {"a": 3.0, "b": -5.0, "c": 2.0}


def reached(folder, runs=RUNS, strokes=STROKES):
    wave = np.sin(np.linspace(0.0, 20.0 * np.pi, 400))
    for name, stroke in strokes.items():
        # one side only goes all the way
        write_run(folder, f"{name}.npz", x=stroke * np.where(wave > 0.0, wave, 0.5 * wave) / wave.max())
    return {run.name: 1e3 * settings_of(run)["reached"] for run in read(folder, runs).runs}


def test_the_largest_deflection_to_either_side_counts_from_run_to_run(tmp_path):
    assert reached(tmp_path) == pytest.approx({"a": 0.0, "b": 3.0, "c": 5.0})


def test_what_a_run_states_itself_counts_from_there_on(tmp_path):
    stated = RUNS.replace("file: a.npz", "file: a.npz, settings: {reached: 4 mm}")
    assert reached(tmp_path, stated) == pytest.approx({"a": 4.0, "b": 4.0, "c": 5.0})


def test_a_run_that_is_set_aside_has_moved_the_specimen_all_the_same(tmp_path):
    aside = RUNS.replace("file: b.npz", "file: b.npz, set_aside: the clamp was loose")
    assert reached(tmp_path, aside) == pytest.approx({"a": 0.0, "c": 5.0})
    assert set(read(tmp_path, aside).runs[-1].history) == {"reached", "moved", "moved 2"}


@pytest.mark.parametrize("aside", [False, True])
def test_a_run_whose_force_is_faulty_has_moved_the_specimen_all_the_same(tmp_path, aside):
    """Its displacement is sound: whether the force is has no say in what the runs behind it know."""
    runs = RUNS.replace("file: b.npz", "file: b.npz, set_aside: the force is lost") if aside else RUNS
    sound = reached(tmp_path, runs), read(tmp_path, runs).runs[-1].history
    table = dict(np.load(tmp_path / "b.npz"))
    table["F"][100] = np.nan
    np.savez(tmp_path / "b.npz", **table)
    left = read(tmp_path, runs).runs
    assert [run.name for run in left] == ["a", "c"]
    assert left[-1].history == sound[1]


def test_nothing_is_known_of_a_run_without_a_sound_displacement(tmp_path):
    reached(tmp_path)
    (tmp_path / "b.npz").write_text("no table")
    assert set(read(tmp_path, RUNS).runs[-1].history) == {"reached", "moved"}


def test_the_squared_velocity_is_summed_up_over_the_run_before(tmp_path):
    time = np.arange(0.0, 2.0, 1e-3)
    for name, amplitude in (("a", 3.0), ("b", 5.0), ("c", 1.0)):
        path = amplitude * np.sin(2.0 * np.pi * 4.0 * time)
        write_run(tmp_path, f"{name}.npz", t=time, x=path, F=100.0 * path)
    found = [settings_of(run)["moved"] for run in read(tmp_path, RUNS).runs]
    # of a sine half the square of its largest velocity, for two seconds
    speeds = [2.0 * np.pi * 4.0 * 1e-3 * amplitude for amplitude in (3.0, 5.0)]
    assert found == pytest.approx([0.0, speeds[0] ** 2, speeds[1] ** 2], rel=1e-2)


def test_no_measured_force_is_among_what_a_run_knows_of_those_before(tmp_path):
    """A held-out run may be one of them: what it measured must not reach a fit."""
    time = np.arange(0.0, 2.0, 1e-3)
    told = []
    for factor in (1.0, -7.0):
        for name, amplitude in (("a", 3.0), ("b", 5.0), ("c", 1.0)):
            path = amplitude * np.sin(2.0 * np.pi * 4.0 * time)
            write_run(tmp_path, f"{name}.npz", t=time, x=path, F=factor * 100.0 * path)
        told.append([run.history for run in read(tmp_path, RUNS).runs])
    assert told[0] == told[1] and set(told[0][-1]) == {"reached", "moved", "moved 2"}


def test_parts_of_a_dataset_in_memory_follow_one_another():
    wave, time = np.sin(np.linspace(0.0, 20.0, 500)), 1e-3 * np.arange(500)
    parts = [
        dp.Data.from_arrays(time, far * wave, 1e5 * far * wave, name=name)
        for name, far in (("first", 4e-3), ("second", 1e-3))
    ]
    runs = dp.Data.join(parts).runs
    assert [run.history["reached"] for run in runs] == [0.0, pytest.approx(4e-3 * np.abs(wave).max())]
