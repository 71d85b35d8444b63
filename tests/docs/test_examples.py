"""Every public name has an example in its docstring, and it runs as it stands there."""

from __future__ import annotations

import doctest
import sys
from typing import Any

import numpy as np
import pytest
from architecture.source import ROOT

import dashpot as dp

sys.path.insert(0, str(ROOT / "docs"))

from building.api import examples, public_names  # noqa: E402

NAMES = [name for names in public_names().values() for name in names]


def test_no_public_name_is_left_out():
    assert {*NAMES, "__version__"} == set(dp.__all__)


@pytest.mark.parametrize("name", NAMES)
def test_every_public_name_has_an_example(name):
    assert examples(getattr(dp, name))


def test_every_example_runs(bench, monkeypatch):
    monkeypatch.chdir(bench)
    names: dict[str, Any] = {"dp": dp, "np": np, "__name__": "examples"}
    said: list[str] = []
    for name in NAMES:
        test = doctest.DocTest(examples(getattr(dp, name)), names, name, None, None, None)
        runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
        runner.run(test, out=said.append, clear_globs=False)
        names.update(test.globs)
    assert not said, "".join(said)
