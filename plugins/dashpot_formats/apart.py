"""Reading in a process of its own, for libraries of native code that a damaged file can bring down.

The process is started when it is first needed, kept for the next files, and started again after a crash. It gets a
path and gives back plain numbers: nothing is pickled. Too much time or memory ends in a message, too.
"""

from __future__ import annotations

import atexit
import json
import os
import subprocess
import sys
import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from dashpot.contract.reader import ReadingError

# seconds for a file, and for each megabyte of it; bytes of memory, and for each byte of the file
TIME_LIMIT, TIME_PER_MEGABYTE = 60.0, 1.0
MEMORY_LIMIT, MEMORY_PER_BYTE = 3 * 1024**3, 24

_SERVE = "from dashpot_formats.serve import serve; serve()"
_ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "NUMEXPR_MAX_THREADS": "1"}


@dataclass(frozen=True)
class Content:
    """Arrays of numbers by name, and what else the function told."""

    arrays: Mapping[str, np.ndarray]
    notes: Mapping[str, Any]


def read_apart(read: Callable[[str], tuple[dict[str, np.ndarray], dict[str, Any]]], path: Path, what: str) -> Content:
    """What `read`, a function of a module of this package, makes of the file, found out in the other process.

    Raises ReadingError, in which the file is called `what`, when it cannot be read.
    """
    size = path.stat().st_size
    request = {
        "module": read.__module__,
        "function": read.__name__,
        "path": str(path.resolve()),
        "memory": MEMORY_LIMIT + MEMORY_PER_BYTE * size,
    }
    answer = _ask(request, TIME_LIMIT + TIME_PER_MEGABYTE * size / 1e6, what)
    if "error" in answer:
        raise ReadingError(f"it is not a sound {what}: {answer['error']}", "save it again")
    return Content(answer["arrays"], answer["notes"])


class _Process:
    """The other process. It ends with this one, as its input is closed then."""

    def __init__(self) -> None:
        paths = os.pathsep.join(entry for entry in sys.path if entry)
        self.owner = os.getpid()
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-c", _SERVE],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env={**os.environ, **_ONE_THREAD, "PYTHONPATH": paths},
        )

    def ask(self, request: Mapping[str, Any], seconds: float) -> dict[str, Any]:
        """The answer. Raises EOFError or OSError when the process ends over it, TimeoutError when it is too slow."""
        assert self._process.stdin and self._process.stdout
        late = threading.Event()

        def stop() -> None:
            late.set()
            self._process.kill()

        timer = threading.Timer(seconds, stop)
        timer.start()
        try:
            self._process.stdin.write(json.dumps(request).encode() + b"\n")
            self._process.stdin.flush()
            return self._answer()
        except (EOFError, OSError):
            if late.is_set():
                raise TimeoutError from None
            raise
        finally:
            timer.cancel()

    def _answer(self) -> dict[str, Any]:
        assert self._process.stdout
        line = self._process.stdout.readline()
        if not line.endswith(b"\n"):
            raise EOFError
        answer: dict[str, Any] = json.loads(line)
        if "error" not in answer:
            answer["arrays"] = {name: self._array(kind, shape) for name, kind, shape in answer["arrays"]}
        return answer

    def _array(self, kind: str, shape: list[int]) -> np.ndarray:
        assert self._process.stdout
        values = np.empty(shape, dtype=kind)
        if values.size and self._process.stdout.readinto(values.reshape(-1).view(np.uint8)) != values.nbytes:  # type: ignore[attr-defined]
            raise EOFError
        return values

    def end(self) -> None:
        """End the process, however it is."""
        if self.owner == os.getpid():
            self._process.kill()
            self._process.wait()
        for stream in (self._process.stdin, self._process.stdout):
            try:
                stream.close()  # type: ignore[union-attr]
            except OSError:
                pass


_lock = threading.Lock()
_running: list[_Process] = []


def _ask(request: Mapping[str, Any], seconds: float, what: str) -> dict[str, Any]:
    with _lock:
        if _running and _running[0].owner != os.getpid():
            _running.clear()
        if not _running:
            _running.append(_Process())
        try:
            return _running[0].ask(request, seconds)
        except TimeoutError:
            message = f"it is not a sound {what}: reading took more than {seconds:.0f} s"
        except (EOFError, OSError):
            message = f"it is not a sound {what}: it brings down the library that reads it"
        except BaseException:
            # interrupted: the answer is still to come, and must not be taken for that to the next request
            _end()
            raise
        _end()
    raise ReadingError(message, "save it again")


@atexit.register
def _end() -> None:
    while _running:
        _running.pop().end()
