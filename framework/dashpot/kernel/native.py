"""Keeping and loading compiled networks.

numba cannot cache functions made from text, so the source is written to a file that carries its digest in its name and
is never changed again; numba's own cache beside it holds the machine code, guarded by the versions of numba and the
processor. Equal networks, whatever their numbers, share one file.
"""

from __future__ import annotations

import hashlib
import importlib.util
import os
import sys
import tempfile
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from types import ModuleType
from typing import Any

from dashpot.text.problem import InputError, Place


@dataclass(frozen=True)
class Native:
    """The compiled functions of a network and the file they came from."""

    simulate: Any
    score: Any
    file: Path


def cache_folder() -> Path:
    """``DASHPOT_CACHE``, or ``dashpot`` in the user's cache folder."""
    given = os.environ.get("DASHPOT_CACHE")
    if given:
        return Path(given)
    base = os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA")
    return (Path(base) if base else Path.home() / ".cache") / "dashpot"


def load_native(source: str) -> Native:
    """The compiled functions of a source text, from the cache where they are known.

    Raises InputError when the cache folder cannot be written.
    """
    return _native(source, str(cache_folder()))


def load_module(source: str) -> ModuleType:
    """The compiled file of a source text, from the cache where it is known.

    Raises InputError when the cache folder cannot be written.
    """
    return _load(source, str(cache_folder()))


@lru_cache(maxsize=256)
def _native(source: str, folder: str) -> Native:
    module = _load(source, folder)
    return Native(module.simulate, module.score, Path(str(module.__file__)))


@lru_cache(maxsize=256)
def _load(source: str, folder: str) -> ModuleType:
    digest = hashlib.sha256(source.encode()).hexdigest()[:16]
    name = f"network_{digest}"
    file = Path(folder) / "kernels" / f"{name}.py"
    _write_once(file, source)
    return _import(name, file)


def _import(name: str, file: Path) -> ModuleType:
    found = importlib.util.spec_from_file_location(name, file)
    if found is None or found.loader is None:
        raise ImportError(f"{file} cannot be imported")
    module = importlib.util.module_from_spec(found)
    sys.modules[name] = module
    found.loader.exec_module(module)
    return module


def _write_once(file: Path, text: str) -> None:
    if file.is_file() and file.read_text(encoding="utf-8") == text:
        return
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(dir=file.parent, suffix=".part")
        with os.fdopen(handle, "w", encoding="utf-8") as stream:
            stream.write(text)
        os.replace(temporary, file)
    except OSError as error:
        message = f"compiled networks cannot be kept here: {error.strerror}"
        hint = "let the environment variable DASHPOT_CACHE name a folder that may be written"
        raise InputError.at(Place(str(file.parent)), message, hint) from None
