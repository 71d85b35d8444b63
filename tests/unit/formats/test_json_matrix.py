"""JSON files give a matrix, or lists under their names, as columns."""

from __future__ import annotations

import json

import numpy as np
import pytest

from dashpot.contract.reader import ReadingError
from dashpot_formats.json_matrix import JsonMatrix

ROWS = [[0.0, 1.5], [0.1, -2.5], [0.2, 1e-3]]
NAMED = {"t": [0.0, 0.1, 0.2], "F": [1.5, -2.5, 1e-3]}


def read(folder, content, **options):
    (folder / "a.json").write_text(content if isinstance(content, str) else json.dumps(content))
    return JsonMatrix().read(folder / "a.json", options)


@pytest.mark.parametrize(
    ("content", "options"),
    [
        (ROWS, {}),
        ({"data": ROWS}, {}),
        ({"made": "2022", "samples": ROWS, "rate": 10}, {}),
        ({"a": ROWS, "b": [[1, 2]]}, {"key": "a"}),
        ({"a": {"b": ROWS}}, {"key": "a.b"}),
        (np.transpose(ROWS).tolist(), {"transpose": True}),
    ],
)
def test_a_matrix_has_numbered_columns(tmp_path, content, options):
    table = read(tmp_path, content, **options)
    assert list(table.columns) == ["1", "2"]
    assert np.array_equal(np.column_stack(list(table.columns.values())), ROWS)


@pytest.mark.parametrize(("content", "options"), [(NAMED, {}), ({"data": NAMED}, {}), ({"x": NAMED}, {"key": "x"})])
def test_lists_are_columns_by_name(tmp_path, content, options):
    table = read(tmp_path, content, **options)
    assert {name: column.tolist() for name, column in table.columns.items()} == NAMED


def test_null_is_a_missing_number(tmp_path):
    assert np.isnan(read(tmp_path, [[0, None], [1, 2]]).columns["2"]).tolist() == [True, False]


@pytest.mark.parametrize(
    ("content", "options", "message"),
    [
        ("[[1, 2], [3", {}, "it is not JSON"),
        ("\x00", {}, "it is not JSON"),
        ("[" * 100_000, {}, "it is not JSON"),
        ([[1, 2], [3]], {}, "expected 2 numbers in row 2, got 1"),
        ([[1, 2], 3], {}, "expected 2 numbers in row 2, got 3"),
        ([[1, 2], [3, "4"]], {}, "expected numbers in row 2, got '4'"),
        ([[1, 2], [3, [4]]], {}, "expected numbers in row 2, got '[4]'"),
        ([[1, 2], [3, True]], {}, "expected numbers in row 2, got 'True'"),
        ([[1, 2], [3, 10**400]], {}, "a number in row 2 is too large"),
        ([], {}, "expected a list of rows"),
        ({"rate": 3}, {}, "it holds no lists of numbers"),
        ({"data": ROWS}, {"key": "dat"}, "it has no key 'dat'"),
        ({"data": 3}, {"key": "data"}, "expected a list of rows"),
        ({"data": ROWS}, {"kee": "data"}, "there is no file option 'kee'"),
    ],
)
def test_what_is_wrong_is_told(tmp_path, content, options, message):
    with pytest.raises(ReadingError) as caught:
        read(tmp_path, content, **options)
    assert message in caught.value.message and caught.value.hint
