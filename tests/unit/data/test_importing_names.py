"""What the runs of a folder are called."""

from __future__ import annotations

from pathlib import Path

import pytest

from dashpot.data.importing.files import run_names
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
