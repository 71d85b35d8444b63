"""Modules of compiled functions, kept by what they are made of, so that numba can keep machine code beside them."""

from __future__ import annotations

import hashlib
import sys
from functools import lru_cache
from importlib.util import module_from_spec, spec_from_file_location
from types import ModuleType

from dashpot.kernel.targets.cache import cache_folder, keep

PREFIX = "dashpot_kernel_"


def load_module(text: str) -> ModuleType:
    """The module of a text. Raises InputError when the cache folder cannot be written."""
    return _module(text, str(cache_folder()))


@lru_cache(maxsize=256)
def _module(text: str, folder: str) -> ModuleType:
    from pathlib import Path

    name = PREFIX + hashlib.sha256(text.encode()).hexdigest()[:32]
    file = Path(folder) / "kernels" / f"{name}.py"
    if not file.is_file() or file.read_bytes() != text.encode():
        keep(file, text.encode())
    spec = spec_from_file_location(name, file)
    assert spec is not None and spec.loader is not None
    module = module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module
