"""What every registered optimizer keeps to, whatever its method."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of

from dashpot.contract.optimizer import Optimizer, Space, losses_of
from dashpot.contract.registry import load_registry
from dashpot.fit.search import Ending, SearchResult, run_search

# the adapters of other libraries promise less, see test_adapters
WORDS = sorted(word for word, made in load_registry().optimizers.items() if not made.library)
TRUTH = np.array([0.3, 0.6, 0.45])
SPACE = Space(("a", "b", "c"), np.array([0.5, 0.2, 0.9]))


def bowl(points: np.ndarray) -> np.ndarray:
    """Residuals of a slightly bent bowl around TRUTH, which is their only zero."""
    away = points - TRUTH[: points.shape[1]]
    return away * (1.0 + 0.5 * away) @ (np.eye(points.shape[1]) + 0.3)


def make(word: str) -> Optimizer:
    """With enough starts for chance to matter in each method."""
    return load_registry().optimizers[word](**({"starts": 4} if word == "least_squares" else {}))


class Bench:
    """Runs an optimizer on the bowl and remembers every block; lanes can be made to fail."""

    def __init__(self, failed=lambda points: np.zeros(len(points), bool), residuals=bowl):
        self.blocks: list[np.ndarray] = []
        self.failed, self.residuals = failed, residuals

    def worth(self, points: np.ndarray) -> np.ndarray:
        self.blocks.append(points.copy())
        values = self.residuals(points)
        values[self.failed(points)] = np.nan
        return values

    def run(self, optimizer: Optimizer, space: Space = SPACE, seed: int = 1, budget: int = 3000) -> SearchResult:
        return run_search(optimizer, lambda p: losses_of(self.worth(p)), self.worth, space, seed, budget=budget)


@pytest.mark.parametrize("word", WORDS)
def test_finds_the_bottom_of_a_bowl(word: str) -> None:
    result = Bench().run(make(word))
    assert np.allclose(result.best, TRUTH, atol=2e-3)


@pytest.mark.parametrize("word", WORDS)
def test_same_seed_gives_the_same_bits_even_when_used_again(word: str) -> None:
    seed = seed_of(f"test_promises {word}")
    first, again, used = Bench(), Bench(), Bench()
    optimizer = make(word)
    first.run(optimizer, seed=seed)
    again.run(make(word), seed=seed)
    used.run(optimizer, seed=seed)
    assert [block.tobytes() for block in first.blocks] == [block.tobytes() for block in again.blocks]
    assert [block.tobytes() for block in first.blocks] == [block.tobytes() for block in used.blocks]


@pytest.mark.parametrize("word", WORDS)
def test_another_seed_gives_other_points(word: str) -> None:
    one, other = Bench(), Bench()
    one.run(make(word), seed=1, budget=300)
    other.run(make(word), seed=2, budget=300)
    assert np.concatenate(one.blocks).tobytes() != np.concatenate(other.blocks).tobytes()


@pytest.mark.parametrize("word", WORDS)
def test_the_start_is_among_the_first_points(word: str) -> None:
    bench = Bench()
    bench.run(make(word), budget=300)
    assert (bench.blocks[0] == SPACE.start).all(axis=1).any()


@pytest.mark.parametrize("word", WORDS)
@pytest.mark.parametrize("corner", [0.0, 1.0])
def test_finds_the_best_point_on_the_wall_and_never_looks_outside(word: str, corner: float) -> None:
    bench = Bench(residuals=lambda points: points - np.array([corner - 0.5 + 2.0 * (corner - 0.5), 0.5, corner]))
    result = bench.run(make(word), Space(("a", "b", "c"), np.array([corner, 0.5, corner])))
    points = np.concatenate(bench.blocks)
    assert points.min() >= 0.0 and points.max() <= 1.0
    assert np.allclose(result.best, [corner, 0.5, corner], atol=2e-3)


@pytest.mark.parametrize("word", WORDS)
def test_failed_lanes_do_no_harm(word: str) -> None:
    bench = Bench(failed=lambda points: (points[:, 0] > 0.7) | (points[:, 1] > 0.9))
    result = bench.run(make(word))
    assert np.allclose(result.best, TRUTH, atol=2e-3)


@pytest.mark.parametrize("word", WORDS)
def test_a_failed_start_is_left_behind(word: str) -> None:
    bench = Bench(failed=lambda points: points[:, 2] > 0.8)
    result = bench.run(make(word))
    assert bench.failed(SPACE.start[None, :])[0]
    assert np.allclose(result.best, TRUTH, atol=2e-3)


@pytest.mark.parametrize("word", WORDS)
@pytest.mark.filterwarnings("error")
def test_ends_without_a_winner_when_every_lane_fails(word: str) -> None:
    result = Bench(failed=lambda points: np.ones(len(points), bool)).run(make(word))
    assert np.isinf(result.loss)
    assert np.array_equal(result.best, SPACE.start)
    assert result.failures == result.evaluations


@pytest.mark.parametrize("word", WORDS)
def test_one_parameter_is_enough(word: str) -> None:
    result = Bench().run(make(word), Space(("a",), np.array([0.9])))
    assert np.allclose(result.best, TRUTH[:1], atol=2e-3)


@pytest.mark.parametrize("word", WORDS)
def test_a_parameter_without_influence_does_no_harm(word: str) -> None:
    bench = Bench(residuals=lambda points: bowl(points[:, :2]))
    assert np.allclose(bench.run(make(word)).best[:2], TRUTH[:2], atol=2e-3)


@pytest.mark.parametrize("word", WORDS)
def test_says_in_words_why_it_ends(word: str) -> None:
    result = Bench().run(make(word), budget=100_000)
    assert result.ending is Ending.CONVERGED
    assert len(result.remark.split()) >= 3
