"""What an import makes of the ends of a record: zeros that fill up a block, and the frequencies at both ends."""

from __future__ import annotations

import numpy as np
import pytest

from dashpot.data.importing.finding import find_all
from dashpot.data.importing.motion import find_motion
from dashpot.data.importing.rows import without_filling
from dashpot.data.table import Table

RATE = 200.0
TIME = np.arange(1200) / RATE
STEPPED = 5e-3 + 1.5e-3 * np.sin(2.0 * np.pi * np.array([1.0, 2.0, 4.0])[(TIME // 2.0).astype(int)] * TIME)


def filled(count: int, **columns: np.ndarray) -> dict[str, np.ndarray]:
    """Columns with so many zeros behind them."""
    return {name: np.append(values, np.zeros(count)) for name, values in columns.items()}


def test_sines_one_after_the_other_end_with_their_first_and_last_frequency():
    found = find_motion(STEPPED, 1.0 / RATE)
    assert found.settings["start"] == pytest.approx(1.0, rel=0.05)
    assert found.settings["stop"] == pytest.approx(4.0, rel=0.05)


def test_zeros_that_fill_up_the_last_block_are_left_out():
    columns = filled(336, Displacement=1e3 * STEPPED, Force=6e4 * STEPPED)
    found = find_all(Table(columns, {"Displacement": "mm", "Force": "N"}, sampling=RATE))
    assert found.rows == (0, 1200)
    assert found.settings["preload"] == pytest.approx(5e-3, rel=0.02)


def test_a_file_with_a_clock_has_no_filling():
    columns = {"time": np.arange(1536) / RATE, **filled(336, Displacement=1e3 * STEPPED, Force=6e4 * STEPPED)}
    assert find_all(Table(columns, {"time": "s", "Displacement": "mm", "Force": "N"})).rows is None


@pytest.mark.parametrize(
    ("values", "end"), [([1, 2, 0, 0, 0, 3], 6), ([1, 2, 3, 0], 4), ([1, 2, 3, 0, 0], 3), ([1, 0, 0, 0], 4)]
)
def test_filling_is_more_than_one_zero_and_at_most_half(values, end):
    assert without_filling([np.array(values, dtype=float), np.array(values, dtype=float)]) == end


def test_zeros_in_one_column_alone_were_measured():
    assert without_filling([np.array([1.0, 2.0, 0.0, 0.0]), np.array([1.0, 2.0, 3.0, 4.0])]) == 4
