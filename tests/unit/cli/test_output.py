"""Result files: nothing is overwritten unasked, and no half-written file is left behind."""

from __future__ import annotations

import os
from contextlib import nullcontext

import pytest

from dashpot.cli.output import OutputFolder, Results
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
    assert os.listdir(tmp_path) == ["b.json"]


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
    assert os.listdir(tmp_path) == ["b.json"]


def test_a_set_appears_together_or_not_at_all(tmp_path):
    folder = OutputFolder(tmp_path, force=False)
    with pytest.raises(ZeroDivisionError), folder.together() as results:
        results.write("a.json", "1")
        raise ZeroDivisionError
    assert os.listdir(tmp_path) == []
    with folder.together() as results:
        results.write("a.json", "1")
        results.write("b.json", "2")
        assert not (tmp_path / "a.json").exists()
    assert sorted(os.listdir(tmp_path)) == ["a.json", "b.json"]


def die_at(monkeypatch, number):
    """Let the process end, as far as the folder can see, before renaming for the `number`th time."""
    left, replace = [number], os.replace

    def dying(*arguments):
        left[0] -= 1
        if left[0] < 0:
            raise SystemExit
        replace(*arguments)

    monkeypatch.setattr(os, "replace", dying)
    monkeypatch.setattr(Results, "discard", lambda self: None)


@pytest.mark.parametrize("number", range(5))
def test_after_an_interruption_at_any_rename_the_same_files_may_be_written(tmp_path, monkeypatch, number):
    names = ("a.json", "b.json", "c.json")
    folder = OutputFolder(tmp_path, force=False)
    (tmp_path / "other.json").write_text("complete")
    with monkeypatch.context() as patched:
        die_at(patched, number)
        with pytest.raises(SystemExit) if number < 4 else nullcontext(), folder.together() as results:
            for name in names:
                results.write(name, "1")
    if number == 4:  # one rename for the list of what is unfinished, three for the files
        with pytest.raises(InputError, match="a.json: exists already"):
            folder.claim(*names)
        return
    with pytest.raises(InputError, match="other.json: exists already"):
        folder.claim(*names, "other.json")
    folder.claim(*names)
    with folder.together() as results:
        for name in names:
            results.write(name, "2")
    assert sorted(os.listdir(tmp_path)) == [*names, "other.json"]
    assert {(tmp_path / name).read_text() for name in names} == {"2"}


def test_of_two_calls_in_one_folder_the_second_is_refused(tmp_path):
    folder = OutputFolder(tmp_path / "out", force=True)
    with folder.locked():
        with pytest.raises(InputError, match="another call of dashpot is writing into this folder"):
            with OutputFolder(tmp_path / "out", force=True).locked():
                pass
    with folder.locked():
        pass
    assert os.listdir(folder.path) == []
