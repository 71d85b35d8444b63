"""Where compiled networks are kept."""

from __future__ import annotations

import hashlib
import hmac
import os
import stat
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from unit.kernel.networks import compiled

from dashpot.data.drive import drive_from_samples
from dashpot.kernel.cache import DIGEST, cache_folder
from dashpot.kernel.network import compile_network
from dashpot.kernel.targets.llvm import native
from dashpot.model.element import Element, Parameter, Response
from dashpot.model.network import Branch, Group, NetworkSpec, Value
from dashpot.testing import random_drive

DAMPER = "it: {element: damper, damping: 5}"
OTHER = "other: {element: damper, damping: 7}"
ASK = """
import sys
sys.path[:0] = {path!r}
from unit.kernel.networks import compiled
print(compiled("it: {entry}").native(1).file, end="")
"""


def compile_elsewhere(entry: str) -> str:
    """The file of a network that another process compiles."""
    code = ASK.format(path=sys.path, entry=entry)
    return subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    monkeypatch.setenv("DASHPOT_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


def test_the_cache_lies_where_the_environment_says(monkeypatch):
    monkeypatch.setenv("DASHPOT_CACHE", "/somewhere/else")
    assert cache_folder() == Path("/somewhere/else")
    monkeypatch.delenv("DASHPOT_CACHE")
    monkeypatch.setenv("XDG_CACHE_HOME", "/of/the/user")
    assert cache_folder() == Path("/of/the/user/dashpot")
    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.delenv("LOCALAPPDATA", raising=False)
    assert cache_folder() == Path.home() / ".cache" / "dashpot"


def test_networks_that_differ_in_numbers_and_names_share_one_file(folder):
    files = {compiled(branches).native(1).file for branches in (DAMPER, OTHER)}
    assert len(files) == 1
    assert files == set((folder / "kernels").glob("*.o"))
    assert compiled(DAMPER).native(1) is compiled(OTHER).native(1)


def test_another_process_takes_the_machine_code_from_the_cache(folder):
    file = Path(compile_elsewhere("{element: damper, damping: 5}"))
    stamp = file.stat().st_mtime_ns
    assert compile_elsewhere("{element: damper, damping: 7}") == str(file)
    assert file.stat().st_mtime_ns == stamp and list(file.parent.glob("*.o")) == [file]


DAMAGES = [lambda code: code[:-1], lambda code: b"", lambda code: code[:40] + b"!" + code[41:]]


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_file_is_written_again(folder, damage):
    file = Path(compile_elsewhere("{element: inerter, inertance: 5}"))
    code = file.read_bytes()
    file.write_bytes(damage(code))
    assert compile_elsewhere("{element: inerter, inertance: 5}") == str(file)
    assert file.read_bytes() == code


def test_no_half_written_file_stays_behind(folder):
    compiled(DAMPER).native(1)
    assert not list((folder / "kernels").glob("*.part"))


BACKENDS = pytest.mark.parametrize("backend", ["llvm", "numba"])


@BACKENDS
def test_without_a_cache_that_can_be_written_networks_run_all_the_same(tmp_path, monkeypatch, backend):
    (tmp_path / "taken").write_text("a file, not a folder")
    monkeypatch.setenv("DASHPOT_CACHE", str(tmp_path / "taken"))
    monkeypatch.setenv("DASHPOT_BACKEND", backend)
    drive = random_drive(np.random.default_rng(1), "sweep", 1e-3, 0.01, 50)
    found = compiled(DAMPER)
    assert found.simulate(found.prepare(drive)) == pytest.approx(5.0 * drive.velocity)


@BACKENDS
def test_a_disk_that_is_full_keeps_nothing_and_stops_nothing(folder, monkeypatch, backend):
    def full(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setenv("DASHPOT_BACKEND", backend)
    network = "it: {element: inerter, inertance: 7}"
    compiled(network).native(1) if backend == "numba" else monkeypatch.setattr("tempfile.mkstemp", full)
    native._native.cache_clear()
    drive = random_drive(np.random.default_rng(1), "sweep", 1e-3, 0.01, 50)
    found = compiled(network)
    assert found.simulate(found.prepare(drive)) == pytest.approx(7.0 * drive.acceleration)


POSIX = pytest.mark.skipif(os.name != "posix", reason="other systems keep the folders of users apart by themselves")


@POSIX
def test_nobody_else_may_enter_the_folder(folder):
    (folder / "kernels").mkdir(parents=True, mode=0o777)
    (folder / "kernels").chmod(0o777)
    file = compiled(DAMPER).native(1).file
    assert file.parent == folder / "kernels"
    assert stat.S_IMODE(file.parent.stat().st_mode) == 0o700
    assert stat.S_IMODE((file.parent / "key").stat().st_mode) == 0o600


@POSIX
def test_a_folder_that_is_a_link_or_of_somebody_else_is_not_used(folder, tmp_path, monkeypatch):
    folder.mkdir()
    (folder / "kernels").symlink_to(tmp_path)
    assert compiled(DAMPER).native(1).file.parent not in (tmp_path, folder / "kernels")
    (folder / "kernels").unlink()
    (folder / "kernels").mkdir()
    monkeypatch.setattr("os.geteuid", lambda: 12345)
    assert compiled(DAMPER).native(1).file.parent != folder / "kernels"


def test_code_that_was_not_kept_by_this_user_is_not_run(folder):
    entry, other = "{element: inerter, inertance: 5}", "{element: damper, damping: 5}"
    file, another = Path(compile_elsewhere(entry)), Path(compile_elsewhere(other))
    code, foreign = file.read_bytes(), another.read_bytes()
    for planted in (
        foreign,  # made by this user for another network
        hashlib.sha256(foreign[DIGEST:]).digest() + foreign[DIGEST:],  # a digest that anybody can make
        hmac.digest(bytes(DIGEST), file.name.encode() + b"\0" + foreign[DIGEST:], "sha256") + foreign[DIGEST:],
    ):
        file.write_bytes(planted)
        assert compile_elsewhere(entry) == str(file)
        assert file.read_bytes() == code
    (file.parent / "key").unlink()
    assert compile_elsewhere(entry) == str(file)
    assert file.read_bytes()[DIGEST:] == code[DIGEST:] and file.read_bytes() != code


def test_a_compiled_network_answers_a_lane_and_a_block_alike(folder):
    found = compiled(DAMPER)
    run = found.prepare(random_drive(np.random.default_rng(1), "sweep", 1e-3, 0.01, 50))
    assert found.simulate(run).shape == (50,)
    assert found.simulate(run, found.start).shape == (50,)
    assert found.simulate(run, found.start[None]).shape == (1, 50)
    with pytest.raises(ValueError, match="zip"):
        found.simulate(run, np.ones((2, 5)))


class Law(Element):
    """A law that is changed under the same name."""

    word = "law"
    stiffness = Parameter("N/m", "slope", bounds=(1.0, 1e9))
    most = np.inf

    def step(self, x, z, p, dt):
        return Response(np.minimum(p.stiffness * x.new, self.most))


def code_of_law() -> tuple[Path, np.ndarray]:
    """The file of a network with the law as it is now, and the force at 3 mm and 2 N/mm."""
    spec = NetworkSpec("n", Group("", "parallel", (Branch("it", Law, {"stiffness": Value(2e3, "N/m")}, {}),)))
    found = compile_network(spec)
    return found.native(1).file, found.simulate(found.prepare(drive_from_samples(1e-3, np.full(5, 3e-3))))


def test_a_law_that_was_changed_is_compiled_again(folder, monkeypatch):
    first, force = code_of_law()
    assert force == pytest.approx(np.full(5, 6.0))
    monkeypatch.setattr(Law, "most", 5.0)
    second, force = code_of_law()
    assert second != first and force == pytest.approx(np.full(5, 5.0))


@pytest.mark.parametrize("change", ["llvmlite.__version__", "llvmlite.binding.llvm_version_info"])
def test_another_version_of_the_compiler_compiles_again(folder, monkeypatch, change):
    before = compiled(DAMPER).native(1).file
    monkeypatch.setattr(change, (99, 9, 9) if "info" in change else "99.9")
    assert compiled(DAMPER).native(1).file != before
    assert len(list((folder / "kernels").glob("*.o"))) == 2


def test_another_processor_compiles_again(folder, monkeypatch):
    before = compiled(DAMPER).native(1).file
    monkeypatch.setenv("DASHPOT_PROCESSOR", "generic")
    assert compiled(DAMPER).native(1).file != before


def test_other_numbers_compile_nothing(folder, monkeypatch):
    network_with_tables = "it: {{element: spring, stiffness: {{deflection: [0, {x}, 3 mm], force: [0, 5, {x}]}}}}"
    drive = random_drive(np.random.default_rng(1), "sweep", 1e-3, 0.01, 50)
    for lanes in (1, 2, 9, 40):
        found = compiled(network_with_tables.format(x=1e-3))
        found.simulate(found.prepare(drive), np.repeat(found.start[None], lanes, axis=0))
    monkeypatch.setattr(native, "compiled", None)
    for lanes in (1, 2, 9, 40):
        found = compiled(network_with_tables.format(x=2e-3))
        found.simulate(found.prepare(drive), np.repeat(found.start[None], lanes, axis=0))
