"""What the benchmark of instructions counts is the compiled code as it is called."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from dashpot.kernel.targets.llvm.native import load_native

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


@pytest.fixture
def works(monkeypatch):
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    before = set(sys.modules)
    from counting import works

    yield works()
    for name in set(sys.modules) - before:
        if str(BENCHMARKS) in str(getattr(sys.modules[name], "__file__", "")):
            del sys.modules[name]


def test_the_code_of_each_work_runs_with_what_it_was_called_with(works):
    assert len(works) == 3
    for name, work in works.items():
        before = [np.copy(each) for each in work.arguments if isinstance(each, np.ndarray)]
        load_native(work.text, len(work.arguments))(*work.arguments)
        after = [each for each in work.arguments if isinstance(each, np.ndarray)]
        changed = [new for old, new in zip(before, after, strict=True) if not np.array_equal(old, new, equal_nan=True)]
        assert work.units > 0 and changed, name
        assert all(np.isfinite(each).all() for each in changed), name
