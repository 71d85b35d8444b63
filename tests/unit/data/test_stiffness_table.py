"""Rows of tables of dynamic stiffness become runs; truth: complex numbers, and the harmonics of given forces."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from dashpot.data.dataset import Dataset, read_dataset
from dashpot.data.steady import SAMPLES, STEADY, cosine, fundamental_of, harmonic_of, sine, steady_samples
from dashpot.data.stiffness_text import table_text
from dashpot.data.stream import open_dataset
from dashpot.text.problem import InputError
from dashpot_formats import dashpot_formats

READERS = {reader.word: reader() for reader in dashpot_formats()}
COUNT = steady_samples(10.0)
STORAGE, LOSS = 2.0e5, 4.0e4
KNOWN = {
    "storage": ("N/mm", STORAGE / 1e3),
    "loss": ("kN/mm", LOSS / 1e6),
    "stiffness": ("N/mm", abs(STORAGE + 1j * LOSS) / 1e3),
    "loss_angle": ("deg", np.degrees(np.angle(STORAGE + 1j * LOSS))),
    "loss_factor": ("%", 100.0 * LOSS / STORAGE),
}


def read(
    folder: Path, table: str, *rows: str, head: str = "f,A,p,K,d,T\nHz,mm,mm,N/mm,deg,degC", more: str = ""
) -> Dataset:
    (folder / "t.csv").write_text("\n".join([head, *rows]) + "\n")
    (folder / "dataset.yaml").write_text(
        f"format: dashpot-dataset/1\nname: mount\ntables:\n  - {{name: t, file: t.csv, {table}}}\n{more}"
    )
    return read_dataset(folder, READERS)


COLUMNS = "columns: {frequency: f, amplitude: A, preload: p, stiffness: K, loss_angle: d, temperature: T}"
FORCED = COLUMNS.replace("preload: p", "preload: {column: p, unit: kN}")
ROWS = ("10,0.5,2,200,8,20", "20,0.5,2,210,9,-10")


def test_a_row_is_a_steady_sine_with_its_fundamental(tmp_path):
    first, second = read(tmp_path, COLUMNS, *ROWS).runs
    assert [first.name, second.name, first.kind, first.source] == ["t-1", "t-2", STEADY, "t.csv"]
    assert first.settings == pytest.approx(
        {"frequency": 10.0, "amplitude": 5e-4, "preload": 2e-3, "temperature": 293.15}
    )
    rate = 2.0 * np.pi * first.time * 10.0
    assert first.displacement == pytest.approx(2e-3 + 5e-4 * np.sin(rate), abs=1e-12)
    assert first.force == pytest.approx(200e3 * 5e-4 * np.sin(rate + np.radians(8.0)), abs=1e-8)
    assert second.time[1] == pytest.approx(1.0 / (20.0 * SAMPLES)) and second.order == 1


def test_a_preload_told_as_a_force_is_the_deflection_of_the_static_curve_at_it(tmp_path):
    static = "static: {deflection: [0 mm, 4 mm, 6 mm], force: [0 N, 1 kN, 3 kN]}"
    runs = read(tmp_path, f"{FORCED}, {static}", "10,0.5,0.5,200,8,20", "10,0.5,2,200,8,20").runs
    assert [run.settings["preload"] for run in runs] == pytest.approx([2e-3, 5e-3])


@pytest.mark.parametrize(
    "pair",
    [
        ("storage", "loss"),
        ("stiffness", "loss_angle"),
        ("stiffness", "loss_factor"),
        ("storage", "loss_angle"),
        ("storage", "loss_factor"),
    ],
)
def test_all_ways_to_write_a_dynamic_stiffness_are_the_same_stiffness(tmp_path, pair):
    units, values = zip(*(KNOWN[word] for word in pair), strict=True)
    columns = ", ".join(f"{word}: {{column: {word}, unit: '{unit}'}}" for word, unit in zip(pair, units, strict=True))
    row = ",".join(f"{value!r}" for value in map(float, values))
    (run,) = read(
        tmp_path, f"columns: {{{columns}}}, settings: {{frequency: 10 Hz, amplitude: 1 mm}}", row, head=",".join(pair)
    ).runs
    assert harmonic_of(run.force) / 1e-3 == pytest.approx(STORAGE + 1j * LOSS, rel=1e-9)
    assert run.settings["preload"] == 0.0


@pytest.mark.parametrize(
    ("scatter", "noise"), [("2 %", 0.02 * 200e3 * 5e-4), ("3 N/mm", 3e3 * 5e-4)], ids=["share", "stiffness"]
)
def test_a_stated_scatter_is_the_noise_of_the_force(tmp_path, scatter, noise):
    run = read(tmp_path, f"{COLUMNS}, scatter: {scatter}", *ROWS).runs[0]
    assert run.sensors["force"]["noise"] == pytest.approx(noise)


@pytest.mark.parametrize(("unit", "noise"), [("N/mm", 4e3 * 5e-4), ("%", 0.04 * 200e3 * 5e-4)])
def test_the_scatter_may_be_a_column(tmp_path, unit, noise):
    columns = COLUMNS.replace("temperature: T", "scatter: T")
    run = read(tmp_path, columns, "10,0.5,2,200,8,4", head=f"f,A,p,K,d,T\nHz,mm,mm,N/mm,deg,{unit}").runs[0]
    assert run.sensors["force"]["noise"] == pytest.approx(noise) and "temperature" not in run.settings


def test_a_row_that_lacks_a_number_is_left_out_with_a_word(tmp_path):
    dataset = read(tmp_path, COLUMNS, "10,0.5,2,,8,20", *ROWS)
    assert [run.name for run in dataset.runs] == ["t-2", "t-3"]
    (problem,) = dataset.problems
    assert "1 of its rows lack a number and are left out, the first is line 3 (row 1)" in problem.message
    assert problem.severity == "warning"


@pytest.mark.parametrize(
    ("table", "rows", "message"),
    [
        ("columns: {frequency: f, amplitude: A, stiffness: K}", ROWS, "does not say the dynamic stiffness"),
        ("columns: {amplitude: A, stiffness: K, loss_angle: d}", ROWS, "lacks 'frequency'"),
        (f"{COLUMNS}, settings: {{preload: 1 mm}}", ROWS, "has 'preload' as a column and as a setting"),
        (FORCED, ROWS, "expected the preload as a deflection"),
        (f"{FORCED}, static: {{deflection: [0 mm, 1 mm], force: [0 N, 1 kN]}}", ROWS, "lies beyond the static curve"),
        (f"{FORCED}, static: {{deflection: [0 mm, 1 mm], force: [5 N, 1 N]}}", ROWS, "as many and both growing"),
        (COLUMNS.replace("stiffness: K", "stiffness: {column: K, unit: mm}"), ROWS, "a unit of the same kind"),
        (COLUMNS.replace("stiffness: K", "stiffness: {column: K, nuit: mm}"), ROWS, "did you mean 'unit'"),
        (COLUMNS.replace("stiffness: K", "stiffness: Q"), ROWS, "it has no column 'Q'"),
        (f"{COLUMNS}, scatter: 0 %", ROWS, "above 0, got '0 %'"),
        (COLUMNS, ("0,0.5,2,200,8,20",), "expected a frequency above 0, got 0 in line 3 (row 1)"),
        (COLUMNS, ("10,,2,200,8,20",), "none of its rows has all numbers"),
        ("columns: 5", ROWS, "expected 'frequency: {column: ..., unit: Hz}'"),
    ],
)
def test_a_wrong_table_is_told(tmp_path, table, rows, message):
    with pytest.raises(InputError) as caught:
        read(tmp_path, table, *rows)
    assert message in str(caught.value)


def test_tables_and_runs_stand_side_by_side(tmp_path):
    np.savez(tmp_path / "a.npz", t=np.arange(400) / 1000, x=np.sin(0.1 * np.arange(400)), F=np.cos(np.arange(400)))
    channels = "{time: {column: t, unit: s}, displacement: {column: x, unit: mm}, force: {column: F, unit: N}}"
    more = f"runs:\n  - {{name: a, file: a.npz, kind: random, channels: {channels}}}\n"
    dataset = read(tmp_path, COLUMNS, *ROWS, more=more)
    assert [run.name for run in dataset.runs] == ["a", "t-1", "t-2"]
    stream = open_dataset(tmp_path, READERS)
    assert stream.names == ("a", "t-1", "t-2")
    assert stream.conditions["t-2"]["temperature"] == pytest.approx(263.15)


def test_names_that_are_taken_are_told(tmp_path):
    twice = read(tmp_path, COLUMNS, *ROWS, more=f"  - {{name: t, file: t.csv, {COLUMNS}}}\n")
    assert len(twice.runs) == 2
    assert "table 't' is set aside: another one has the same name" in twice.problems[0].message
    np.savez(tmp_path / "a.npz", t=np.arange(400) / 1000, x=np.sin(0.1 * np.arange(400)), F=np.cos(np.arange(400)))
    channels = "{time: {column: t, unit: s}, displacement: {column: x, unit: mm}, force: {column: F, unit: N}}"
    alike = read(
        tmp_path, COLUMNS, *ROWS, more=f"runs:\n  - {{name: t-2, file: a.npz, kind: random, channels: {channels}}}\n"
    )
    assert [run.name for run in alike.runs] == ["t-2"]
    assert "one of its rows is called 't-2', as a run is" in alike.problems[0].message


def test_the_fundamental_is_parted_from_mean_harmonics_and_what_still_relaxes():
    time = np.arange(COUNT) / SAMPLES
    force = 30.0 * sine(COUNT) - 12.0 * cosine(COUNT)
    others = 500.0 + 10.0 * np.sin(6.0 * np.pi * time + 0.3) + 4.0 * np.cos(18.0 * np.pi * time)
    assert harmonic_of(force + others) == pytest.approx(30.0 - 12.0j, abs=1e-9)
    assert fundamental_of(force + others) == pytest.approx(force, abs=1e-8)
    # a relaxation of 60 N that lasts as long as the run: as a trend of 15 N over the window it shows by less than 1 %
    assert harmonic_of(force + 60.0 * np.exp(-time / time[-1])) == pytest.approx(30.0 - 12.0j, abs=0.15)


def test_a_written_table_reads_back_as_the_same_table(tmp_path):
    dataset = read(tmp_path, COLUMNS, *ROWS)
    text = table_text((run, 2.0 * run.force) for run in dataset.runs)
    (tmp_path / "t.csv").write_text(text)
    measured = COLUMNS.replace(": f", ": frequency").replace(": A", ": amplitude").replace(": p", ": preload")
    measured = measured.replace(": K", ": measured_stiffness").replace(": d", ": measured_loss_angle")
    measured = measured.replace("temperature: T", "temperature: {column: temperature, unit: K}")
    (tmp_path / "dataset.yaml").write_text(
        f"format: dashpot-dataset/1\ntables:\n  - {{name: t, file: t.csv, {measured}, file_options: {{}}}}\n"
    )
    again = read_dataset(tmp_path, READERS)
    for one, other in zip(dataset.runs, again.runs, strict=True):
        assert other.settings == pytest.approx(one.settings) and other.force == pytest.approx(one.force, rel=1e-9)
