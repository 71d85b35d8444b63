"""HDF5 files, written by the library, give the vectors of a group."""

import numpy as np
import pytest

from dashpot.contract.reader import ReadingError
from dashpot_formats.hdf5 import Hdf5
from dashpot_formats.mat import Mat

h5py = pytest.importorskip("h5py", reason="needs dashpot[matlab73]")


def write(path, **values):
    with h5py.File(path, "w") as file:
        for name, array in values.items():
            file[name.replace("__", "/")] = array
    return path


def test_the_group_with_most_numbers_and_its_rate(tmp_path):
    path = write(
        tmp_path / "a.h5",
        sweep__u=np.arange(50.0)[:, None],
        sweep__y=np.arange(50.0) ** 2,
        sweep__fs=np.array([[750.0]]),
        noise__u=np.arange(20.0),
        noise__fs=np.array([100.0]),
    )
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


@pytest.mark.parametrize("suffix", [".h5", ".mat"])
@pytest.mark.parametrize("kind", ["external", "virtual", "link"])
def test_numbers_that_lie_in_other_files_are_not_fetched(tmp_path, suffix, kind):
    secret = tmp_path / "secret"
    secret.write_bytes(np.arange(1.0, 21.0).tobytes())
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["F"] = np.arange(1.0, 21.0)
    path = tmp_path / f"a{suffix}"
    with h5py.File(path, "w") as file:
        file["x"] = np.arange(20.0)
        if kind == "external":
            file.create_dataset("F", (20,), float, external=[(str(secret), 0, 160)])
        elif kind == "virtual":
            layout = h5py.VirtualLayout((20,), float)
            layout[:] = h5py.VirtualSource(str(tmp_path / "other.h5"), "F", (20,))
            file.create_virtual_dataset("F", layout)
        else:
            file["F"] = h5py.ExternalLink(str(tmp_path / "other.h5"), "F")
    reader = Hdf5() if suffix == ".h5" else Mat()
    if kind == "link":
        assert set(reader.read(path, {}).columns) == {"x"}
        return
    with pytest.raises(ReadingError, match="'F' lies in other files"):
        reader.read(path, {})
