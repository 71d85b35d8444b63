"""``dashpot look`` on real files: a folder of pictures, a table, and JSON that stands alone."""

from __future__ import annotations

import json

import pytest

from dashpot.cli.shell import run
from dashpot.compare import boosting
from dashpot.data.writing import dataset_files


@pytest.fixture
def dataset(tmp_path, monkeypatch):
    from unit.compare.specimens import sweeps

    monkeypatch.setattr(boosting, "find_spec", lambda name: None)
    folder = tmp_path / "data"
    folder.mkdir()
    measured = sweeps()
    for name, text in dataset_files(measured.name, measured.runs).items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder / "dataset.yaml"


def test_a_look_writes_its_files_and_says_what_it_saw(dataset, tmp_path, capsys):
    assert run(["look", str(dataset), "-o", str(tmp_path / "out"), "--quiet", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"look.json", "report.html"}
    assert told == json.loads((tmp_path / "out" / "look.json").read_text(encoding="utf-8"))
    assert [each["gives_back"] for each in told["runs"]] == [False] * 9
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "Force over velocity at mid stroke" in page


def test_a_second_look_overwrites_nothing(dataset, tmp_path, capsys):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "look.json").write_text("mine")
    assert run(["look", str(dataset), "-o", str(tmp_path / "out")]) == 1
    assert (tmp_path / "out" / "look.json").read_text() == "mine"
