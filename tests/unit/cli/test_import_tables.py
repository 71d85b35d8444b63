"""``dashpot import`` on tables of dynamic stiffness, and what is read from the dataset it writes."""

from __future__ import annotations

import json

import numpy as np
import pytest

import dashpot as dp

GERMAN = (
    "Frequenz;Amplitude;Kdyn;Verlustwinkel;Temperatur\nHz;mm;N/mm;deg;degC\n1;0,1;220,5;4,1;23\n10;1,5;240;5,2;40\n"
)
PLAIN = "f,A (mm),K',K'',note\n1,0.1,220,14,3\n10,0.1,240,22,3\n"
RECORD = "t,x,F\ns,mm,N\n" + "".join(
    f"{n / 100:.2f},{np.sin(n / 10):.4f},{200 * np.sin(n / 10 + 0.1):.3f}\n" for n in range(600)
)


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "mount.csv").write_text(GERMAN)
    (tmp_path / "other.csv").write_text(PLAIN)
    return tmp_path


def test_a_table_with_stated_units_is_read_as_it_was_written(call, folder):
    code, out, _ = call("import", folder / "mount.csv")
    assert code == 0 and "loss_angle   'Verlustwinkel'  deg   unit stated in the file" in out
    runs = dp.load_dataset(folder / "dataset.yaml").runs
    assert [run.settings["frequency"] for run in runs] == [1.0, 10.0]
    assert [run.settings["amplitude"] for run in runs] == pytest.approx([0.1e-3, 1.5e-3])
    assert [run.settings["temperature"] for run in runs] == pytest.approx([296.15, 313.15])
    # a quarter of a cycle after zero the force is the storage stiffness times the amplitude
    storage = 240e3 * np.cos(np.radians(5.2))
    assert np.interp(0.025, runs[1].time, runs[1].force) == pytest.approx(1.5e-3 * storage, rel=1e-3)


def test_units_that_are_not_stated_are_guessed_and_have_to_be_confirmed(call, folder):
    _, out, _ = call("import", folder / "other.csv")
    assert "the storage 'K'' is taken to be in N/mm: no unit is stated" in out
    text = (folder / "dataset.yaml").read_text()
    assert "amplitude: {column: A, unit: mm}\n" in text and "# not used: note" in text
    assert text.count("# CONFIRM: the unit, which is not stated") == 3
    assert call("check", folder / "dataset.yaml")[0] == 0


def test_tables_and_records_stand_in_one_dataset(call, folder):
    (folder / "record.csv").write_text(RECORD)
    out = json.loads(call("import", folder, "--json")[1])
    assert [run["name"] for run in out["runs"]] == ["record"]
    assert [table["name"] for table in out["tables"]] == ["mount", "other"]
    assert len(dp.load_dataset(folder / "dataset.yaml").runs) == 5


def test_a_preload_told_as_a_force_is_not_used_and_told(call, tmp_path):
    rows = "1,0.1,220,4,500\n5,0.1,230,5,500\n"
    (tmp_path / "table.csv").write_text(f"f,amplitude,Kdyn,delta,preload\nHz,mm,N/mm,deg,N\n{rows}")
    _, out, _ = call("import", tmp_path / "table.csv")
    assert "'preload' may be a preload told as a force: say its column, and the static curve under 'static'" in out
    assert "preload: {" not in (tmp_path / "dataset.yaml").read_text()


def test_an_amplitude_that_is_missing_is_asked_for(call, tmp_path):
    (tmp_path / "table.csv").write_text("freq,Kdyn,tan delta\nHz,N/mm,1\n1,220,0.07\n5,230,0.08\n")
    _, out, _ = call("import", tmp_path / "table.csv")
    assert "no column was found for the amplitude" in out
    assert "# CONFIRM: settings: {amplitude: ...}" in (tmp_path / "dataset.yaml").read_text()


def test_a_record_over_time_is_no_table(call, tmp_path):
    (tmp_path / "record.csv").write_text(RECORD)
    out = json.loads(call("import", tmp_path / "record.csv", "--json")[1])
    assert out["tables"] == [] and len(out["runs"]) == 1


@pytest.mark.parametrize("unit", ["", " (N/m)"])
def test_a_loss_without_unit_has_that_of_the_storage(call, tmp_path, unit):
    (tmp_path / "si.csv").write_text(f"f,A (mm),K'{unit},K''\n1,0.1,724732,46405\n10,0.1,780000,52000\n")
    _, out, _ = call("import", tmp_path / "si.csv")
    assert "the loss 'K''' is taken to be in N/m: no unit is stated" in out
    assert "loss: {column: \"K''\", unit: N/m}" in (tmp_path / "dataset.yaml").read_text()
