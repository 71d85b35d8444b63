"""The tutorial of plugins/README.md: a user's own optimizer in under 15 lines, and it works."""

from __future__ import annotations

import re
from importlib.metadata import EntryPoint
from pathlib import Path

import numpy as np
import pytest

from dashpot.contract.chain import make_optimizer
from dashpot.contract.optimizer import Space
from dashpot.contract.registry import build_registry, load_registry
from dashpot.fit.search import Ending, run_search

PAGE = Path(__file__).resolve().parents[3] / "plugins" / "README.md"
TRUTH = np.array([0.3, 0.6, 0.45])


@pytest.fixture
def code() -> str:
    [section] = re.findall(r"### Your own\n(.*?)\n## ", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    [code] = re.findall(r"```python\n(.*?)```", section, re.DOTALL)
    return code


@pytest.fixture
def optimizers(code, tmp_path, monkeypatch):
    (tmp_path / "my_optimizer.py").write_text(code)
    monkeypatch.syspath_prepend(tmp_path)
    registry = build_registry([EntryPoint("mine", "my_optimizer", "dashpot")])
    assert not registry.faults
    return {**load_registry().optimizers, **registry.optimizers}


def losses(points):
    return np.sqrt(np.mean((points - TRUTH) ** 2, axis=1))


def test_the_class_has_fewer_than_15_lines(code):
    [body] = re.findall(r"(class .*?)\n\n\n", code, re.DOTALL)
    assert len([line for line in body.splitlines() if line.strip()]) < 15


def test_it_finds_the_bottom_of_a_bowl_and_says_why_it_ends(optimizers):
    space = Space(("a", "b", "c"), np.array([0.9, 0.1, 0.9]))
    found = run_search(make_optimizer("shrinking", optimizers), losses, lambda points: points - TRUTH, space, 1)
    assert found.ending is Ending.CONVERGED and found.remark == "the width is spent"
    assert found.loss < 1e-3
    chain = make_optimizer("shrinking+least_squares", optimizers)
    polished = run_search(chain, losses, lambda points: points - TRUTH, space, 1)
    assert polished.loss < 1e-9
