"""Text files as the measuring programs of the field export them: names, units, clock and numbers are found."""

from __future__ import annotations

import time

import numpy as np
import pytest

from dashpot.contract.reader import ReadingError
from dashpot_formats.csv import Csv
from dashpot_formats.stated_sampling import stated_sampling
from dashpot_formats.time_stamps import seconds
from dashpot_formats.unit_words import plain_unit

TIME = np.arange(40) / 100
WAY, LOAD = np.round(3 * np.sin(6 * TIME), 4), np.round(1234.5 * np.sin(6 * TIME + 0.3), 3)
NAMES, UNITS = ["Zeit", "Weg", "Kraft"], {"Zeit": "s", "Weg": "mm", "Kraft": "kN"}


def rows(delimiter, decimal=".", before="", after="", form="{}"):
    """The lines of the table."""
    cells = [[form.format(value).replace(".", decimal) for value in row] for row in zip(TIME, WAY, LOAD, strict=True)]
    return "".join(before + delimiter.join(row) + after + "\n" for row in cells)


EXPORTS = {
    "DIAdem, a line of data types": (
        "Zeit\tWeg\tKraft\ns\tmm\tkN\nfloat64\tfloat64\tfloat64\n" + rows("\t", ","),
        NAMES,
    ),
    "DIAdem, labelled lines": (
        "Datum;12.03.2024\nPrüfer;Müller\n\nKanalname;Zeit;Weg;Kraft\nEinheit;s;mm;kN\n" + rows(";", ",", before=";"),
        ["Kanalname", *NAMES],
    ),
    "catman": (
        "HBM_CATMAN_DATAFILE_TXT\n25\nT0 = 12.03.2024 10:11:12\nZeit [s]\tWeg [mm]\tKraft [kN]\n"
        "Sensor: keiner\tWA50\tU9C\nSR=100 Hz\tSR=100 Hz\tSR=100 Hz\nComment\t\t\n" + rows("\t", ","),
        NAMES,
    ),
    "imc": ("imc STUDIO 2024\r\nZeit\tWeg\tKraft\r\ns\tmm\tkN\r\n" + rows("\t", ","), NAMES),
    "Dewesoft": (
        "File info:\nSample rate:\t100\nStart time:\t12/03/2024 10:11:12.123\nNumber of channels:\t2\n\nEvents\n"
        "Event Type\tEvent\tTime\tComment\n1\tstoring started\t0\t\n2\tstoring stopped\t2,0\t\n\nData1\n"
        "Zeit\tWeg\tKraft\n(s)\t(mm)\t(kN)\n" + rows("\t", ","),
        NAMES,
    ),
    "MTS": (
        "MTS793|MPT|ENU|1|2|.|/|:|1|0|0|A\n\nData Acquisition:\tTimed 1\t\tTime:\t12.5\tSec\t3/12/2024 10:11:12 AM\n"
        "Station Name:\tvs101.cfg\n\nZeit\tWeg\tKraft\nSec\tmm\tkN\n" + rows("\t"),
        NAMES,
    ),
    "Instron": (
        '"General : Test"\n\n"Zeit (s)","Weg (mm)","Kraft (kN)"\n'
        + rows(",", before='"', after='"').replace(",", '","'),
        NAMES,
    ),
    "Zwick": ('"Probe 1"\n"Zeit";"Weg";"Kraft"\n"s";"mm";"kN"\n' + rows(";", ","), NAMES),
    "LabVIEW": (
        "LabVIEW Measurement\t\nSeparator\tTab\n***End_of_Header***\t\nY_Unit_Label\tmm\tkN\t\nX0\t0,0E+0\t0,0E+0\t\n"
        "Delta_X\t0,010000\t0,010000\t\n***End_of_Header***\t\t\t\nZeit\tWeg\tKraft\tComment\n" + rows("\t", ","),
        [*NAMES, "Comment"],
    ),
    "fixed width": (
        "      Zeit       Weg     Kraft\n       [s]      [mm]      [kN]\n" + rows("", form="{:11.4f}"),
        NAMES,
    ),
    "quotes between blanks": ('"Zeit [s]" "Weg [mm]" "Kraft [kN]"\n' + rows(" "), NAMES),
    "wide blanks between names of several words": (
        "Zeit   Weg am Kolben   Kraft\n" + rows("  "),
        ["Zeit", "Weg am Kolben", "Kraft"],
    ),
    "Fortran": ("Zeit Weg Kraft\ns mm kN\n" + rows("  ", form="{: .6E}").replace("E", "D"), NAMES),
    "bars": ("Zeit|Weg|Kraft\ns|mm|kN\n" + rows("|"), NAMES),
    "separators behind the last value": ("Zeit;Weg;Kraft;\ns;mm;kN;\n" + rows(";", ",", after=";"), NAMES),
    "units above names": ("s;mm;kN\nZeit;Weg;Kraft\n" + rows(";", ","), NAMES),
    "names in two languages": ("Time;Way;Load\nZeit;Weg;Kraft\ns;mm;kN\n" + rows(";", ","), NAMES),
    "remarks": ("% test 4\n% rig: hydropulser\n% Zeit [s]\tWeg [mm]\tKraft [kN]\n" + rows("\t"), NAMES),
    "thousands of lines above": (
        "".join(f"Setting {i};{1.5 * i};x\n" for i in range(2000)) + "Zeit;Weg;Kraft\ns;mm;kN\n" + rows(";", ","),
        NAMES,
    ),
    "spelt units": ("Zeit;Weg;Kraft\nSek;Millimeter;kN\n" + rows(";", ","), NAMES),
    "the separator named": ("sep=;\nZeit;Weg;Kraft\ns;mm;kN\n" + rows(";", ","), NAMES),
    "UTF-16 without mark": (("Zeit;Weg;Kraft\ns;mm;kN\n" + rows(";", ",")).encode("utf-16-le"), NAMES),
    "Latin-1": (("Größe\nZeit;Weg;Kraft\ns;mm;kN\n" + rows(";", ",")).encode("latin-1"), NAMES),
}


@pytest.mark.parametrize("program", EXPORTS)
def test_the_table_of_an_export_is_found(tmp_path, program):
    content, names = EXPORTS[program]
    (tmp_path / "a.txt").write_bytes(content if isinstance(content, bytes) else content.encode())
    table = Csv().read(tmp_path / "a.txt", {})
    assert list(table.columns) == names
    way = next(name for name in names if name.startswith("Weg"))
    for name, values in (("Zeit", TIME), (way, WAY), ("Kraft", LOAD)):
        assert np.allclose(table.columns[name], values, rtol=1e-6, atol=1e-6)
    stated = {name: unit for name, unit in UNITS.items() if (program, name) != ("LabVIEW", "Zeit")}
    assert dict(table.units) == ({} if "several words" in program else stated)
    assert table.sampling == (100.0 if program in ("catman", "Dewesoft", "LabVIEW") else None)


@pytest.mark.parametrize(
    ("texts", "passed"),
    [
        (["31.12.2024 23:59:59,75", "01.01.2025 00:00:00,25"], [0.0, 0.5]),
        (["2024-02-28T23:59:59.999999Z", "2024-02-29T00:00:00.000001Z"], [0.0, 2e-6]),
        (["2/28/2024 11:59:59 PM", "2/29/2024 12:00:01 AM"], [0.0, 2.0]),
        (["28/02/2024 10:00:00", "", "29/02/2024 10:00:00"], [0.0, np.nan, 86400.0]),
        (["23:59:59.5", "00:00:00.5"], [0.0, 1.0]),
    ],
)
def test_stamps_are_seconds(texts, passed):
    assert np.array_equal(seconds(texts), passed, equal_nan=True)


@pytest.mark.parametrize("texts", [["10:11:12", "pause"], ["32.01.2024 10:00:00"], [""], ["10:61:00"]])
def test_what_is_no_stamp_stays_a_text(texts):
    assert seconds(texts) is None


def test_a_column_of_stamps_is_a_clock(tmp_path):
    lines = [f"12.03.2024 10:11:{12 + t:05.2f};{x}" for t, x in zip(TIME, WAY, strict=True)]
    (tmp_path / "a.csv").write_text("Zeit;Weg [mm]\n" + "\n".join(lines))
    table = Csv().read(tmp_path / "a.csv", {})
    assert np.allclose(table.columns["Zeit"], TIME, atol=1e-9) and table.units["Zeit"] == "s"
    assert np.array_equal(table.columns["Weg"], WAY)


@pytest.mark.parametrize(
    ("text", "number"),
    [("1.234,5", 1234.5), ("-12.345.678,25", -12345678.25), ("1.234", "1.234"), ("12.34,5", "12.34,5")],
)
def test_thousands_are_grouped_only_beyond_doubt(tmp_path, text, number):
    (tmp_path / "a.csv").write_text(f"t;x\n0,5;1,5\n1,5;{text}\n" + "2,5;2,5\n" * 4)
    assert Csv().read(tmp_path / "a.csv", {}).columns["x"][1] == number


@pytest.mark.parametrize(
    ("lines", "hertz"),
    [
        (["Sample rate:\t100"], 100.0),
        (["Abtastrate [kHz]; 1,2"], 1200.0),
        (["Sampling Interval: 5 ms"], 200.0),
        (["SR=100 Hz\tSR=100 Hz\tSR=50 Hz"], None),
        (["Sample rate: 0"], None),
        (["nothing of the kind 100"], None),
    ],
)
def test_a_rate_is_taken_from_the_lines_above(lines, hertz):
    assert stated_sampling(lines) == hertz


@pytest.mark.parametrize(
    ("stated", "unit"),
    [("Sec", "s"), ("[mm]", "mm"), ("deg C", "degC"), ("°C", "°C"), ("kp", "kgf"), ("-", ""), ("counts", "counts")],
)
def test_units_are_known_in_other_spellings(stated, unit):
    assert plain_unit(stated) == unit


def test_a_row_without_end_is_told_at_once(tmp_path):
    lines = ["t;x;F"] + ["1;2;3"] * 50_000
    lines[20_000] = ";".join("1" * 200_000)
    (tmp_path / "a.csv").write_text("\n".join(lines))
    with pytest.raises(ReadingError, match="expected about 3 values, got 200000") as caught:
        Csv().read(tmp_path / "a.csv", {})
    assert caught.value.line == 20_001


@pytest.mark.parametrize("sign", [" ", "(", "a (", "1:", "sample rate ", "\t", ";", '"', "/ "])
def test_long_lines_take_no_long_time(tmp_path, sign):
    (tmp_path / "a.csv").write_text(sign * 100_000 + "\nt;x\n" + "1;2\n" * 20)
    began = time.process_time()
    try:
        Csv().read(tmp_path / "a.csv", {})
    except ReadingError as error:
        assert error.hint
    assert time.process_time() - began < 2
