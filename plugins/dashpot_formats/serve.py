"""The other side of `apart`: reads one file after the other, and gives back plain numbers."""

from __future__ import annotations

import json
import os
import sys
import warnings
from importlib import import_module
from typing import Any, BinaryIO

import numpy as np

from dashpot.contract.reader import ReadingError


def serve() -> None:
    """Answer requests, a line of JSON each, until the input ends. Whatever libraries print goes nowhere."""
    out = os.fdopen(os.dup(1), "wb")
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    warnings.simplefilter("ignore")
    for line in sys.stdin.buffer:
        _answer(json.loads(line), out)
        out.flush()


def _answer(request: dict[str, Any], out: BinaryIO) -> None:
    try:
        _limit_memory(request["memory"])
        module = import_module(request["module"])
        arrays, notes = getattr(module, request["function"])(request["path"])
        plain = {name: np.ascontiguousarray(values) for name, values in arrays.items()}
        head = {"arrays": [[name, values.dtype.str, values.shape] for name, values in plain.items()], "notes": notes}
        text = json.dumps(head)
    except MemoryError:
        plain, text = {}, json.dumps({"error": "it would take too much memory"})
    except ReadingError as error:
        plain, text = {}, json.dumps({"error": error.message})
    except Exception as error:
        # a damaged file makes a library raise whatever its parser stumbles over
        plain, text = {}, json.dumps({"error": _in_one_line(error)})
    out.write(text.encode() + b"\n")
    for values in plain.values():
        out.write(values.data if values.size else b"")


def _in_one_line(error: Exception) -> str:
    text = " ".join(str(error).split())
    return text[:200] if text else type(error).__name__


def _limit_memory(size: int) -> None:
    try:
        import resource
    except ImportError:
        # Windows has no such limit
        return
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    limit = size if hard == resource.RLIM_INFINITY else min(size, hard)
    resource.setrlimit(resource.RLIMIT_AS, (limit, hard))
