"""Files of numpy arrays give their vectors and matrices as columns; nothing is unpickled."""

from __future__ import annotations

import io
import zipfile

import numpy as np
import pytest

from dashpot.contract.reader import ReadingError
from dashpot_formats.npz import Npz

TIME, FORCE = np.arange(20) / 100, np.arange(20, dtype=np.float32)


def test_vectors_are_columns_by_name_and_matrices_column_by_column(tmp_path):
    np.savez(tmp_path / "a.npz", t=TIME, F=FORCE, rate=100.0, m=np.column_stack([TIME, FORCE]))
    table = Npz().read(tmp_path / "a.npz", {})
    assert list(table.columns) == ["t", "F", "m(1)", "m(2)"]
    assert table.columns["F"].dtype == float and np.array_equal(table.columns["F"], FORCE)


def test_one_array_is_chosen_by_name(tmp_path):
    np.savez_compressed(tmp_path / "a.npz", a=TIME, m=np.vstack([TIME, FORCE]))
    table = Npz().read(tmp_path / "a.npz", {"variable": "m", "transpose": True})
    assert list(table.columns) == ["1", "2"] and np.array_equal(table.columns["2"], FORCE)


def test_a_single_array_has_numbered_columns(tmp_path):
    np.save(tmp_path / "a.npy", np.column_stack([TIME, FORCE]))
    assert np.array_equal(Npz().read(tmp_path / "a.npy", {}).columns["1"], TIME)


def test_pickled_objects_are_refused(tmp_path):
    np.savez(tmp_path / "a.npz", F=np.array([{}, {}], dtype=object))
    with pytest.raises(ReadingError, match="pickle"):
        Npz().read(tmp_path / "a.npz", {})


def test_a_file_that_unpacks_to_gigabytes_is_refused(tmp_path):
    np.savez(tmp_path / "a.npz", F=FORCE)
    raw = bytearray((tmp_path / "a.npz").read_bytes())
    directory = raw.rindex(b"PK\x01\x02")
    # the uncompressed size in the zip directory
    raw[directory + 24 : directory + 28] = (0xFFFFFFFE).to_bytes(4, "little")
    with zipfile.ZipFile(tmp_path / "a.npz") as archive:
        assert len(archive.infolist()) == 1
    (tmp_path / "a.npz").write_bytes(raw)
    with pytest.raises(ReadingError, match="unpacked it would take 4.0 GiB"):
        Npz().read(tmp_path / "a.npz", {})


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04", b"\x93NUMPY\x01\x00", b"text"])
def test_a_broken_file_is_told(tmp_path, content):
    (tmp_path / "a.npz").write_bytes(content)
    with pytest.raises(ReadingError, match="not a sound file"):
        Npz().read(tmp_path / "a.npz", {})


def test_a_file_without_numbers_is_told(tmp_path):
    np.savez(tmp_path / "a.npz", name="text", rate=1.0)
    with pytest.raises(ReadingError, match="no vector or matrix"):
        Npz().read(tmp_path / "a.npz", {})


def head_of(shape: tuple[int, ...], kind: str) -> bytes:
    """The head of an array, with a few bytes behind it."""
    content = io.BytesIO()
    np.lib.format.write_array_header_1_0(content, {"descr": kind, "fortran_order": False, "shape": shape})
    return content.getvalue() + bytes(64)


@pytest.mark.parametrize(
    "shape, kind, told",
    [
        ((10**12,), "<f8", "7450.6 GiB"),
        ((2**28,), "<f8", "2.0 GiB"),
        ((2**28,), "|i1", "2.0 GiB"),
        ((2**14, 2**14), "<f4", "2.0 GiB"),
    ],
)
def test_arrays_are_capped_by_what_they_unpack_to(tmp_path, shape, kind, told):
    (tmp_path / "a.npy").write_bytes(head_of(shape, kind))
    with zipfile.ZipFile(tmp_path / "a.npz", "w") as archive:
        archive.writestr("F.npy", head_of(shape, kind))
    for name in ("a.npy", "a.npz"):
        with pytest.raises(ReadingError, match=f"unpacked it would take {told}"):
            Npz().read(tmp_path / name, {})


def test_zeros_that_pack_well_are_no_way_around_it(tmp_path):
    # 256 MB of bytes, packed to less than one, would become eight times as many
    archive = zipfile.ZipFile(tmp_path / "a.npz", "w", zipfile.ZIP_DEFLATED)
    with archive, archive.open("F.npy", "w") as stream:
        np.lib.format.write_array_header_1_0(stream, {"descr": "|i1", "fortran_order": False, "shape": (2**28,)})
        for _ in range(2**8):
            stream.write(bytes(2**20))
    assert (tmp_path / "a.npz").stat().st_size < 2**20
    with pytest.raises(ReadingError, match="unpacked it would take 2.0 GiB"):
        Npz().read(tmp_path / "a.npz", {})
