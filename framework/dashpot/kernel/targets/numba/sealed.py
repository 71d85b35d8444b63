"""Machine code of numba on disk, each file with the digest by which this user knows it again.

numba's own files are pickles that it loads whoever wrote them. Here a file is loaded that carries the right digest;
anything else is compiled anew.
"""

from __future__ import annotations

import hashlib
import pickle
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import numba
from numba.core.caching import FunctionCache
from numba.core.dispatcher import Dispatcher
from numba.core.serialize import dumps

from dashpot.kernel.cache import keep_sealed, read_sealed


def seal(module: ModuleType, folder: Path) -> None:
    """Let every function of a module that was not called yet keep its machine code under a seal in ``folder``."""
    for value in vars(module).values():
        if isinstance(value, Dispatcher) and value.py_func.__module__ == module.__name__:
            function: Any = value
            function._cache = _SealedCache(function.py_func, folder)


class _SealedCache(FunctionCache):
    """numba's cache of a function, with other files."""

    def __init__(self, function: Callable[..., Any], folder: Path) -> None:
        super().__init__(function)
        self._cache_file = _SealedFiles(folder, self._impl.filename_base)


class _SealedFiles:
    """What numba asks of the files of a function: a file for each kind of arguments and processor, its ``key``."""

    def __init__(self, folder: Path, name: str) -> None:
        self._folder, self._name = folder, name

    def load(self, key: Any) -> Any:
        """What was saved; None where there is nothing, or nothing that this user has written."""
        content = read_sealed(self._file(key))
        known, data = pickle.loads(content) if content is not None else (None, None)
        return data if known == key else None

    def save(self, key: Any, data: Any) -> None:
        """Keep it, where there is room."""
        keep_sealed(self._file(key), dumps((key, data)))

    def flush(self) -> None:
        """Forget all that was saved."""
        for file in self._folder.glob(f"{self._name}.*.nbc"):
            file.unlink(missing_ok=True)

    def _file(self, key: Any) -> Path:
        digest = hashlib.sha256(f"{numba.__version__} {key!r}".encode()).hexdigest()[:32]
        return self._folder / f"{self._name}.{digest}.nbc"
