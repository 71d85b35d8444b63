"""Modules of compiled functions, kept by what they are made of, with their machine code beside them.

numba wants a file for every module. It is never read again: a module is made from the text that asks for it, and its
machine code is loaded only with this user's seal.
"""

from __future__ import annotations

import hashlib
import sys
from functools import lru_cache
from importlib.resources import files as resources
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

from dashpot.kernel.cache import keep, kernel_folder, passing_folder
from dashpot.kernel.targets.numba.sealed import seal

PREFIX, HELPERS = "dashpot_kernel_", ("borrowed.py", "native.py", "packed.py", "statements.py")


def load_module(text: str) -> ModuleType:
    """The module of a text."""
    return _module(text, kernel_folder())


@lru_cache
def _helpers() -> bytes:
    """What the machine code of every module holds besides its own text."""
    own = resources(__package__)
    return b"".join((own / file).read_bytes() for file in HELPERS)


@lru_cache(maxsize=256)
def _module(text: str, folder: Path) -> ModuleType:
    name = PREFIX + hashlib.sha256(text.encode() + _helpers()).hexdigest()[:32]
    file = folder / f"{name}.py"
    known = file.is_file() and file.read_bytes() == text.encode()
    if not known and not keep(file, text.encode()):
        file = passing_folder() / file.name
        keep(file, text.encode())
    spec = spec_from_file_location(name, file)
    assert spec is not None
    module = module_from_spec(spec)
    sys.modules[name] = module
    # the loader would take bytecode that lies beside the file, whoever wrote it
    exec(compile(text, str(file), "exec"), vars(module))
    seal(module, file.parent)
    return module
