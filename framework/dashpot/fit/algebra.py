"""Linear algebra on one thread.

Runs are spread over threads already. A second level of threads inside the algebra would wait for itself on a busy
machine, and would round differently with their number; without it results are the same on one worker or many.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from threading import Lock
from typing import Any, ParamSpec, TypeVar

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")


def single_threaded_algebra(work: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """The function with the threads of numpy's and scipy's linear algebra limited to one while it runs."""

    @wraps(work)
    def limited(*args: Arguments.args, **kwargs: Arguments.kwargs) -> Result:
        with _LIMIT.held():
            return work(*args, **kwargs)

    return limited


class _Limit:
    """One limit for the process: the first thread that needs it sets it, the last one lifts it."""

    def __init__(self) -> None:
        self._lock, self._holders = Lock(), 0
        self._limits: Any = None

    @contextmanager
    def held(self) -> Iterator[None]:
        """The limit, as long as the block lasts."""
        with self._lock:
            self._holders += 1
            if self._holders == 1:
                self._limits = _limits()
        try:
            yield
        finally:
            with self._lock:
                self._holders -= 1
                if self._holders == 0:
                    self._limits.restore_original_limits()


def _limits() -> Any:
    import scipy.linalg  # noqa: F401 - only a library that is loaded can be limited
    from threadpoolctl import threadpool_limits  # type: ignore[import-untyped]

    return threadpool_limits(1, user_api="blas")


_LIMIT = _Limit()
