"""Text tables are read as rigs write them, and what cannot be read is told with its line."""

from __future__ import annotations

import math
import time
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from seeds import seed_of

from dashpot.contract.reader import ReadingError, Table
from dashpot_formats.csv import Csv

ROWS = np.array([[0.0, 1.5, -20.25], [0.001, 1.625, 3.0], [0.002, -1.75, 40.5], [0.003, 2.5, 1e-3], [0.004, 0.0, 7.0]])


def read(path: Path, text: str | bytes, **options: object) -> Table:
    path = path / "run.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8"))
    return Csv().read(path, options)


def rows_text(delimiter: str, decimal: str = ".", end: str = "\n") -> str:
    lines = [delimiter.join(f"{value:.6g}".replace(".", decimal) for value in row) for row in ROWS]
    return end.join(lines) + end


def matrix(table: Table) -> np.ndarray:
    return np.column_stack([column.astype(float) for column in table.columns.values()])


@pytest.mark.parametrize(
    ("delimiter", "decimal"),
    [(delimiter, ".") for delimiter in (",", ";", "\t", " ", "   ", ", ", " ; ")]
    + [(delimiter, ",") for delimiter in (";", "\t", " ", "   ", " ; ")],
)
@pytest.mark.parametrize("names", [True, False])
def test_delimiter_and_decimal_sign_are_found(tmp_path, delimiter, decimal, names):
    table = read(tmp_path, (delimiter.join("txF") + "\n" if names else "") + rows_text(delimiter, decimal))
    assert np.array_equal(matrix(table), ROWS)
    assert list(table.columns) == (["t", "x", "F"] if names else ["1", "2", "3"])


@pytest.mark.parametrize(
    ("head", "names", "units"),
    [
        ("t;x;F\ns;mm;kN\n", ["t", "x", "F"], {"t": "s", "x": "mm", "F": "kN"}),
        ("t;x;F\n[s];[mm];[kN]\n", ["t", "x", "F"], {"t": "s", "x": "mm", "F": "kN"}),
        ("Zeit [s];Weg [mm];Kraft [kN]\n", ["Zeit", "Weg", "Kraft"], {"Zeit": "s", "Weg": "mm", "Kraft": "kN"}),
        ("Zeit (s);Weg;Kraft in kN\n", ["Zeit", "Weg", "Kraft"], {"Zeit": "s", "Kraft": "kN"}),
        ("t / s;x / mm;Kraft F / kN\n", ["t", "x", "Kraft F"], {"t": "s", "x": "mm", "Kraft F": "kN"}),
        ("Zeit/s;Weg/mm;F/kN\n", ["Zeit", "Weg", "F"], {"Zeit": "s", "Weg": "mm", "F": "kN"}),
        ("Zeit/s;v/mm/s;a/(m/s^2)\n", ["Zeit", "v", "a"], {"Zeit": "s", "v": "mm/s", "a": "m/s^2"}),
        (
            "Time (in ms);Laser (in mm);Width (in)\n",
            ["Time", "Laser", "Width"],
            {"Time": "ms", "Laser": "mm", "Width": "in"},
        ),
        ("on/off;Speed mm/s;load/unload\n", ["on/off", "Speed mm/s", "load/unload"], {}),
        ("t;ratio;F\ns;-;kN\n", ["t", "ratio", "F"], {"t": "s", "F": "kN"}),
        ("t;ratio;F\ns;1;kN\n", ["t", "ratio", "F"], {"t": "s", "ratio": "1", "F": "kN"}),
        ("# t;x;F\n", ["t", "x", "F"], {}),
        ("t;s;N\n", ["t", "s", "N"], {}),
        ("Prüfer: Meier\nDatum;01.02.2024\n\n\nt;x;F\ns;mm;kN\n\n", ["t", "x", "F"], {"t": "s", "x": "mm", "F": "kN"}),
        ('"t";"x";"F"\n', ["t", "x", "F"], {}),
        ("x;x;F\n", ["x (column 1)", "x (column 2)", "F"], {}),
        ("t;;F\n", ["t", "column 2", "F"], {}),
        ("# made 2024; by; hand; today\n% t\n// x\n! y\n", ["1", "2", "3"], {}),
    ],
)
def test_names_and_units_are_found_above_the_numbers(tmp_path, head, names, units):
    table = read(tmp_path, head + rows_text(";", ","))
    assert list(table.columns) == names
    assert dict(table.units) == units
    assert np.array_equal(matrix(table), ROWS)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_encodings_and_line_ends_do_no_harm(tmp_path, encoding, end):
    text = ("Prüfstand größer" + end + "Zeit;Weg;Kraft" + end + rows_text(";", ",", end)).encode(encoding)
    table = read(tmp_path, text)
    assert list(table.columns) == ["Zeit", "Weg", "Kraft"]
    assert np.array_equal(matrix(table), ROWS)
    assert list(table.lines) == [3, 4, 5, 6, 7]


LOGGER = """\
Header Size:  3
Sampling Rate:  200
Sample Number, Date/Time, CHANNEL0, CHANNEL1, Events
         1,   04/29/2022 12:11:14.596 PM, 0.0259, -2.9931, DAQ Start
         2,   04/29/2022 12:11:14.601 PM, 0.0260, -2.9934
         3,   04/29/2022 12:11:14.606 PM, 0.0198, -2.9934
         4,   04/29/2022 12:11:14.611 PM, 0.0259, -2.9934, DAQ Pause
"""


def test_a_logger_file_with_dates_and_events(tmp_path):
    table = read(tmp_path, LOGGER)
    assert list(table.columns) == ["Sample Number", "Date/Time", "CHANNEL0", "CHANNEL1", "Events"]
    assert table.columns["CHANNEL0"].tolist() == [0.0259, 0.0260, 0.0198, 0.0259]
    assert table.columns["Date/Time"].tolist() == [0.0, 0.005, 0.01, 0.015]
    assert table.lines.tolist() == [4, 5, 6, 7]


def test_trailing_delimiters_blank_lines_and_remarks_are_passed_over(tmp_path):
    text = "t;x;\n0;1,5;\n\n# a remark\n1;2,5;\n2;3,5;\n   \n"
    table = read(tmp_path, text)
    assert list(table.columns) == ["t", "x"]
    assert table.columns["x"].tolist() == [1.5, 2.5, 3.5]
    assert table.lines.tolist() == [2, 5, 6]


def test_a_text_stays_where_it_is_and_its_neighbours_are_numbers(tmp_path):
    table = read(tmp_path, "t;x\n0;1,5\n1;bad\n2;3,5\n3;4,5\nEnd of test\n")
    assert table.columns["x"][:4].tolist() == [1.5, "bad", 3.5, 4.5]
    assert table.columns["t"][4] == "End of test"
    assert math.isnan(table.columns["x"][4])


def test_an_unclosed_quote_stays_in_its_line(tmp_path):
    table = read(tmp_path, 't;x\n0;1\n1;2\n2;"3\n3;4\n')
    assert table.columns["x"].tolist() == [1, 2, 3, 4]
    assert table.lines.tolist() == [2, 3, 4, 5]


def test_an_empty_value_and_nan_are_missing_numbers(tmp_path):
    table = read(tmp_path, "t;x\n0;1\n1;\n2;NaN\n3;4\n4;5\n")
    assert np.isnan(table.columns["x"]).tolist() == [False, True, True, False, False]


def test_a_point_in_a_file_with_decimal_commas_is_not_guessed_at(tmp_path):
    table = read(tmp_path, "t;x\n0,5;1,5\n1,5;2,5\n2,5;1.234\n3,5;2,5\n4,5;1_0\n")
    assert table.columns["x"].tolist() == [1.5, 2.5, "1.234", 2.5, "1_0"]


def test_names_may_be_separated_otherwise_than_the_numbers(tmp_path):
    table = read(tmp_path, "t, x, F\n" + rows_text("  "))
    assert list(table.columns) == ["t", "x", "F"]


def test_units_in_brackets_behind_blanks(tmp_path):
    table = read(tmp_path, "t [s]  x [mm]  F [kN]\n" + rows_text("  "))
    assert list(table.columns) == ["t", "x", "F"]
    assert dict(table.units) == {"t": "s", "x": "mm", "F": "kN"}


def test_quoted_numbers_with_decimal_comma(tmp_path):
    text = "t,x\n" + "".join(f'"{number},5","{2 * number},25"\n' for number in range(5))
    assert read(tmp_path, text).columns["x"].tolist() == [0.25, 2.25, 4.25, 6.25, 8.25]


def test_options_overrule_what_is_found(tmp_path):
    text = "1,5\n2,5\n3,5\n4,5\n"
    assert list(read(tmp_path, text).columns) == ["1", "2"]
    assert read(tmp_path, text, decimal=",", delimiter=";").columns["1"].tolist() == [1.5, 2.5, 3.5, 4.5]
    skipped = read(tmp_path, "9;9\n" + text, skip_rows=2, decimal=",", delimiter="space")
    assert skipped.columns["1"].tolist() == [2.5, 3.5, 4.5]
    assert skipped.lines.tolist() == [3, 4, 5]
    assert (
        read(tmp_path, "Weg\tKräfte\n1\t2\n3\t4\n".encode("cp850"), encoding="cp850", delimiter="tab").columns[
            "Kräfte"
        ][1]
        == 4
    )


@pytest.mark.parametrize(
    ("text", "options", "message", "line"),
    [
        ("", {}, "it holds no rows", None),
        ("# only\n# remarks\n", {}, "no table of numbers", None),
        ("words and words\nmore words\n", {}, "no table of numbers", None),
        ("t,x,F\n0,001,1,5,20,3\n0,002,1,6,20,4\n0,003,1,7,20,5\n", {}, "3 columns, but the rows below have 6", 1),
        ("t;x\n0;1\n1;2;3;4\n2;3\n3;4\n4;5\n", {}, "expected 2 values, got 4", 3),
        ("t;x;F\nabc;2,0;3,1\n1;2,0;3,1\n2;2,0;3,1\n3;2,0;3,1\n", {}, "expected a number, got 'abc'", 2),
        ("0;1\n1;2\n", {"delimeter": ";"}, "there is no file option 'delimeter'", None),
        ("0;1\n1;2\n", {"delimiter": ";;"}, "expected one character as delimiter", None),
        ("0;1\n1;2\n", {"decimal": "'"}, "expected . or , as decimal sign", None),
        ("0;1\n1;2\n", {"skip_rows": "two"}, "expected the file option 'skip_rows' as a whole number", None),
        ("0;1\n1;2\n", {"encoding": "utf-99"}, "there is no encoding 'utf-99'", None),
        (b"\xff0;1\n1;2\n", {"encoding": "utf-8"}, "it is not in the encoding 'utf-8'", None),
        (b"PK\x03\x04\0\0\0\0", {}, "it is a binary file", None),
        ("0;1\n1;2\n", {"skip_rows": -1}, "expected 'skip_rows' as 0 or more, got -1", None),
    ],
)
def test_what_is_wrong_with_a_file_is_told(tmp_path, text, options, message, line):
    with pytest.raises(ReadingError) as caught:
        read(tmp_path, text, **options)
    assert message in caught.value.message
    assert caught.value.line == line
    assert caught.value.hint


finite = st.floats(-1e12, 1e12, allow_subnormal=False)


@settings(max_examples=60, deadline=None)
@given(
    rows=st.lists(st.tuples(finite, finite, finite), min_size=4, max_size=12),
    delimiter=st.sampled_from([";", "\t", " "]),
    decimal=st.sampled_from([".", ","]),
    head=st.sampled_from(["", "t{0}x{0}F\n", "a title\nt{0}x{0}F\n"]),
)
def test_every_number_is_read_to_its_last_bit(tmp_path_factory, rows, delimiter, decimal, head):
    text = "\n".join(delimiter.join(f"{value:+.17e}".replace(".", decimal) for value in row) for row in rows)
    table = read(tmp_path_factory.mktemp("exact"), head.format(delimiter) + text)
    assert np.array_equal(matrix(table), np.array(rows))


@settings(max_examples=200, deadline=None)
@given(text=st.text(st.sampled_from('0123456789.,;\t -+eE"#%\nabs[]N'), max_size=120))
def test_any_text_is_a_table_or_a_reading_error(tmp_path_factory, text):
    try:
        table = read(tmp_path_factory.mktemp("any"), text)
    except ReadingError as error:
        assert error.message
        return
    assert len({len(column) for column in table.columns.values()} | {len(table.lines)}) == 1


def test_a_hundred_thousand_rows_are_read_in_half_a_second(tmp_path):
    count = 100_000
    values = np.random.default_rng(seed_of("test_csv")).normal(size=(count, 3))
    path = tmp_path / "long.csv"
    np.savetxt(path, values, fmt="%.9g", delimiter=";", header="t;x;F", comments="")
    begin = time.process_time()
    table = Csv().read(path, {})
    assert time.process_time() - begin < 0.5
    assert np.allclose(matrix(table), values, rtol=1e-8)


def test_the_file_is_not_changed(tmp_path):
    path = tmp_path / "kept.csv"
    path.write_text("t;x\n0;1\n1;2\n")
    path.chmod(0o444)
    before = path.read_bytes(), path.stat().st_mtime_ns
    Csv().read(path, {})
    assert (path.read_bytes(), path.stat().st_mtime_ns) == before
