"""Sorted programs on disk, so that no other process has to sort the same equations again.

What a program follows from is in the name of its file: the laws of the network as graphs, how it is put together, the
text of all code that makes programs and prints them, and the version of numpy, which computes constants. So no file can
be out of date, and a plugin's law is traced in every process.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Hashable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from dashpot.expr.written import read_graphs, write_graphs
from dashpot.kernel.cache import keep_sealed, kernel_folder, read_sealed

PACKAGES = ("expr", "model", "kernel")  # with all that a program depends on beside the laws


def kept_graphs(parts: Hashable, make: Callable[[], Any]) -> tuple[Any, str]:
    """The graphs that ``make`` answers, from the cache where they are known, and the digest of all they come from.

    ``parts`` (texts, numbers and tuples of them) is what tells them from those of other networks.
    """
    digest = hashlib.sha256(repr((_code(), np.__version__, parts)).encode()).hexdigest()[:32]
    file = kernel_folder() / f"{digest}.program"
    known = read_sealed(file)
    if known is None:
        known = write_graphs(make()).encode()
        keep_sealed(file, known)
    return read_graphs(known.decode()), digest


@cache
def _code() -> str:
    """The digest of the code that programs come from."""
    root, digest = Path(__file__).resolve().parents[2], hashlib.sha256()
    for package in PACKAGES:
        for file in sorted((root / package).rglob("*.py")):
            digest.update(file.read_bytes())
    return digest.hexdigest()
