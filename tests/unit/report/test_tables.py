"""A table says the same on the page, in the terminal and as CSV."""

from __future__ import annotations

import csv
import io

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from unit.report.report_samples import comparison, model

from dashpot.report.grids import comparison_grid, parameters_grid
from dashpot.report.look import look_grid
from dashpot.report.parts import Column, Grid
from dashpot.report.tables import cell_text, plain_table, to_csv

COLUMNS = (Column("run", "run"), Column("rmse", "RMSE", "N", 3))

# a carriage return alone is a line end to csv readers
names = st.text(st.characters(exclude_categories=["Cs", "Cc"])).filter(lambda name: name[:1] not in tuple("=+-@"))


def read(text: str) -> list[list[str]]:
    return list(csv.reader(io.StringIO(text, newline="")))


@given(st.lists(st.tuples(names, st.floats(allow_nan=False, allow_infinity=False))))
def test_csv_reads_back_exactly(cells):
    header, *rows = read(to_csv([{"run": run, "rmse": rmse} for run, rmse in cells], COLUMNS))
    assert header == ["run", "RMSE (N)"]
    assert [(run, float(rmse)) for run, rmse in rows] == cells


def test_what_has_no_value_is_an_empty_cell():
    rows = [{"run": None, "rmse": np.nan}, {"rmse": np.inf}, {"run": "b", "rmse": np.float64(0.1)}]
    assert read(to_csv(rows, COLUMNS))[1:] == [["", ""], ["", ""], ["b", "0.1"]]


@pytest.mark.parametrize("name", ["=HYPERLINK(1)", "+1", "-1+2", "@SUM(A1)", "\t=1"])
def test_no_text_becomes_a_formula_in_a_spreadsheet(name):
    assert read(to_csv([{"run": name}], COLUMNS))[1][0] == f"'{name}"


def test_a_negative_number_stays_a_number():
    assert read(to_csv([{"run": "a", "rmse": -3.5}], COLUMNS))[1][1] == "-3.5"


def test_the_terminal_shows_headings_units_and_rounded_numbers():
    text = plain_table(Grid("Errors", COLUMNS, [{"run": "a1", "rmse": 61.04}, {"run": "b", "rmse": None}]))
    assert "RMSE (N)" in text
    assert [line.split() for line in text.splitlines()[-3:]] == [["a1", "61.0"], ["b", "–"], []]


def test_markup_in_a_name_is_shown_not_obeyed():
    text = plain_table(Grid("[red]title[/red]", COLUMNS, [{"run": "[bold]a[/bold]", "rmse": 1.0}]))
    assert "[bold]a[/bold]" in text and "[red]title[/red]" in text


def test_counts_are_not_given_decimals():
    columns = [Column("free", "free parameters", "", 3)]
    assert "12" in plain_table(Grid("", columns, [{"free": 12}])).split()


def test_the_terminal_shows_what_is_said_below_a_table():
    assert "where the noise comes from" in plain_table(Grid("Errors", COLUMNS, [], "where the noise comes from"))


def test_parameters_stand_in_a_row_with_those_of_other_models():
    one = model("one", 9.0) | {"parameters": {"a.limit": {"value": 9e3, "unit": "N"}, "c.gain": {"value": 2.0}}}
    other = model("other", 9.0) | {
        "parameters": {"a.limit": {"value": 3e4, "unit": "N"}, "b.time": {"value": 1e-3, "unit": "s"}}
    }
    grid = parameters_grid({"models": [one, other, model("failed", 1.0) | {"parameters": {}}]})
    assert [row["parameter"] for row in grid.rows] == ["a.limit", "b.time", "c.gain"]
    assert [column.title for column in grid.columns] == ["parameter", "unit", "one", "other"]
    limit, time, gain = grid.rows
    assert limit["unit"] == "kN" and (limit["model 0"], limit["model 1"]) == pytest.approx((9.0, 30.0))
    assert (time["model 0"], time["model 1"]) == (None, pytest.approx(1.0))
    assert gain["unit"] is None and gain["model 0"] == 2.0


def test_a_model_that_failed_has_no_numbers_and_its_reason_below():
    failed = {"name": "axle", "parameters": {}, "rmse": None, "nrmse": None, "per_run": {}, "status": "it fell apart"}
    grid = comparison_grid(comparison() | {"models": [model("one", 9.0), failed]})
    assert grid.rows[1]["train"] is None and grid.rows[1]["ratio"] is None
    assert grid.caption.endswith("axle: it fell apart.")


def test_the_interval_of_a_row_gives_the_decimals():
    column = Column("value", "value", "", 4, interval="interval")
    rows = [{"value": 7.9736, "interval": (4.923, 12.91)}, {"value": 7.9736, "interval": None}, {"value": 7.9736}]
    assert [cell_text(column, row) for row in rows] == ["8", "7.974", "7.974"]


def test_in_a_narrow_terminal_no_name_and_no_number_is_cut():
    name = "kelvin_voigt+preload_dependent_damping+friction"
    columns = [Column("run", "run"), *(Column(f"{i}", f"a long heading {i}", "N", 4) for i in range(6))]
    grid = Grid("", columns, [{"run": name} | {f"{i}": 12345.6 for i in range(6)}])
    text = plain_table(grid, 80)
    assert text.split().count("12346") == 6
    assert name in "".join(line.split(" ", 2)[1] for line in text.splitlines() if line.strip())


def test_a_look_shows_no_dust_of_rounding_and_small_energies_in_millijoules():
    run = {"run": "a", "amplitude": 5e-4, "preload": 6.4e-10, "peak_speed": 0.08, "energy_per_cycle": 9.5e-4}
    run |= {"least_force": -0.7, "largest_force": 0.7, "cycles": 37, "stiffness": 575.0, "loss": 1210.0}
    run |= {"repeats": "", "gives_back": False}
    grid = look_grid({"runs": [run], "faults": []})
    shown = {column.heading: cell_text(column, grid.rows[0]) for column in grid.columns}
    assert (shown["middle (mm)"], shown["energy per cycle (mJ)"]) == ("0", "0.950")
    warm = look_grid({"runs": [run, run | {"energy_per_cycle": -4.0}], "faults": []})
    assert [row["energy"] for row in warm.rows] == [9.5e-4, -4.0]
