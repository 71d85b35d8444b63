"""Result files: nothing is overwritten unasked, and no half-written file is left behind."""

from __future__ import annotations

import os

import pytest

from dashpot.cli.output import OutputFolder
from dashpot.text.problem import InputError


def test_every_file_in_the_way_is_named(tmp_path):
    for name in ("b.json", "a+x.yaml", "other.txt"):
        (tmp_path / name).touch()
    with pytest.raises(InputError) as raised:
        OutputFolder(tmp_path, force=False).claim("b.json", "a+*.yaml", "c.html")
    named = [problem.place.file for problem in raised.value.problems]
    assert named == [str(tmp_path / "a+x.yaml"), str(tmp_path / "b.json")]
    assert "--force" in str(raised.value)


def test_force_overwrites(tmp_path):
    (tmp_path / "b.json").write_text("old")
    folder = OutputFolder(tmp_path, force=True)
    folder.claim("b.json")
    assert folder.write("b.json", "new").read_text() == "new"


def test_a_missing_folder_is_made(tmp_path):
    folder = OutputFolder(tmp_path / "deep" / "er", force=False)
    folder.claim("b.json")
    assert folder.write("b.json", "å\n").read_bytes() == "å\n".encode()
    assert os.listdir(folder.path) == ["b.json"]


def test_a_file_is_no_folder(tmp_path):
    (tmp_path / "out").touch()
    with pytest.raises(InputError, match="expected a folder, got a file"):
        OutputFolder(tmp_path / "out", force=True).claim("b.json")


def test_a_failed_write_keeps_the_old_file(tmp_path, monkeypatch):
    folder = OutputFolder(tmp_path, force=True)
    folder.write("b.json", "old")

    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "replace", interrupt)
    with pytest.raises(KeyboardInterrupt):
        folder.write("b.json", "new")
    assert (tmp_path / "b.json").read_text() == "old"
