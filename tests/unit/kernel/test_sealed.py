"""Machine code of numba is loaded where this user has kept it; what somebody else has put in its place is not."""

from __future__ import annotations

import os
import pickle
import py_compile
import struct
from importlib.util import cache_from_source
from pathlib import Path

import pytest

from dashpot.kernel.targets.numba import module

TEXT = """
from numba import njit

@njit(cache=True)
def twice(x):
    return 2.0 * x
"""


class Trap:
    """A pickle that makes a folder where it is loaded."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def __reduce__(self):
        return os.mkdir, (str(self.folder),)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("DASHPOT_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache" / "kernels"


def loaded():
    """The function as another process has it: read from disk where it is there."""
    module._module.cache_clear()
    return module.load_module(TEXT).twice


def kept(folder):
    [file] = folder.rglob("*.nbc")
    return file


def test_what_was_compiled_is_not_compiled_again(folder):
    assert loaded()(4.0) == 8.0
    content = kept(folder).read_bytes()
    function = loaded()
    assert function(4.0) == 8.0
    assert sum(function.stats.cache_hits.values()) == 1 and not function.stats.cache_misses
    assert kept(folder).read_bytes() == content


def test_every_kind_of_arguments_has_a_file_and_all_can_be_forgotten(folder):
    function = loaded()
    assert (function(4.0), function(4)) == (8.0, 8.0)
    assert len(list(folder.rglob("*.nbc"))) == 2
    function.recompile()
    assert (loaded()(4.0), loaded()(4)) == (8.0, 8.0)


@pytest.mark.parametrize("spoil", ["pickle", "bit", "empty", "of another file"])
def test_a_file_without_the_seal_is_not_loaded_and_made_anew(folder, tmp_path, spoil):
    function = loaded()
    assert function(4.0) == 8.0
    file = kept(folder)
    sound = file.read_bytes()
    trap = pickle.dumps(Trap(tmp_path / "sprung"))
    if spoil == "of another file":
        function(4)
        [other] = set(folder.rglob("*.nbc")) - {file}
        trap = other.read_bytes()
        other.unlink()
    bit = bytearray(sound)
    bit[-1] ^= 1
    file.write_bytes({"bit": bytes(bit), "empty": b""}.get(spoil, trap))
    again = loaded()
    assert again(4.0) == 8.0
    assert sum(again.stats.cache_misses.values()) == 1 and not again.stats.cache_hits
    assert not (tmp_path / "sprung").exists()
    assert sum(loaded().stats.cache_hits.values()) == 0
    last = loaded()
    assert last(4.0) == 8.0 and sum(last.stats.cache_hits.values()) == 1


def test_files_of_numba_and_bytecode_in_the_folder_are_not_executed(folder, tmp_path):
    loaded()(4.0)
    assert not list(folder.rglob("*.nbi"))
    [source] = folder.glob("*.py")
    name = loaded()._cache._impl.filename_base
    beside = Path(cache_from_source(str(source)))
    beside.parent.mkdir(exist_ok=True)
    (beside.parent / f"{name}.nbi").write_bytes(pickle.dumps(Trap(tmp_path / "sprung")))
    (tmp_path / "other.py").write_text("def twice(x):\n    return 3.0 * x\n")
    py_compile.compile(str(tmp_path / "other.py"), cfile=str(beside))
    # bytecode that the loader of Python would take for that of the source
    found, content = source.stat(), beside.read_bytes()
    beside.write_bytes(content[:8] + struct.pack("<LL", int(found.st_mtime), found.st_size) + content[16:])
    assert loaded()(4.0) == 8.0
    assert not (tmp_path / "sprung").exists()
