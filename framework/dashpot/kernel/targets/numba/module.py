"""Modules of compiled functions, kept by what they are made of, so that numba can keep machine code beside them."""

from __future__ import annotations

import hashlib
import sys
from functools import lru_cache
from importlib.resources import files as resources
from importlib.util import module_from_spec, spec_from_file_location
from types import ModuleType

from dashpot.kernel.targets.cache import cache_folder, keep

PREFIX, HELPERS = "dashpot_kernel_", ("borrowed.py", "packed.py")


def load_module(text: str) -> ModuleType:
    """The module of a text. Raises InputError when the cache folder cannot be written."""
    return _module(text, str(cache_folder()))


@lru_cache
def _helpers() -> bytes:
    """What the machine code of every module holds besides its own text."""
    own = resources(__package__)
    return b"".join((own / file).read_bytes() for file in HELPERS)


@lru_cache(maxsize=256)
def _module(text: str, folder: str) -> ModuleType:
    from pathlib import Path

    name = PREFIX + hashlib.sha256(text.encode() + _helpers()).hexdigest()[:32]
    file = Path(folder) / "kernels" / f"{name}.py"
    if not file.is_file() or file.read_bytes() != text.encode():
        keep(file, text.encode())
    spec = spec_from_file_location(name, file)
    assert spec is not None and spec.loader is not None
    module = module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module
