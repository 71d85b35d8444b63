"""Records are taken by the study that made them and by no other, also where the mark of the folder is damaged."""

from __future__ import annotations

import os

import numpy as np
import pytest

from dashpot.fit.replay import Block
from dashpot.fit.study.checkpoint import MARK, Checkpoint
from dashpot.text.problem import InputError

BLOCK = Block(np.arange(6.0).reshape(2, 3), np.array([1.0, 2.0]))
RESULT = {"loss": 1.5}
DAMAGE = {"empty": b"", "bytes that are no text": b"\xff\xfe", "half": b"0123", "zeros": bytes(64)}


def opened(folder, study="this"):
    records = Checkpoint(folder)
    records.open(study)
    return records


@pytest.fixture
def folder(tmp_path):
    """Records of 'this': the blocks of a search that goes on, and the result of one that ended."""
    records = opened(tmp_path / "checkpoint")
    going = records.stage("v1.2-1-coarse-1")
    going.keep(BLOCK)
    going.close()
    records.stage("v1.2-1-coarse-2").finish(RESULT)
    return records.folder


def check_kept(records):
    [block] = records.stage("v1.2-1-coarse-1").blocks()
    assert block.points.tobytes() == BLOCK.points.tobytes()
    assert records.stage("v1.2-1-coarse-2").result() == RESULT


@pytest.mark.parametrize("content", DAMAGE.values(), ids=DAMAGE)
def test_a_damaged_mark_is_written_anew_where_the_records_are_of_this_study(folder, content):
    sound = (folder / MARK).read_bytes()
    (folder / MARK).write_bytes(content)
    check_kept(opened(folder))
    assert (folder / MARK).read_bytes() == sound


@pytest.mark.parametrize("left", ["*.blocks", "*.json"])
def test_one_sound_record_is_enough(folder, left):
    (folder / MARK).write_bytes(b"")
    for pattern in {"*.blocks", "*.json"} - {left}:
        [file] = folder.glob(pattern)
        file.write_bytes(b"spoilt")
    records = opened(folder)
    assert len(records.stage("v1.2-1-coarse-1").blocks()) == (left == "*.blocks")
    assert records.stage("v1.2-1-coarse-2").result() == (RESULT if left == "*.json" else None)


@pytest.mark.parametrize("content", DAMAGE.values(), ids=DAMAGE)
def test_with_a_damaged_mark_the_records_of_another_study_are_refused_and_stay(folder, content):
    (folder / MARK).write_bytes(content)
    before = {file.name: file.read_bytes() for file in folder.iterdir()}
    with pytest.raises(InputError) as caught:
        opened(folder, "another")
    assert str(caught.value) == (
        f"{folder}: its 'study.txt', which tells what its records are of, is damaged, and none of them proves to be of "
        "this study or campaign. choose another -o, or say --force to begin again"
    )
    assert {file.name: file.read_bytes() for file in folder.iterdir()} == before
    check_kept(opened(folder))


def test_a_sound_mark_of_another_study_is_told_apart_from_a_damaged_one(folder):
    with pytest.raises(InputError, match="its records are of another study or campaign: its file, the data, the seed"):
        opened(folder, "another")


def test_a_damaged_mark_without_records_loses_nothing(tmp_path):
    opened(tmp_path)
    (tmp_path / MARK).write_bytes(b"")
    assert opened(tmp_path, "another").stage("a").result() is None


def test_without_a_mark_no_records_of_another_study_are_taken(folder):
    (folder / MARK).unlink()
    check_kept(opened(folder))
    (folder / MARK).unlink()
    records = opened(folder, "another")
    assert records.stage("v1.2-1-coarse-1").blocks() == []
    assert records.stage("v1.2-1-coarse-2").result() is None


def test_names_too_long_for_a_file_are_kept_apart(tmp_path):
    records = opened(tmp_path)
    for number in (1, 2):
        records.stage(f"{'€' * 66}-1-{'橡' * 66}-{number}").finish({"number": number})
    assert records.stage(f"{'€' * 66}-1-{'橡' * 66}-1").result() == {"number": 1}


def test_a_file_is_on_the_disk_before_it_has_its_name(tmp_path, monkeypatch):
    order = []
    for name in ("fsync", "replace"):
        original = getattr(os, name)
        monkeypatch.setattr(os, name, lambda *given, name=name, done=original: (order.append(name), done(*given)))
    opened(tmp_path)
    assert order == ["fsync", "replace"]
