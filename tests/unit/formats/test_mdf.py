"""MDF files, written by the library, give their channels as columns."""

from __future__ import annotations

import sys

import numpy as np
import pytest

from dashpot.contract.reader import ReadingError
from dashpot_formats.mdf import Mdf

TIME, SLOW = np.arange(80) / 1000, np.arange(9) / 10
FORCE = np.sin(TIME * 50)


def write(path, *groups, version="4.10", compression=0):
    asammdf = pytest.importorskip("asammdf", reason="needs dashpot[mdf]")
    with asammdf.MDF(version=version) as file:
        for time, channels in groups:
            file.append([asammdf.Signal(timestamps=time, **channel) for channel in channels])
        file.save(path, overwrite=True, compression=compression)


ONE = (TIME, [{"samples": FORCE, "name": "Force", "unit": "kN"}, {"samples": 2 * FORCE, "name": "Way", "unit": "mm"}])
TWO = (SLOW, [{"samples": SLOW**2, "name": "Force", "unit": "N"}, {"samples": SLOW, "name": "Heat", "unit": "°C"}])


@pytest.mark.parametrize(("version", "compression"), [("4.10", 0), ("4.10", 1), ("4.20", 2), ("3.30", 0)])
def test_a_group_has_one_clock(tmp_path, version, compression):
    path = tmp_path / ("a.mf4" if version > "4" else "a.mdf")
    write(path, ONE, version=version, compression=compression)
    table = Mdf().read(path, {})
    assert list(table.columns) == ["time", "Force", "Way"]
    assert np.allclose(table.columns["time"], TIME, atol=1e-12) and np.array_equal(table.columns["Force"], FORCE)
    assert dict(table.units) == {"time": "s", "Force": "kN", "Way": "mm"}


def test_groups_are_told_apart_or_chosen(tmp_path):
    write(tmp_path / "a.mf4", ONE, TWO)
    table = Mdf().read(tmp_path / "a.mf4", {})
    named = ["time (group 1)", "Force (group 1)", "Way", "time (group 2)", "Force (group 2)", "Heat"]
    assert list(table.columns) == named
    assert np.array_equal(table.columns["Force (group 2)"], SLOW**2)
    chosen = Mdf().read(tmp_path / "a.mf4", {"group": 2})
    assert list(chosen.columns) == ["time", "Force", "Heat"] and len(chosen.columns["time"]) == 9
    with pytest.raises(ReadingError, match="it has no group 3 with numbers") as caught:
        Mdf().read(tmp_path / "a.mf4", {"group": 3})
    assert caught.value.hint == "there are: 1, 2"


def test_conversions_are_applied(tmp_path):
    counts = {"samples": np.arange(80, dtype="i2"), "name": "Way", "conversion": {"a": 0.5, "b": -3.0}}
    write(tmp_path / "a.mf4", (TIME, [counts]))
    assert np.allclose(Mdf().read(tmp_path / "a.mf4", {}).columns["Way"], 0.5 * np.arange(80) - 3)


def test_what_is_marked_invalid_is_missing(tmp_path):
    invalid = np.arange(80) == 7
    write(tmp_path / "a.mf4", (TIME, [{"samples": FORCE, "name": "Force", "invalidation_bits": invalid}]))
    assert np.array_equal(np.isnan(Mdf().read(tmp_path / "a.mf4", {}).columns["Force"]), invalid)


@pytest.mark.parametrize("content", [b"", b"MDF     4.10    ", b"MDF     4.10    " + b"\xff" * 500, b"text\n" * 90])
def test_a_broken_file_is_told(tmp_path, content):
    pytest.importorskip("asammdf", reason="needs dashpot[mdf]")
    (tmp_path / "a.mf4").write_bytes(content)
    with pytest.raises(ReadingError, match="it is not a sound MDF file|it holds no channels") as caught:
        Mdf().read(tmp_path / "a.mf4", {})
    assert caught.value.hint


def test_without_the_library_the_remedy_is_told(tmp_path, monkeypatch):
    (tmp_path / "a.mf4").write_bytes(b"")
    monkeypatch.setitem(sys.modules, "asammdf", None)
    with pytest.raises(ReadingError, match="need the package asammdf") as caught:
        Mdf().read(tmp_path / "a.mf4", {})
    assert "pip install 'dashpot[mdf]'" in caught.value.hint
