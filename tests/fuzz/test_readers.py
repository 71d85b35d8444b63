"""Damaged files of every format end in a table or a message: no traceback, no hang, no eating of memory."""

from __future__ import annotations

import random
import signal
import sys
import time
from collections import Counter
from contextlib import contextmanager

import numpy as np
import pytest
from fuzz.mutate import mutated
from fuzz.sound_files import WORDS, sound_files
from seeds import seed_of

from dashpot.contract.reader import ReadingError, Table
from dashpot.contract.registry import load_registry
from dashpot.data.dataset import read_dataset
from dashpot.data.importing.imported import import_files
from dashpot.data.importing.text import dataset_text
from dashpot.text.problem import InputError
from dashpot_formats import apart

SECONDS, MEGABYTES = 20.0, 400
READERS = {word: made() for word, made in load_registry().formats.items()}
# what reads a format, and the extra that it comes with
LIBRARIES = {
    "hdf5": ("h5py", "matlab73"),
    "mdf": ("asammdf", "mdf"),
    "tdms": ("nptdms", "tdms"),
    "xlsx": ("openpyxl", "excel"),
}

DATASET = """\
format: dashpot-dataset/1
runs:
  - name: damaged
    file: a{suffix}
    reader: {word}
    kind: random
    sampling: 100 Hz
    channels: {{displacement: {{column: 1, unit: mm}}, force: {{column: 2, unit: N}}}}
    accept: [units]
"""


@contextmanager
def no_longer_than(seconds):
    """An alarm where the system has one."""
    if not hasattr(signal, "setitimer"):
        yield
        return

    def late(number, frame):
        raise AssertionError(f"reading took more than {seconds} s")

    before = signal.signal(signal.SIGALRM, late)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def peak_memory():
    """The largest memory that this process has had, in megabytes."""
    if sys.platform != "linux":
        return 0.0
    import resource

    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def outcome(reader, path):
    """`table`, or what the message begins with. Anything but a table or a message of ours is an error."""
    try:
        with no_longer_than(SECONDS):
            table = reader.read(path, {})
    except ReadingError as error:
        assert error.message.isprintable() and error.hint
        return error.message[:40]
    assert isinstance(table, Table)
    assert all(isinstance(values, np.ndarray) and values.ndim == 1 for values in table.columns.values())
    assert all(isinstance(unit, str) and unit for unit in table.units.values())
    assert table.sampling is None or table.sampling > 0
    return "table"


def fuzz(word, count, seed, folder):
    """Read `count` damaged files of a format; how often each outcome came, and the seconds and megabytes it took."""
    chance = random.Random(seed)
    reader = READERS[word]
    path = folder / f"a{reader.suffixes[0] if reader.suffixes else '.tsv'}"
    sound = sound_files(word, folder)
    for content in sound:
        path.write_bytes(content)
        assert outcome(reader, path) == "table"
    memory, began, found = peak_memory(), time.monotonic(), Counter()
    for number in range(count):
        path.write_bytes(mutated(chance.choice(sound), chance))
        try:
            found[outcome(reader, path)] += 1
        except Exception as error:
            kept = path.rename(folder / f"failed{number}{path.suffix}")
            raise AssertionError(f"{word}, seed {seed}, file {number} ({kept}): {error!r}") from error
    return found, time.monotonic() - began, peak_memory() - memory


def check(word, count, folder, monkeypatch):
    """Fuzz a reader and tell what came of it."""
    if word in LIBRARIES:
        library, extra = LIBRARIES[word]
        pytest.importorskip(library, reason=f"needs dashpot[{extra}]")
    monkeypatch.setattr(apart, "TIME_LIMIT", SECONDS / 2)
    seed = seed_of(f"test_readers {word}")
    found, seconds, megabytes = fuzz(word, count, seed, folder)
    broken = sum(n for message, n in found.items() if "brings down" in message or "took more" in message)
    print(
        f"{word}: seed {seed}, {found['table']} of {count} read, {broken} crashed or hung the other process, "
        f"{seconds:.1f} s, {megabytes:.0f} MB more, {len(found)} different messages"
    )
    assert sum(found.values()) == count
    assert found["table"] < count
    assert megabytes < MEGABYTES


@pytest.mark.parametrize("word", WORDS)
def test_150_damaged_files(tmp_path, monkeypatch, word):
    check(word, 150, tmp_path, monkeypatch)


@pytest.mark.slow
@pytest.mark.parametrize("word", WORDS)
def test_10_000_damaged_files(tmp_path, monkeypatch, word):
    check(word, 10_000, tmp_path, monkeypatch)


def test_every_reader_has_its_sound_files():
    built_in = {
        word for word, made in load_registry().formats.items() if made.__module__.startswith("dashpot_formats.")
    }
    assert built_in == set(WORDS)


@pytest.mark.parametrize("word", ["csv", "rpc", "tydex", "npz"])
def test_a_dataset_over_damaged_files_is_read_or_told(tmp_path, word):
    seed = seed_of(f"test_readers {word}")
    chance, suffix = random.Random(seed), READERS[word].suffixes[0]
    (tmp_path / "dataset.yaml").write_text(DATASET.format(word=word, suffix=suffix))
    sound = sound_files(word, tmp_path)
    for _ in range(60):
        (tmp_path / f"a{suffix}").write_bytes(mutated(chance.choice(sound), chance))
        try:
            [run] = read_dataset(tmp_path, READERS).runs
        except InputError as error:
            assert "damaged" in str(error)
        else:
            assert all(np.isfinite(values).all() for values in run.channels.values())


@pytest.mark.parametrize("word", ["csv", "json", "npz", "rpc"])
def test_damaged_files_are_imported_or_told(tmp_path, word):
    """What is imported can be read as a dataset, or that tells what is wrong."""
    seed = seed_of(f"test_readers {word}")
    chance, suffix = random.Random(seed), READERS[word].suffixes[0]
    sound = sound_files(word, tmp_path)
    for number in range(40):
        path = tmp_path / f"damaged{number}{suffix}"
        path.write_bytes(mutated(chance.choice(sound), chance))
        try:
            imported = import_files([path], READERS)
        except InputError as error:
            assert path.name in str(error)
            continue
        (tmp_path / "dataset.yaml").write_text(dataset_text(imported, tmp_path, "damaged"), encoding="utf-8")
        try:
            assert read_dataset(tmp_path, READERS).runs
        except InputError as error:
            assert path.stem in str(error)
