"""A library that crashes, hangs or eats memory over a file ends in a message, and the next file is read."""

from __future__ import annotations

import importlib
import sys

import numpy as np
import pytest

from dashpot.contract.reader import ReadingError
from dashpot_formats import apart

READERS = """
import os, time
import numpy as np

def sound(path):
    print("a library may print")
    table = np.arange(6.0).reshape(2, 3)
    return {"x": table, "empty": np.zeros(0), "turned": table.T}, {"note": 1}

def crash(path):
    os.abort()

def hang(path):
    time.sleep(600)

def devour(path):
    return {"x": np.ones(10**11)}, {}

def stumble(path):
    raise ZeroDivisionError("a line\\nand another")

def leave(path):
    raise SystemExit(3)
"""


@pytest.fixture
def readers(tmp_path, monkeypatch):
    """A module of readers that behave badly, known to the other process."""
    (tmp_path / "bad_readers.py").write_text(READERS)
    monkeypatch.syspath_prepend(str(tmp_path))
    apart._end()
    (tmp_path / "file").write_bytes(b"")
    yield importlib.import_module("bad_readers")
    sys.modules.pop("bad_readers", None)
    apart._end()


def test_arrays_and_notes_come_as_they_are(readers, tmp_path):
    content = apart.read_apart(readers.sound, tmp_path / "file", "file")
    assert np.array_equal(content.arrays["x"], np.arange(6.0).reshape(2, 3))
    assert np.array_equal(content.arrays["turned"], np.arange(6.0).reshape(2, 3).T)
    assert content.arrays["empty"].size == 0 and content.notes == {"note": 1}


@pytest.mark.parametrize(
    ("function", "message"),
    [
        ("crash", "it brings down the library"),
        ("leave", "it brings down the library"),
        ("hang", "reading took more than"),
        ("stumble", "a line and another"),
        pytest.param("devour", "too much memory", marks=pytest.mark.skipif(sys.platform != "linux", reason="no limit")),
    ],
)
def test_what_goes_wrong_is_told_and_the_next_file_is_read(readers, tmp_path, monkeypatch, function, message):
    monkeypatch.setattr(apart, "TIME_LIMIT", 0.5 if function == "hang" else 60.0)
    with pytest.raises(ReadingError, match="not a sound thing") as caught:
        apart.read_apart(getattr(readers, function), tmp_path / "file", "thing")
    assert message in caught.value.message and caught.value.hint
    monkeypatch.setattr(apart, "TIME_LIMIT", 60.0)
    assert apart.read_apart(readers.sound, tmp_path / "file", "file").notes == {"note": 1}


def test_an_interrupted_reading_leaves_nothing_behind(readers, tmp_path, monkeypatch):
    """The answer to the interrupted request is not taken for that to the next one."""
    real = apart._Process._answer
    monkeypatch.setattr(apart._Process, "_answer", lambda process: (_ for _ in ()).throw(KeyboardInterrupt))
    with pytest.raises(KeyboardInterrupt):
        apart.read_apart(readers.stumble, tmp_path / "file", "thing")
    monkeypatch.setattr(apart._Process, "_answer", real)
    assert apart.read_apart(readers.sound, tmp_path / "file", "file").notes == {"note": 1}


def test_one_process_serves_many_files(readers, tmp_path):
    apart.read_apart(readers.sound, tmp_path / "file", "file")
    first = apart._running[0]
    apart.read_apart(readers.sound, tmp_path / "file", "file")
    assert apart._running == [first]
