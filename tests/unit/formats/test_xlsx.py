"""Excel workbooks, written by the library, give the table of a sheet."""

import datetime
import importlib.util

import numpy as np
import pytest

from dashpot.contract.reader import ReadingError
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
