"""The adapters of other libraries: the same promises as any optimizer, but the accuracy is the library's."""

from __future__ import annotations

import numpy as np
import pytest

from dashpot.contract.chain import make_optimizer
from dashpot.contract.optimizer import Space
from dashpot.contract.registry import load_registry
from dashpot.fit.search import Ending, run_search

KNOWN = load_registry().optimizers
ADAPTERS = [
    pytest.param(word, marks=pytest.mark.skipif(bool(made.missing()), reason=f"{made.missing()} is not installed"))
    for word, made in KNOWN.items()
    if made.library
]
TRUTH = np.array([0.3, 0.6])
SPACE = Space(("a", "b"), np.array([0.8, 0.2]))
OPTIONS = {"evaluations": 240, "block": 8}


def run(word, seed=1, failed=lambda points: np.zeros(len(points), bool)):
    blocks = []

    def losses(points):
        blocks.append(points.copy())
        return np.where(failed(points), np.nan, np.sqrt(np.mean((points - TRUTH) ** 2, axis=1)))

    method = make_optimizer(word, KNOWN, OPTIONS)
    return run_search(method, losses, lambda points: points - TRUTH, SPACE, seed, budget=10_000), blocks


@pytest.mark.parametrize("word", ADAPTERS)
def test_comes_near_the_bottom_of_a_bowl_and_says_why_it_ends(word):
    result, blocks = run(word)
    assert result.ending is Ending.CONVERGED and len(result.remark.split()) >= 3
    assert np.allclose(result.best, TRUTH, atol=0.05)
    assert (np.concatenate(blocks)[:8] == SPACE.start).all(axis=1).any()


@pytest.mark.parametrize("word", ADAPTERS)
def test_the_same_seed_gives_the_same_points_and_another_other_ones(word):
    asked = [np.concatenate(run(word, seed)[1]).tobytes() for seed in (1, 1, 2)]
    assert asked[0] == asked[1] != asked[2]


@pytest.mark.parametrize("word", ADAPTERS)
def test_failed_lanes_do_no_harm(word):
    result, _ = run(word, failed=lambda points: points[:, 0] > 0.7)
    assert np.allclose(result.best, TRUTH, atol=0.08)


@pytest.mark.parametrize("word", [word for word, made in KNOWN.items() if made.library])
def test_a_library_that_is_not_installed_is_named_with_its_extra(word, monkeypatch):
    monkeypatch.setattr("dashpot.contract.optimizer.find_spec", lambda name: None)
    with pytest.raises(ValueError, match=rf"pip install 'dashpot\[{word}\]'"):
        make_optimizer(word, KNOWN)
