"""One optimizer polishes what another found."""

from __future__ import annotations

import numpy as np
import pytest

from dashpot.contract.chain import make_optimizer, read_optimizer_options
from dashpot.contract.optimizer import Search, Space
from dashpot.contract.registry import load_registry
from dashpot.fit.search import run_search

KNOWN = load_registry().optimizers
TRUTH = np.array([0.31, 0.62, 0.47])
SPACE = Space(("a", "b", "c"), np.array([0.5, 0.2, 0.9]))


class Far(Search):
    """Looks at the corners for ever."""

    word = "far"

    def search(self, space, rng):
        while True:
            yield rng.integers(2, size=(10, space.size)).astype(float)


class Near(Search):
    """Stays at its start."""

    word = "near"

    def __init__(self, times: int = 1):
        self.times = times

    def search(self, space, rng):
        for _ in range(self.times):
            yield space.start[None]
        return "seen often enough"


def residuals(points):
    return (points - TRUTH) * np.array([1.0, 3.0, 0.3])


def losses(points):
    return np.sqrt(np.mean(residuals(points) ** 2, axis=1))


def test_the_second_begins_at_the_best_point_of_the_first():
    asked = []

    def watched(points):
        asked.append(points.copy())
        return losses(points)

    chain = make_optimizer("far+near", {"far": Far, "near": Near})
    found = run_search(chain, watched, residuals, SPACE, seed=0, budget=41)
    # three quarters of 41 evaluations hold three blocks of ten
    assert [len(block) for block in asked] == [10, 10, 10, 1]
    seen = np.concatenate(asked[:3])
    assert np.array_equal(asked[3][0], seen[losses(seen).argmin()])
    assert found.remark == "far: its share of the budget is spent; near: seen often enough"


def test_a_swarm_is_polished_to_the_bottom():
    options = {"pso.particles": 10, "pso.iterations": 5}
    found = run_search(make_optimizer("pso+least_squares", KNOWN, options), losses, residuals, SPACE, 1, budget=2000)
    alone = run_search(make_optimizer("pso", KNOWN, {"particles": 10, "iterations": 5}), losses, residuals, SPACE, 1)
    assert alone.loss > 1e-3 and found.loss < 1e-9
    assert found.evaluations < alone.evaluations + 200


def test_options_of_a_chain_name_their_optimizer():
    assert read_optimizer_options("far+near", {"far": Far, "near": Near}, {"near.times": "3"}) == {"near.times": 3}
    assert make_optimizer("far+near", {"far": Far, "near": Near}, {"near.times": 3}).members[1].times == 3


@pytest.mark.parametrize(
    "text, texts, said",
    [
        ("far+nere", {}, "No such optimizer 'nere', did you mean 'near'"),
        ("far+near", {"times": "3"}, "option 'times': expected 'far.option' or another word of 'far\\+near'"),
        ("far+near", {"near.tims": "3"}, "no option 'tims', did you mean 'times'"),
    ],
)
def test_what_does_not_fit_is_said(text, texts, said):
    with pytest.raises(ValueError, match=said):
        read_optimizer_options(text, {"far": Far, "near": Near}, texts)


def test_several_starts_may_each_be_a_chain():
    found = run_search(
        make_optimizer("multistart", KNOWN, {"of": "pso+least_squares", "starts": 2}),
        losses,
        residuals,
        SPACE,
        1,
        budget=60_000,
    )
    assert found.loss < 1e-9
