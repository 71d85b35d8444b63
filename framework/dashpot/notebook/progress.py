"""How a call in a notebook shows that it goes on, and how it is ended early."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from dashpot.fit.api import Progress, silent

PAUSE = 0.1  # s between two lines
WIDTH = 100


class Cancelled(Exception):
    """The work was ended by its caller before it was done.

    Examples:
        >>> dp.fit("mount.yaml", data, cancel=lambda: True)
        Traceback (most recent call last):
        dashpot.notebook.progress.Cancelled: ended by its caller at 'mount: search'
    """


@contextmanager
def hearing(progress: Progress | bool, cancel: Callable[[], bool] | None) -> Iterator[Progress]:
    """What the layers below are to call: ``progress(stage, done, error, floor)``.

    True writes a line on standard error that changes as the work goes on and is wiped at its end. ``cancel`` is asked
    each time; where it answers True the work ends with ``Cancelled``.
    """
    line = _Line() if progress is True else None
    heard: Progress = line or (progress if callable(progress) else silent)

    def hear(stage: str, done: float | None = None, error: float | None = None, floor: float | None = None) -> None:
        if cancel is not None and cancel():
            raise Cancelled(f"ended by its caller at '{stage}'")
        heard(stage, done, error, floor)

    try:
        yield hear if cancel is not None else heard
    finally:
        if line:
            line.wipe()


class _Line:
    def __init__(self) -> None:
        self._told, self._drawn = -PAUSE, False

    def __call__(self, stage: str, done: float | None, error: float | None, floor: float | None) -> None:
        if time.monotonic() - self._told < PAUSE:
            return
        parts = [stage, f"{done:.0%}" if done else "", f"RMSE {error:.4g} N" if error is not None else ""]
        parts += [f"noise floor {floor:.4g} N"] if floor is not None else []
        self._draw(", ".join(filter(None, parts)))
        self._told, self._drawn = time.monotonic(), True

    def wipe(self) -> None:
        if self._drawn:
            self._draw("")
            self._draw("", end="\r")

    def _draw(self, text: str, end: str = "") -> None:
        sys.stderr.write(f"\r{text[:WIDTH]:{WIDTH}}{end}")
        sys.stderr.flush()
