"""A long text table is read block by block: in little memory, and as if it were read at once."""

from __future__ import annotations

import tracemalloc
from pathlib import Path

import numpy as np
import pytest

from dashpot.contract.reader import ReadingError, Table
from dashpot_formats import delimited_lines, delimited_text
from dashpot_formats.csv import Csv
from dashpot_formats.delimited_lines import Lines


def read(folder: Path, text: str, **options: object) -> Table:
    path = folder / "run.csv"
    path.write_bytes(text.encode())
    return Csv().read(path, options)


@pytest.fixture(params=[1, 20, 64])
def small_blocks(request, monkeypatch):
    monkeypatch.setattr(delimited_lines, "_BLOCK", request.param)
    monkeypatch.setattr(delimited_lines, "_PIECE", 7)
    monkeypatch.setattr(delimited_text, "_PIECE", 3)


@pytest.mark.parametrize("text", ["", "a", "a\n", "\n\n", "ä\nöö\n\nß", "long line of text\nb\n"])
def test_lines_are_those_of_a_split_text(small_blocks, text):
    lines, wanted = Lines(text.encode()), text.split("\n")
    assert list(lines) == wanted
    assert [lines[index] for index in range(len(lines))] == wanted
    assert lines[-1] == wanted[-1]
    assert lines[1:3] == wanted[1:3]
    assert lines[::2] == wanted[::2]
    with pytest.raises(IndexError):
        lines[len(wanted)]


def test_first_lines_that_are_skipped_still_count(small_blocks):
    assert list(Lines(b"a\nb\nc\nd").without_first(2)) == ["", "", "c", "d"]
    assert not any(Lines(b"a\nb").without_first(10**12))


def test_numbers_do_not_depend_on_the_blocks(tmp_path, small_blocks):
    rows = np.random.default_rng(0).standard_normal((200, 3))
    text = "Zeit;Weg;größte Kraft\n" + "".join(";".join(map(repr, row.tolist())) + "\n" for row in rows)
    table = read(tmp_path, text)
    assert list(table.columns) == ["Zeit", "Weg", "größte Kraft"]
    assert np.array_equal(np.column_stack(list(table.columns.values())), rows)
    assert table.lines is not None
    assert table.lines.tolist() == list(range(2, 202))


def test_a_column_is_read_in_one_way_throughout(tmp_path, small_blocks):
    # an infinite number counts as none where a column is not written plainly, however late that shows
    rows = ["0;inf;1;5", "1;2;inf;6", *(f"{k};{k};{k};{k}" for k in range(2, 60)), "60;;60;overload", "61;61;61"]
    table = read(tmp_path, "t;x;F;a\n" + "\n".join(rows))
    t, x, force, a = table.columns.values()
    assert np.array_equal(t, np.arange(62.0))
    assert np.array_equal(np.flatnonzero(np.isnan(x)), [0, 60])
    assert force[1] == np.inf
    assert [a[0], a[1], a[59], a[60]] == [5.0, 6.0, 59.0, "overload"]
    assert np.isnan(a[61])


def test_times_of_day_go_on_over_blocks(tmp_path, small_blocks):
    rows = [
        f"{(86390 + k) % 86400 // 3600:02}:{(86390 + k) // 60 % 60:02}:{(86390 + k) % 60:02},{k}" for k in range(40)
    ]
    table = read(tmp_path, "clock,F\n" + "\n".join(rows))
    assert np.array_equal(table.columns["clock"], np.arange(40.0))
    assert table.units["clock"] == "s"


def test_of_rows_that_are_too_long_the_first_one_is_told(tmp_path, small_blocks):
    rows = [f"{k};{k}" for k in range(50)]
    rows[20], rows[30], rows[40] = "20;20;;1", "30;30;1", "40;40;1"
    with pytest.raises(ReadingError, match="expected 2 values, got 3") as told:
        read(tmp_path, "\n".join(rows))
    assert told.value.line == 31


def test_a_table_is_read_in_little_more_memory_than_its_text_and_numbers(tmp_path):
    rows = np.random.default_rng(1).standard_normal((100_000, 5))
    text = "t;x;y;F;G\n" + "".join("{:.6f};{:.6f};{:.6f};{:.6f};{:.6f}\n".format(*row) for row in rows.tolist())
    path = tmp_path / "run.csv"
    path.write_text(text)
    read_once = Csv().read(path, {})
    tracemalloc.start()
    try:
        table = Csv().read(path, {})
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert np.array_equal(table.columns["G"], read_once.columns["G"])
    numbers = sum(column.nbytes for column in table.columns.values())
    # beside these: three whole numbers for each line, the lines of a block, what is read anew of line ends
    assert peak < len(text) + numbers + 4 * table.columns["t"].nbytes + 8e6
