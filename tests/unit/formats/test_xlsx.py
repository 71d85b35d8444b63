"""Excel workbooks, written by the library, give the table of a sheet."""

import datetime
import importlib.util

import numpy as np
import pytest

from dashpot.contract.reader import ReadingError
from dashpot.data.dataset import read_dataset
from dashpot.data.importing.imported import import_files
from dashpot.data.importing.text import dataset_text
from dashpot_formats import extra
from dashpot_formats.xlsx import Xlsx

FORCE = 100.0 * np.sin(np.arange(40) / 7)
needed = pytest.mark.skipif(importlib.util.find_spec("openpyxl") is None, reason="needs dashpot[excel]")


def write(path, **sheets):
    from openpyxl import Workbook

    book = Workbook()
    book.remove(book.active)
    for title, rows in sheets.items():
        sheet = book.create_sheet(title)
        for row in rows:
            sheet.append(row)
    book.save(path)
    return path


def rows(count=40):
    return [[0.01 * k, 0.5 * k, float(FORCE[k])] for k in range(count)]


def record(size, count=400):
    """Time in s, way in mm and force of a spring with losses."""
    angle = 2 * np.pi * 2.0 * 0.01 * np.arange(count)
    return np.stack([0.01 * np.arange(count), size * np.sin(angle), size * np.sin(angle + 0.2)], axis=1).tolist()


@needed
@pytest.mark.parametrize(
    "head",
    [
        [["time [s]", "way [mm]", "force [kN]"]],
        [["time", "way", "force"], ["s", "mm", "kN"]],
        [["bush 7", None, None], [None], ["time (s)", "way (mm)", "force (kN)"]],
    ],
)
def test_names_units_and_numbers_of_a_sheet(tmp_path, head):
    table = Xlsx().read(write(tmp_path / "a.xlsx", data=[*head, *rows()]), {})
    assert list(table.columns) == ["time", "way", "force"]
    assert dict(table.units) == {"time": "s", "way": "mm", "force": "kN"}
    assert np.allclose(table.columns["force"], FORCE, rtol=1e-14, atol=0.0)


@needed
def test_the_sheet_with_the_numbers_is_read_and_others_on_demand(tmp_path):
    path = write(
        tmp_path / "a.xlsx",
        about=[["bush", 7], ["rig", "B"]],
        data=[["t", "x", "F"], *rows()],
        short=[["t", "x", "F"], *rows(20)],
    )
    assert Xlsx().read(path, {}).columns["F"].size == 40
    assert Xlsx().read(path, {"sheet": "short"}).columns["F"].size == 20
    assert Xlsx().read(path, {"sheet": 3}).columns["F"].size == 20
    with pytest.raises(ReadingError, match="no sheet 'shrt'") as caught:
        Xlsx().read(path, {"sheet": "shrt"})
    assert "short" in caught.value.hint
    with pytest.raises(ReadingError, match="there is no sheet 4"):
        Xlsx().read(path, {"sheet": 4})


@needed
def test_empty_cells_are_missing_numbers_and_dates_are_seconds(tmp_path):
    start = datetime.datetime(2024, 2, 28, 23, 59, 58)
    lines = [[start + datetime.timedelta(seconds=k), k * 0.5, None if k == 5 else k * 2.0] for k in range(30)]
    table = Xlsx().read(write(tmp_path / "a.xlsx", data=[["when", "x", "F"], *lines]), {})
    assert np.allclose(table.columns["when"], np.arange(30.0))
    assert np.flatnonzero(np.isnan(table.columns["F"])).tolist() == [5]


@needed
def test_a_file_that_is_no_workbook_is_refused(tmp_path):
    (tmp_path / "a.xlsx").write_bytes(b"PK\x03\x04 no workbook")
    with pytest.raises(ReadingError, match="not a sound Excel workbook"):
        Xlsx().read(tmp_path / "a.xlsx", {})


def test_without_the_library_it_says_how_to_install_it(tmp_path, monkeypatch):
    monkeypatch.setattr(extra, "find_spec", lambda name: None)
    (tmp_path / "a.xlsx").write_bytes(b"")
    with pytest.raises(ReadingError, match="Excel workbooks need the package openpyxl") as caught:
        Xlsx().read(tmp_path / "a.xlsx", {})
    assert caught.value.hint == "pip install 'dashpot[excel]'"


@needed
def test_each_sheet_of_numbers_is_a_run_and_the_dataset_reads_it(tmp_path):
    """A sheet called 2 is no number of a sheet; notes are no run; the name of a sheet tells its pressure."""
    tall, low = ([["Time/s", "Weg/mm", "Kraft/kN"], *record(size)] for size in (1.0, 0.4))
    write(tmp_path / "lot.xlsx", notes=[["rig", "B"], ["day", 7]], **{"6 bar": tall, "2 bar": low})
    found = import_files([tmp_path], {"xlsx": Xlsx()})
    assert [(run.name, dict(run.options)) for run in found.runs] == [
        ("lot_6 bar", {"sheet": "6 bar"}),
        ("lot_2 bar", {"sheet": "2 bar"}),
    ]
    text = dataset_text(found, tmp_path, "lot")
    assert 'file_options: {sheet: "2 bar"}' in text and "pressure: 2 bar}" in text
    (tmp_path / "dataset.yaml").write_text(text)
    runs = read_dataset(tmp_path, {"xlsx": Xlsx()}).runs
    assert [np.ptp(run.displacement) for run in runs] == pytest.approx([2e-3, 0.8e-3], rel=1e-2)


@needed
def test_a_sheet_called_by_a_number_is_found_by_its_name(tmp_path):
    head = ["t [s]", "x [mm]", "F [N]"]
    write(tmp_path / "a.xlsx", **{"2": [head, *record(1.0)], "1": [head, *record(0.4)]})
    found = import_files([tmp_path], {"xlsx": Xlsx()})
    (tmp_path / "dataset.yaml").write_text(dataset_text(found, tmp_path, "a"))
    runs = read_dataset(tmp_path, {"xlsx": Xlsx()}).runs
    assert [run.name for run in runs] == ["a_2", "a_1"]
    assert [np.ptp(run.displacement) for run in runs] == pytest.approx([2e-3, 0.8e-3], rel=1e-2)


@needed
def test_a_sheet_that_cannot_be_read_is_told_and_the_others_are_imported(tmp_path):
    head = ["t [s]", "x [mm]", "F [N]"]
    names = [[f"sensor {number}"] for number in range(30)]
    write(tmp_path / "a.xlsx", good=[head, *record(1.0)], bad=names)
    found = import_files([tmp_path], {"xlsx": Xlsx()})
    assert [run.name for run in found.runs] == ["a_good"]
    assert [problem.message for problem in found.problems] == ["sheet 'bad': it holds no table of numbers"]


@needed
@pytest.mark.parametrize(
    ("cell", "number"),
    [("0,5", 0.5), ("-,5", -0.5), ("1,5e-3", 1.5e-3), ("1.234,5", 1234.5), ("12,345", 12.345), ("7", 7.0)],
)
def test_numbers_kept_as_texts_with_a_decimal_comma_are_read(tmp_path, cell, number):
    lines = [[0.01 * k, f"{k},25", cell] for k in range(20)]
    table = Xlsx().read(write(tmp_path / "a.xlsx", data=[["t", "Weg, links", "F"], *lines]), {})
    assert list(table.columns) == ["t", "Weg, links", "F"]
    assert table.columns["t"] == pytest.approx(0.01 * np.arange(20))
    assert table.columns["Weg, links"] == pytest.approx(np.arange(20) + 0.25)
    assert table.columns["F"] == pytest.approx([number] * 20)


@needed
def test_a_comma_that_sets_thousands_apart_is_no_decimal_sign(tmp_path):
    lines = [[0.01 * k, "1,234.5", "2,345"] for k in range(20)]
    table = Xlsx().read(write(tmp_path / "a.xlsx", data=[["t", "x", "F"], *lines]), {})
    assert set(table.columns["x"]) == {1234.5} and set(table.columns["F"]) == {"2,345"}
