"""Linear algebra on one thread.

Runs are spread over threads already. A second level of threads inside the algebra would wait for itself on a busy
machine, and would round differently with their number; without it results are the same on one worker or many.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")


def single_threaded_algebra(work: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """The function with the threads of numpy's and scipy's linear algebra limited to one while it runs."""

    @wraps(work)
    def limited(*args: Arguments.args, **kwargs: Arguments.kwargs) -> Result:
        import scipy.linalg  # noqa: F401 - only a library that is loaded can be limited
        from threadpoolctl import threadpool_limits  # type: ignore[import-untyped]

        with threadpool_limits(1, user_api="blas"):
            return work(*args, **kwargs)

    return limited
