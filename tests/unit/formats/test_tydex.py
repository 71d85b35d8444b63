"""TYDEX files, written here after the description of the format, are read with units and conversion factors."""

from __future__ import annotations

import numpy as np
import pytest

from dashpot.contract.reader import ReadingError
from dashpot_formats.tydex import Tydex

HEADER = """\
**HEADER
!-------!-------------------------------!---------!---------!
RELEASE   Release of TYDEX-Format                 1.3
SUPPLIER  Data supplier                           DEMO

**COMMENTS
! Demo with time measurement procedure
**CONSTANTS
INFLPRES  Inflation pressure            bar       2.1
"""
CHANNELS = [
    ("MEASNUMB", "Measurement point no.", "-", 1.0),
    ("RUNTIME", "Running time", "s", 0.001),
    ("DISTGRND", "Distance to ground", "mm", 0.1),
    ("FZW", "Vertical force", "N", -10.0),
    ("TYRETEMP", "Tread temperature", "deg C", 1.0),
]
NUMBERS = np.array([[1, 0, 2994.5, -310.25, 25.5], [2, 2, 2990, -3.2e2, 25.5], [3, 4, 2987.25, -331, 25.75]])


def channels(offsets=""):
    """The section of channels: name in columns 1 to 10, remark to 40, unit to 50, then the conversion."""
    return "**MEASURCHANNELS\n! name, remark, unit, factor, offsets\n" + "".join(
        f"{name:<10}{remark:<30}{unit:<10}{factor:<10g}{offsets}\n" for name, remark, unit, factor in CHANNELS
    )


def rows(form="{:>10.9g}", between="", cut=5):
    """The section of data, `cut` numbers a line."""
    lines = [[form.format(number) for number in row] for row in NUMBERS]
    pieces = [row[start : start + cut] for row in lines for start in range(0, len(row), cut)]
    return "**MEASURDATA 3\n" + "".join(between.join(piece) + "\n" for piece in pieces) + "**END\n"


def read(folder, text, **options):
    (folder / "a.tdx").write_bytes(text if isinstance(text, bytes) else text.encode("cp1252"))
    return Tydex().read(folder / "a.tdx", options)


@pytest.mark.parametrize(
    "data",
    [rows(), rows("{:g}", " "), rows("{:g}", "\t"), rows(cut=3), rows("{:<10.9g}")],
    ids=["fixed width", "blanks", "tabs", "wrapped", "left"],
)
def test_numbers_are_taken_times_their_factor(tmp_path, data):
    table = read(tmp_path, HEADER + channels() + data)
    assert list(table.columns) == [name for name, *_ in CHANNELS]
    factors = np.array([factor for *_, factor in CHANNELS])
    assert np.allclose(np.column_stack(list(table.columns.values())), NUMBERS * factors, rtol=1e-12)
    assert dict(table.units) == {"RUNTIME": "s", "DISTGRND": "mm", "FZW": "N", "TYRETEMP": "degC"}


def test_fields_that_touch_are_split_by_their_width(tmp_path):
    data = rows("{:010.4f}")
    assert " " not in data.splitlines()[1]
    assert np.allclose(read(tmp_path, HEADER + channels() + data).columns["FZW"], -10 * NUMBERS[:, 3])


def test_an_empty_field_is_a_missing_number(tmp_path):
    lines = rows().splitlines()
    lines[2] = lines[2][:30] + " " * 10 + lines[2][40:]
    values = read(tmp_path, HEADER + channels() + "\n".join(lines)).columns["FZW"]
    assert np.isnan(values).tolist() == [False, True, False]


def test_lines_that_do_not_keep_to_the_columns(tmp_path):
    text = HEADER + "**MEASURCHANNELS\nRUNTIME Running time of the test s 0.5 0 0\nFZW Vertical force N 2\n"
    table = read(tmp_path, text + "**MEASURDATA\n1 2\n3 4\n")
    assert table.columns["RUNTIME"].tolist() == [0.5, 1.5] and table.columns["FZW"].tolist() == [4.0, 8.0]
    assert dict(table.units) == {"RUNTIME": "s", "FZW": "N"}


def test_offsets_are_used_as_the_dataset_says(tmp_path):
    text = HEADER + channels(f"{3:<10g}{7:<10g}") + rows()
    added, ignored = read(tmp_path, text, offsets="added"), read(tmp_path, text, offsets="ignored")
    assert np.allclose(added.columns["FZW"], -10 * (NUMBERS[:, 3] + 3) + 7)
    assert np.allclose(ignored.columns["FZW"], -10 * NUMBERS[:, 3])
    with pytest.raises(ReadingError, match="has the conversion offsets 3 and 7"):
        read(tmp_path, text)


@pytest.mark.parametrize(
    ("text", "options", "message", "line"),
    [
        ("", {}, "it has no section **MEASURCHANNELS", None),
        (HEADER + channels(), {}, "it has no section **MEASURDATA", None),
        (HEADER + "**MEASURCHANNELS\n**MEASURDATA\n1 2\n", {}, "it declares no channels", None),
        (HEADER + channels() + "**MEASURDATA\n**END\n", {}, "it holds no measured data", None),
        ("**MEASURCHANNELS\nFZW\n**MEASURDATA\n1\n2 3\n", {}, "expected 1 values, got 2", 5),
        ("**MEASURCHANNELS\nA\nB\n**MEASURDATA\n1 2\n3\n", {}, "expected 2 values, got 1", 6),
        ("**MEASURCHANNELS\nA\nB\n**MEASURDATA\n1 2\n3 x\n", {}, "expected 2 numbers, got '3 x'", 6),
        ("**MEASURCHANNELS\nA B N 0\n**MEASURDATA\n1\n", {}, "'A' has no sound conversion factor", 2),
        (HEADER + channels() + rows(), {"offsets": "maybe"}, "expected 'offsets' as added or ignored", None),
        (HEADER + channels() + rows(), {"offset": "added"}, "there is no file option 'offset'", None),
        (b"\0\1\2\3" * 30, {}, "it is a binary file", None),
    ],
)
def test_what_is_wrong_with_a_file_is_told(tmp_path, text, options, message, line):
    with pytest.raises(ReadingError) as caught:
        read(tmp_path, text, **options)
    assert message in caught.value.message and caught.value.hint
    assert caught.value.line == line
