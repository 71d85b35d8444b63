"""What takes pieces of work, with two workers."""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from typing import Any

import pytest


def two_workers(kind: str) -> Any:
    """Two ``threads`` or ``processes``, or a cluster in this process (``dask``); a context that ends them."""
    if kind == "threads":
        return ThreadPoolExecutor(2)
    if kind == "processes":
        return ProcessPoolExecutor(2, mp_context=get_context("spawn"))
    distributed = pytest.importorskip("distributed", reason="the extra cluster is not installed")
    return distributed.Client(n_workers=2, threads_per_worker=1, processes=False, dashboard_address=None)
