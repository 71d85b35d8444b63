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


def test_the_squared_velocity_is_summed_up_over_the_run_before(tmp_path):
    time = np.arange(0.0, 2.0, 1e-3)
    for name, amplitude in (("a", 3.0), ("b", 5.0), ("c", 1.0)):
        path = amplitude * np.sin(2.0 * np.pi * 4.0 * time)
        write_run(tmp_path, f"{name}.npz", t=time, x=path, F=100.0 * path)
    found = [settings_of(run)["moved"] for run in read(tmp_path, RUNS).runs]
    # of a sine half the square of its largest velocity, for two seconds
    speeds = [2.0 * np.pi * 4.0 * 1e-3 * amplitude for amplitude in (3.0, 5.0)]
    assert found == pytest.approx([0.0, speeds[0] ** 2, speeds[1] ** 2], rel=1e-2)


def worked(folder, forces, runs=RUNS):
    """The settings of the last run that tell of work, after strokes of 3, 5 and 1 mm at 4 Hz for 2 s each."""
    time = np.arange(0.0, 2.0, 1e-4)
    for name, amplitude in (("a", 3.0), ("b", 5.0), ("c", 1.0)):
        omega = 2.0 * np.pi * 4.0
        path, speed = amplitude * np.sin(omega * time), 1e-3 * amplitude * omega * np.cos(omega * time)
        write_run(folder, f"{name}.npz", t=time, x=path, F=forces(1e-3 * path, speed))
    return {key: value for key, value in settings_of(read(folder, runs).runs[-1]).items() if key.startswith("worked")}


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_work_of_each_run_before_is_that_of_its_losses(tmp_path, sign):
    """Of a dashpot pi d w a^2 a cycle and none of a spring, also where the load cell has the wrong sign."""
    found = worked(tmp_path, lambda x, v: sign * (2e5 * x + 300.0 * v))
    works = [8.0 * np.pi * 300.0 * 2.0 * np.pi * 4.0 * (1e-3 * amplitude) ** 2 for amplitude in (5.0, 3.0)]
    assert found == {"worked": pytest.approx(works[0], rel=1e-3), "worked 2": pytest.approx(works[1], rel=1e-3)}


def test_what_a_spring_still_holds_at_the_end_of_a_run_is_no_loss():
    """Half a cosine from rest to rest: the dashpot takes up d pi^2 a^2/(2 T) of a way 2 a in a time T."""
    time, length = 1e-3 * np.arange(1001), 1.0
    path = 4e-3 * (1.0 - np.cos(np.pi * time / length))
    speed = 4e-3 * np.pi / length * np.sin(np.pi * time / length)
    parts = [dp.Data.from_arrays(time, path, 2e5 * path + 300.0 * speed, name=name) for name in ("a", "b")]
    loss = 300.0 * np.pi**2 * 4e-3**2 / (2.0 * length)
    assert dp.Data.join(parts).runs[1].history["worked"] == pytest.approx(loss, rel=1e-3)


def test_a_run_that_was_set_aside_has_worked_the_specimen_all_the_same(tmp_path):
    aside = RUNS.replace("file: b.npz", "file: b.npz, set_aside: the clamp was loose")
    both, one = (worked(tmp_path, lambda x, v: 300.0 * v, runs) for runs in (RUNS, aside))
    assert len(both) == 2 and one == both


def test_parts_of_a_dataset_in_memory_follow_one_another():
    wave, time = np.sin(np.linspace(0.0, 20.0, 500)), 1e-3 * np.arange(500)
    parts = [
        dp.Data.from_arrays(time, far * wave, 1e5 * far * wave, name=name)
        for name, far in (("first", 4e-3), ("second", 1e-3))
    ]
    runs = dp.Data.join(parts).runs
    assert [run.history["reached"] for run in runs] == [0.0, pytest.approx(4e-3 * np.abs(wave).max())]
