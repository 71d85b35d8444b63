"""Work on several runs at once, in threads: numpy and compiled loops let go of the interpreter."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar

Result = TypeVar("Result")


def spread(work: Callable[..., Result], *items: Iterable[Any], jobs: int) -> list[Result]:
    """What ``work`` makes of each set of items, in their order, no more than ``jobs`` at once."""
    if jobs == 1:
        return list(map(work, *items))
    with ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(work, *items))
