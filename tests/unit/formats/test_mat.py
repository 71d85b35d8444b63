"""MATLAB files of both kinds give their vectors and matrices as columns."""

from __future__ import annotations

import sys

import h5py
import numpy as np
import pytest
from scipy.io import savemat

from dashpot.contract.reader import ReadingError
from dashpot_formats.mat import Mat

TIME, FORCE = np.arange(20) / 100, np.arange(20) ** 2.0
MATRIX = np.column_stack([TIME, FORCE, -FORCE])


def write_version_73(path, variables):
    """As MATLAB does: 512 bytes of its own, HDF5 behind, first index fastest."""
    with h5py.File(path, "w", userblock_size=512) as file:
        for name, value in variables.items():
            file.create_dataset(name, data=np.asarray(value).T).attrs["MATLAB_class"] = np.bytes_("double")
    with path.open("r+b") as stream:
        stream.write(b"MATLAB 7.3 MAT-file".ljust(512))


def write_version_5(path, variables):
    savemat(path, variables)


WRITERS = pytest.mark.parametrize("write", [write_version_5, write_version_73])


@WRITERS
def test_vectors_of_either_shape_are_columns(tmp_path, write):
    write(tmp_path / "a.mat", {"t": TIME[None, :], "F": FORCE[:, None], "Ts": np.array([[0.01]])})
    table = Mat().read(tmp_path / "a.mat", {})
    assert sorted(table.columns) == ["F", "t"]
    assert np.array_equal(table.columns["t"], TIME) and np.array_equal(table.columns["F"], FORCE)


@WRITERS
def test_the_columns_of_a_matrix_are_counted_from_one(tmp_path, write):
    write(tmp_path / "a.mat", {"x_F": MATRIX, "other": MATRIX * 2})
    table = Mat().read(tmp_path / "a.mat", {})
    assert np.array_equal(table.columns["x_F(2)"], FORCE)
    assert np.array_equal(table.columns["other(3)"], -2 * FORCE)
    chosen = Mat().read(tmp_path / "a.mat", {"variable": "other"})
    assert list(chosen.columns) == ["1", "2", "3"]
    assert np.array_equal(chosen.columns["1"], 2 * TIME)


@WRITERS
def test_a_matrix_on_its_side_is_turned(tmp_path, write):
    write(tmp_path / "a.mat", {"m": MATRIX.T})
    assert np.array_equal(Mat().read(tmp_path / "a.mat", {"variable": "m", "transpose": True}).columns["2"], FORCE)


def test_fields_of_structs_have_dotted_names(tmp_path):
    savemat(tmp_path / "a.mat", {"run": {"x": {"F": FORCE}, "note": "text"}})
    assert np.array_equal(Mat().read(tmp_path / "a.mat", {}).columns["run.x.F"], FORCE)


def test_groups_of_version_73_have_dotted_names(tmp_path):
    write_version_73(tmp_path / "a.mat", {"run/F": FORCE})
    assert np.array_equal(Mat().read(tmp_path / "a.mat", {}).columns["run.F"], FORCE)


def test_texts_and_cells_are_passed_over(tmp_path):
    savemat(tmp_path / "a.mat", {"F": FORCE, "name": "text", "cell": np.array(["a", 1], dtype=object)})
    assert list(Mat().read(tmp_path / "a.mat", {}).columns) == ["F"]


@pytest.mark.parametrize(
    ("content", "options", "message"),
    [
        ({"F": FORCE}, {"variable": "G"}, "it has no variable 'G' of numbers"),
        ({"F": np.ones((3, 500))}, {"variable": "F"}, "3 rows and 500 columns, expected a row for each sample"),
        ({"F": np.ones((3, 4, 5))}, {"variable": "F"}, "expected a matrix, got an array of shape (3, 4, 5)"),
        ({"Ts": 0.1}, {}, "it holds no vector or matrix of numbers"),
        ({"F": FORCE}, {"variabel": "F"}, "there is no file option 'variabel'"),
        ({"F": FORCE}, {"variable": "F", "transpose": "yes"}, "expected the file option 'transpose' as true or false"),
    ],
)
def test_what_is_wrong_is_told(tmp_path, content, options, message):
    savemat(tmp_path / "a.mat", content)
    with pytest.raises(ReadingError) as caught:
        Mat().read(tmp_path / "a.mat", options)
    assert message in caught.value.message and caught.value.hint


@pytest.mark.parametrize("content", [b"", b"MATLAB 5.0 MAT-file", b"no such thing" * 50, b"\x89HDF\r\n\x1a\n broken"])
def test_a_broken_file_is_told(tmp_path, content):
    (tmp_path / "a.mat").write_bytes(content)
    with pytest.raises(ReadingError, match="not a sound MATLAB"):
        Mat().read(tmp_path / "a.mat", {})


def test_a_file_cut_short_anywhere_is_read_or_told(tmp_path):
    savemat(tmp_path / "a.mat", {"F": FORCE, "s": {"x": TIME}}, do_compression=True)
    sound = (tmp_path / "a.mat").read_bytes()
    for length in range(len(sound)):
        (tmp_path / "b.mat").write_bytes(sound[:length])
        try:
            table = Mat().read(tmp_path / "b.mat", {})
        except ReadingError as error:
            assert error.hint
        else:
            assert np.array_equal(table.columns["F"], FORCE)


def test_without_h5py_the_remedy_is_told(tmp_path, monkeypatch):
    write_version_73(tmp_path / "a.mat", {"F": FORCE})
    monkeypatch.setitem(sys.modules, "h5py", None)
    with pytest.raises(ReadingError) as caught:
        Mat().read(tmp_path / "a.mat", {})
    assert "pip install" in caught.value.hint
