"""HDF5 files, written by the library, give the vectors of a group."""

import numpy as np
import pytest

from dashpot.contract.reader import ReadingError
from dashpot_formats.hdf5 import Hdf5

h5py = pytest.importorskip("h5py", reason="needs dashpot[matlab73]")


def write(path, **values):
    with h5py.File(path, "w") as file:
        for name, array in values.items():
            file[name.replace("__", "/")] = array
    return path


def test_the_group_with_most_numbers_and_its_rate(tmp_path):
    path = write(tmp_path / "a.h5", sweep__u=np.arange(50.0)[:, None], sweep__y=np.arange(50.0) ** 2,
                 sweep__fs=np.array([[750.0]]), noise__u=np.arange(20.0), noise__fs=np.array([100.0]))  # fmt: skip
    table = Hdf5().read(path, {})
    assert table.columns["u"].tolist() == list(range(50)) and "fs" not in table.columns
    assert table.sampling == 750.0
    assert Hdf5().read(path, {"group": "noise"}).sampling == 100.0


def test_vectors_at_the_top_and_matrices(tmp_path):
    matrix = np.arange(60.0).reshape(20, 3)
    columns = Hdf5().read(write(tmp_path / "a.hdf5", t=np.arange(20.0), m=matrix.T), {}).columns
    assert list(columns) == ["m(1)", "m(2)", "m(3)", "t"]
    assert columns["m(2)"].tolist() == matrix[:, 1].tolist()


def test_unknown_groups_and_other_files_are_refused(tmp_path):
    path = write(tmp_path / "a.h5", sweep__u=np.arange(50.0))
    with pytest.raises(ReadingError, match="no group 'swep'") as caught:
        Hdf5().read(path, {"group": "swep"})
    assert "sweep" in caught.value.hint
    (tmp_path / "b.h5").write_text("t,x\n")
    with pytest.raises(ReadingError, match="not a sound HDF5 file"):
        Hdf5().read(tmp_path / "b.h5", {})
