"""Measurement tables of PEtab problems: what maps, and what is refused with its line."""

from __future__ import annotations

import numpy as np
import pytest

from dashpot.contract.reader import ReadingError
from dashpot_formats.petab import Petab

HEAD = "observableId\tpreequilibrationConditionId\tsimulationConditionId\tmeasurement\ttime\n"
ROWS = "F\t\tc1\t2.5\t1\nF\t\tc1\t1.5\t0\nx\t\tc1\t0.1\t0\nx\t\tc1\t0.2\t1\nF\t\tc2\t9\t0\n"


def read(folder, text=HEAD + ROWS, **options):
    (folder / "measurements.tsv").write_text(text)
    return Petab().read(folder / "measurements.tsv", options)


def test_a_condition_becomes_columns_in_the_order_of_time(tmp_path):
    table = read(tmp_path, condition="c1")
    assert list(table.columns) == ["time", "F", "x"]
    assert table.columns["time"].tolist() == [0.0, 1.0]
    assert table.columns["F"].tolist() == [1.5, 2.5]
    assert table.columns["x"].tolist() == [0.1, 0.2]


def test_the_numbers_of_a_condition_become_constant_columns(tmp_path):
    (tmp_path / "conditions.tsv").write_text(
        "conditionId\tconditionName\ttemperature\tload\nc1\tcold\t253\t\nc2\t\t300\t5\n"
    )
    table = read(tmp_path, condition="c1", conditions="conditions.tsv")
    assert np.array_equal(table.columns["temperature"], [253.0, 253.0])
    assert "load" not in table.columns


@pytest.mark.parametrize(
    ("text", "options", "told"),
    [
        (HEAD + ROWS, {}, "expected one of the conditions c1, c2, none was named"),
        (HEAD + ROWS, {"condition": "c3"}, "expected one of the conditions c1, c2, got 'c3'"),
        (HEAD + "F\t\tc1\tmuch\t0\n", {}, "expected a number for 'measurement', got 'much'"),
        (HEAD + "F\t\tc1\t1\tinf\n", {}, "expected a finite time, got 'inf'"),
        (HEAD + "F\tc0\tc1\t1\t0\n", {}, "has a pre-equilibration"),
        (HEAD + "F\t\tc1\t1\t0\nF\t\tc1\t2\t0\n", {}, "'F' of 'c1' is measured twice at 0"),
        (HEAD + "F\t\tc1\t1\t0\nx\t\tc1\t2\t1\n", {}, "expected the same times for all observables of 'c1'"),
        (HEAD, {}, "expected rows below the header"),
        ("a\tb\n1\t2\n", {}, "with the column observableId, simulationConditionId, measurement, time, got a, b"),
        (HEAD + ROWS, {"condition": "c1", "conditions": "none.tsv"}, "there is no condition table 'none.tsv'"),
        (HEAD + ROWS, {"condition": "c1", "conditions": "../c.tsv"}, "expected 'conditions' as a file beside"),
        (HEAD + ROWS, {"kondition": "c1"}, "there is no file option 'kondition'"),
    ],
)
def test_what_does_not_map_is_refused(tmp_path, text, options, told):
    with pytest.raises(ReadingError) as caught:
        read(tmp_path, text, **options)
    assert told in caught.value.message


def test_a_condition_that_names_a_parameter_is_refused(tmp_path):
    (tmp_path / "conditions.tsv").write_text("conditionId\ttemperature\nc1\theat\n")
    with pytest.raises(ReadingError, match="expected a number for 'temperature', got 'heat'") as caught:
        read(tmp_path, condition="c1", conditions="conditions.tsv")
    assert caught.value.line == 2
