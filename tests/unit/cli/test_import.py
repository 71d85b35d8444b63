"""``dashpot import`` on files as a rig leaves them, and ``dashpot check`` on what it writes."""

from __future__ import annotations

import json

import numpy as np
import pytest

TIME = np.arange(4000) / 500


def rig_file(amplitude, seed, units="s;mm;N"):
    """A sweep with decimal commas and German names."""
    phase = 2 * np.pi * (TIME + TIME**2)
    way, speed = 12 + amplitude * np.sin(phase), amplitude * 2 * np.pi * (1 + 2 * TIME) * np.cos(phase)
    force = 180 * way + 3 * speed + np.random.default_rng(seed).normal(size=TIME.size)
    rows = "".join(f"{t:.3f};{x:.5f};{f:.3f}\n".replace(".", ",") for t, x, f in zip(TIME, way, force, strict=True))
    return (f"Prüfstand 7\nZeit;Weg;Kraft\n{units}\n" + rows).encode("cp1252")


@pytest.fixture
def folder(tmp_path):
    for name, amplitude, seed in (("a1", 1, 1), ("a1_b", 1, 2), ("a4", 4, 3)):
        (tmp_path / f"{name}.csv").write_bytes(rig_file(amplitude, seed))
    return tmp_path


def test_clear_files_become_a_dataset_that_check_finds_good(call, folder):
    code, out, err = call("import", *sorted(folder.glob("*.csv")))
    assert (code, err) == (0, "")
    assert "'Kraft'" in out and "repeats a1" in out and "sign: -1" in out
    text = (folder / "dataset.yaml").read_text(encoding="utf-8")
    assert "    force: {column: Kraft, unit: N}\n" in text and "   # CONFIRM" not in text
    assert "# - CONFIRM the kinds and settings of the runs" in text
    assert "# - CONFIRM the order of the runs" in text
    assert "settings: {amplitude: 4 mm, preload: 12 mm, start: 1 Hz, stop: 17 Hz}" in text
    assert call("check", folder / "dataset.yaml") == (0, f"{folder / 'dataset.yaml'}: good\n", "")


def test_what_was_imported_can_be_fitted(call, folder, tmp_path):
    assert call("import", folder, "--quiet") == (0, "", "")
    code, _, err = call("fit", "kelvin_voigt", folder, "-o", tmp_path / "fit", "--quiet")
    assert (code, err) == (0, "")
    found = json.loads((tmp_path / "fit" / "fit.json").read_text())
    damping = next(value for key, value in found["parameters"].items() if key.endswith("damping"))
    assert damping["value"] == pytest.approx(3000, rel=0.01)


@pytest.mark.slow
def test_what_was_imported_can_be_diagnosed(call, folder, tmp_path):
    assert call("import", *folder.glob("*.csv"), "--quiet") == (0, "", "")
    code, _, err = call("diagnose", "kelvin_voigt", folder / "dataset.yaml", "-o", tmp_path / "diagnosis", "--quiet")
    assert (code, err) == (0, "")
    found = json.loads((tmp_path / "diagnosis" / "diagnosis.json").read_text())
    # a spring and a dashpot with a little noise: nothing is missing
    assert found["verdict"] == "nothing_missing"
    assert found["noise_floor"]["value"] == pytest.approx(1.0, rel=0.2)


def test_nothing_is_overwritten_unasked(call, folder):
    (folder / "dataset.yaml").write_text("mine")
    code, _, err = call("import", folder)
    assert code == 1 and "exists already" in err and "--force" in err
    assert (folder / "dataset.yaml").read_text() == "mine"
    assert call("import", folder, "--force")[0] == 0
    assert (folder / "dataset.yaml").read_text() != "mine"


def test_measured_files_stay_as_they_are(call, folder):
    before = {path: (path.read_bytes(), path.stat().st_mtime_ns) for path in folder.glob("*.csv")}
    call("import", folder)
    assert {path: (path.read_bytes(), path.stat().st_mtime_ns) for path in folder.glob("*.csv")} == before


def test_the_next_command_names_the_dataset_as_seen_from_here(call, folder, monkeypatch):
    monkeypatch.chdir(folder.parent)
    _, said, _ = call("import", folder.name)
    assert f"Next: dashpot check {folder.name}/dataset.yaml\n" in said


def test_a_dataset_elsewhere_leads_to_its_files(call, folder, tmp_path):
    out = tmp_path / "elsewhere" / "my.yaml"
    code, said, _ = call("import", folder / "a1.csv", "-o", out)
    assert code == 0 and f"Next: dashpot check {out} --allow-outside" in said
    assert "../a1.csv" in out.read_text()
    assert call("check", out)[0] == 1
    assert call("check", out, "--allow-outside")[0] == 0


def test_the_result_for_programs(call, folder):
    code, out, _ = call("import", folder, "--json", "-o", folder / "sub")
    content = json.loads(out)
    assert code == 0 and content["format"] == "dashpot-import/1"
    assert [run["name"] for run in content["runs"]] == ["a1", "a1_b", "a4"]
    assert content["runs"][1]["repeats"] == "a1"
    force = content["runs"][0]["channels"]["force"]
    assert force == {"column": "Kraft", "unit": "N", "sign": 1, "found_by": "its name and unit"}
    assert content["confirm"][0]["runs"] == ["a1", "a1_b", "a4"]


def test_a_file_that_cannot_be_read_is_left_out_and_named(call, folder):
    (folder / "notes.txt").write_text("no numbers at all\n")
    code, _, err = call("import", folder)
    assert code == 0 and "left out" in err and "notes.txt" in err


def test_a_format_is_named_where_the_file_does_not_tell(call, tmp_path):
    (tmp_path / "run.rpt").write_bytes(rig_file(1, 1))
    assert "no reader takes files ending in '.rpt'" in call("import", tmp_path / "run.rpt")[2]
    assert call("import", tmp_path / "run.rpt", "--reader", "csv")[0] == 0
    assert "reader: csv" in (tmp_path / "dataset.yaml").read_text()
    assert call("check", tmp_path)[0] == 0


def test_a_rate_is_given_where_the_files_have_none(call, tmp_path):
    lines = rig_file(1, 1).decode("cp1252").splitlines()
    (tmp_path / "a.csv").write_text("\n".join(line.partition(";")[2] for line in lines[1:]))
    assert "not found" in call("import", tmp_path)[1]
    assert "no time channel, no sampling rate" in call("check", tmp_path)[2]
    assert call("import", tmp_path, "--sampling", "0.5 kHz", "--force")[0] == 0
    assert call("check", tmp_path)[0] == 0


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["--sampling", "5 mm"], 2, "--sampling: expected a quantity in Hz"),
        (["--sampling", "-5 Hz"], 2, "--sampling: expected a rate above 0"),
        (["--reader", "nothing"], 1, "there is no reader 'nothing'"),
        (["-o", "data.txt"], 1, "expected a file ending in .yaml, or a folder"),
    ],
)
def test_what_is_wrong_with_the_command_is_told(call, folder, arguments, code, message):
    found, _, err = call("import", folder, *arguments)
    assert found == code and message in err


def test_check_tells_what_is_wrong_with_a_dataset(call, folder):
    call("import", folder)
    (folder / "a4.csv").unlink()
    code, _, err = call("check", folder)
    assert code == 1 and "run 'a4' (a4.csv) is set aside: there is no such file" in err


def test_check_takes_a_measured_file_with_its_sidecar(call, folder):
    channels = "{time: {column: Zeit}, displacement: {column: Weg}, force: {column: Kraft}}"
    (folder / "a1.csv.yaml").write_text(f"format: dashpot-dataset/1\nkind: sweep\nchannels: {channels}\n")
    assert call("check", folder / "a1.csv") == (0, f"{folder / 'a1.csv'}: good\n", "")


def test_check_tells_broken_yaml_and_other_files_as_before(call, tmp_path):
    (tmp_path / "broken.yaml").write_text("a: [1, 2")
    assert call("check", tmp_path / "broken.yaml")[0] == 1
    assert call("check", tmp_path / "nothing.yaml")[0] == 1
