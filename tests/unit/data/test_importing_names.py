"""What the runs of a folder are called, and what their names say about conditions."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from unit.data.tables import Tables

from dashpot.data.importing.counters import without_counters
from dashpot.data.importing.files import run_names
from dashpot.data.importing.imported import import_files
from dashpot.data.table import Table
from dashpot.text.name import is_name


@pytest.mark.parametrize(
    ("stems", "names"),
    [
        (
            ["Gummilager hinten quasistatisch", "Gummilager hinten Sweep_1,0mm"],
            ["quasistatisch", "Sweep_1,0mm"],
        ),
        (
            ["mount_rear-left_sweep_1mm_repeat_1", "mount_rear-left_sweep_1mm_repeat_2"],
            ["sweep_1mm_repeat_1", "sweep_1mm_repeat_2"],
        ),
        (["mount_rear_a1", "mount_rear_a2"], ["mount_rear_a1", "mount_rear_a2"]),
        (
            ["specimen 7 of the second lot", "specimen 8 of the second lot"],
            ["specimen 7 of the second lot", "specimen 8 of the second lot"],
        ),
        (["the only file of a long folder"], ["the only file of a long folder"]),
        (["mount of the rear axle", "mount of the rear axle sweep up"], ["axle", "axle sweep up"]),
    ],
)
def test_long_names_lose_the_words_that_all_begin_with(stems, names):
    found = list(run_names([Path(f"{stem}.csv") for stem in stems]).values())
    assert found == names


@pytest.mark.parametrize("sign", ["x", "橡"])
def test_names_that_are_cut_off_are_told_apart_by_numbers(sign):
    files = [Path(f"{sign * 110}{number}.csv") for number in range(3)]
    names = list(run_names(files).values())
    assert len(set(names)) == 3 and names[2].endswith("_2")
    assert all(map(is_name, names))


@pytest.mark.parametrize(
    "names",
    [
        ["a", "b", "c"],
        ["a", "a_2", "b"],
        ["bush", "bush_b", "bush_c"],
        ["sine_1", "sine_2", "sine_4"],
        ["r0", "r1", "r7"],
        ["m03_1mm", "m04_1mm"],
        ["shock 04 1mm", "shock 05 1mm"],
        ["07_sine", "08_sine_wdh", "09_sine rep2"],
        ["run3_open", "run12_open"],
        ["test_3_open", "test_12_open"],
        ["book_Sheet1", "book_Sheet2"],
        ["sine (1)", "sine - Kopie", "sine"],
        ["2024-03-01_1412_open", "2024-03-02_0907_open"],
        ["20240301_141205 open", "20240301 open"],
    ],
)
def test_names_that_only_count_are_of_one_test(names):
    assert len(set(without_counters(names).values())) == 1


@pytest.mark.parametrize(
    "names",
    [
        ["a2_f1_hard", "a2_f1_soft"],
        ["damper_2mm_open", "damper_2mm_closed", "damper_2mm"],
        ["sine2mm_T23", "sine2mm_T40", "sine2mm_T60"],
        ["T23_sine", "T40_sine", "T60_sine"],
        ["T23_sine", "P40_sine"],
        ["bush_20", "bush_40"],
        ["mount_S1", "mount_S2"],
        ["O-ring_1", "X-ring_1"],
        ["damper_L", "damper_R"],
        ["run1", "hard_run1"],
        ["yoke0.6kN_sine", "yoke1.6kN_sine"],
        ["off_-20degC", "off_20degC"],
    ],
)
def test_names_that_differ_by_more_tell_other_conditions(names):
    assert len(set(without_counters(names).values())) == len(names)


@pytest.mark.parametrize(
    ("names", "repeats"),
    [
        (["a2_hard", "a2_soft"], [None, None]),
        (["sine_T1", "sine_T2"], [None, None]),
        (["01_sine_hard", "02_sine_hard"], [None, "01_sine_hard"]),
    ],
)
def test_runs_whose_names_tell_other_conditions_are_no_repeats(tmp_path, names, repeats):
    """A spring that is 2 % softer over the same sine: what differs is less than repeats may."""
    time = 0.002 * np.arange(3000)
    motion = 10.0 + 5.0 * np.sin(2.0 * np.pi * 1.5 * time)
    tables = {}
    for name, softer in zip(names, (1.0, 0.98), strict=True):
        columns = {"t": time, "x": motion, "F": softer * (200.0 * motion + 2.0 * np.gradient(motion, 0.002))}
        tables[f"{name}.tab"] = Table(columns, {"t": "s", "x": "mm", "F": "N"})
        (tmp_path / f"{name}.tab").write_text("")
    found = import_files([tmp_path], {"tab": Tables(tables)})
    assert [run.repeats for run in found.runs] == repeats
    told = [runs for remark, runs in found.confirm.items() if "another condition in its name" in remark]
    assert told == ([] if repeats[1] else [(names[1],)])
