"""TDMS files, written by the library, give their channels as columns."""

from __future__ import annotations

import sys

import numpy as np
import pytest

from dashpot.contract.reader import ReadingError
from dashpot_formats.tdms import Tdms

nptdms = pytest.importorskip("nptdms", reason="needs dashpot[tdms]")

FORCE = np.sin(np.arange(60) / 7)


def write(path, *segments):
    with nptdms.TdmsWriter(path) as writer:
        for segment in segments:
            writer.write_segment([nptdms.ChannelObject(*channel) for channel in segment])


def test_segments_are_put_together_with_units_and_rate(tmp_path):
    rate = {"wf_increment": 0.002, "unit_string": "kN"}
    write(
        tmp_path / "a.tdms",
        [("rig", "Force", FORCE[:40], rate), ("rig", "Way", np.arange(40, dtype="i2"), {"NI_UnitDescription": "Sec"})],
        [("rig", "Force", FORCE[40:], {}), ("other", "Way", np.arange(5.0), {}), ("rig", "note", ["a", "b"], {})],
    )
    table = Tdms().read(tmp_path / "a.tdms", {})
    assert list(table.columns) == ["Force", "rig/Way", "other/Way"]
    assert np.array_equal(table.columns["Force"], FORCE)
    assert table.columns["rig/Way"].tolist() == list(range(40))
    assert dict(table.units) == {"Force": "kN", "rig/Way": "s"}
    assert table.sampling == 500.0


def test_scaled_numbers_come_scaled(tmp_path):
    scaling = {
        "NI_Number_Of_Scales": 1,
        "NI_Scale[0]_Scale_Type": "Linear",
        "NI_Scale[0]_Linear_Slope": 2.5,
        "NI_Scale[0]_Linear_Y_Intercept": -1.0,
        "NI_Scale[0]_Linear_Input_Source": nptdms.types.Uint32(0xFFFFFFFF),
    }
    write(tmp_path / "a.tdms", [("rig", "Force", np.arange(8, dtype="i4"), scaling)])
    assert np.allclose(Tdms().read(tmp_path / "a.tdms", {}).columns["Force"], 2.5 * np.arange(8) - 1)


def test_dates_are_seconds_since_the_first(tmp_path):
    stamps = np.datetime64("2024-02-28T23:59:59.990", "us") + np.arange(20) * np.timedelta64(1500, "us")
    write(tmp_path / "a.tdms", [("rig", "when", stamps, {})])
    table = Tdms().read(tmp_path / "a.tdms", {})
    assert np.allclose(table.columns["when"], np.arange(20) * 0.0015, atol=1e-9) and table.units["when"] == "s"


def test_different_rates_are_no_rate(tmp_path):
    channels = [("rig", str(rate), FORCE, {"wf_increment": 1 / rate}) for rate in (100, 200)]
    write(tmp_path / "a.tdms", channels)
    assert Tdms().read(tmp_path / "a.tdms", {}).sampling is None


@pytest.mark.parametrize("content", [b"", b"TDSm", b"TDSm" + bytes(24) + b"\xff" * 200, b"text\n" * 30])
def test_a_broken_file_is_told(tmp_path, content):
    (tmp_path / "a.tdms").write_bytes(content)
    with pytest.raises(ReadingError, match="it is not a sound TDMS file|it holds no channels") as caught:
        Tdms().read(tmp_path / "a.tdms", {})
    assert caught.value.hint


def test_without_the_library_the_remedy_is_told(tmp_path, monkeypatch):
    (tmp_path / "a.tdms").write_bytes(b"")
    monkeypatch.setitem(sys.modules, "nptdms", None)
    with pytest.raises(ReadingError, match="need the package nptdms") as caught:
        Tdms().read(tmp_path / "a.tdms", {})
    assert "pip install 'dashpot[tdms]'" in caught.value.hint
