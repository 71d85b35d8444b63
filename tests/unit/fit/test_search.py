"""Facts of the driver of the optimizers."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dashpot.contract.optimizer import Search, Space
from dashpot.fit.replay import Block, ReplayError
from dashpot.fit.search import Ending, OptimizerError, SearchResult, Standing, run_search

SPACE = Space(("stiffness", "limit"), np.array([0.5, 0.5]))
LOSS = st.one_of(st.floats(0.0, 1e6), st.sampled_from([np.nan, np.inf, -np.inf]))


class Listed(Search):
    """Asks the given blocks one after the other."""

    word = "listed"

    def __init__(self, *blocks, needs: str = "losses"):
        self.blocks, self.needs, self.told = blocks, needs, []

    def search(self, space, rng):
        for block in self.blocks:
            self.told.append((yield block))
        return "all asked"


class Drifting(Search):
    """Draws points around the best one so far, so that every block depends on all values before it."""

    word = "drifting"

    def __init__(self, needs: str = "losses", blocks: int = 6):
        self.needs, self.blocks = needs, blocks

    def search(self, space, rng):
        best = space.start
        for _ in range(self.blocks):
            points = np.clip(best + 0.1 * rng.normal(size=(5, space.size)), 0.0, 1.0)
            values = yield points
            best = points[np.argmin(values if self.needs == "losses" else np.square(values).sum(axis=1))]


def lanes(*counts: int) -> list[np.ndarray]:
    """Blocks of so many different points."""
    numbers = iter(range(1, 1 + sum(counts)))
    return [np.array([[next(numbers) / 1000.0, 0.5] for _ in range(count)]) for count in counts]


def residuals(points: np.ndarray) -> np.ndarray:
    return np.stack([points[:, 0] - 0.2, points[:, 1] - 0.7, np.full(len(points), 0.1)], axis=1)


def losses(points: np.ndarray) -> np.ndarray:
    return np.sqrt(np.mean(residuals(points) ** 2, axis=1))


def search(optimizer: Search, worth=losses, seed: int = 1, **options) -> SearchResult:
    return run_search(optimizer, worth, residuals, SPACE, seed, **options)


@given(st.lists(st.lists(LOSS, min_size=1, max_size=5), min_size=1, max_size=6))
def test_the_best_is_the_smallest_finite_loss_of_all(table: list[list[float]]) -> None:
    blocks, values = lanes(*map(len, table)), iter(table)
    result = search(Listed(*blocks), lambda points: np.array(next(values)))
    flat, points = np.concatenate(table), np.concatenate(blocks)
    finite = np.isfinite(flat)
    assert result.evaluations == len(flat)
    assert result.failures == np.count_nonzero(~finite)
    assert result.loss == min(flat[finite], default=np.inf)
    assert np.array_equal(result.best, points[finite][np.argmin(flat[finite])] if finite.any() else SPACE.start)


def test_residuals_are_scored_by_their_root_mean_square() -> None:
    result = search(Listed(np.array([[0.0, 0.7], [0.2, 0.6]]), needs="residuals"))
    assert result.best.tolist() == [0.2, 0.6]
    assert result.loss == pytest.approx(np.sqrt(0.02 / 3.0))


def test_what_is_needed_is_read_with_every_block() -> None:
    class Both(Search):
        word = "both"

        def search(self, space, rng):
            self.needs = "losses"
            first = yield np.full((2, 2), 0.3)
            self.needs = "residuals"
            second = yield np.full((2, 2), 0.3)
            return f"{first.shape} {second.shape}"

    assert search(Both()).remark == "(2,) (2, 3)"


def test_failed_lanes_are_told_as_infinity_throughout_and_the_evaluated_array_is_left_alone() -> None:
    evaluated = np.array([[1.0, np.nan, 2.0], [1.0, 2.0, 3.0]])
    optimizer = Listed(np.full((2, 2), 0.5), needs="residuals")
    run_search(optimizer, losses, lambda points: evaluated, SPACE, 1)
    assert np.array_equal(optimizer.told[0], [[np.inf] * 3, [1.0, 2.0, 3.0]])
    assert np.isnan(evaluated[0, 1])


def test_the_history_holds_the_best_after_every_block() -> None:
    values = iter([[5.0, 4.0], [np.nan, 6.0, 7.0], [1.0]])
    seen: list[Standing] = []
    result = search(Listed(*lanes(2, 3, 1)), lambda points: np.array(next(values)), progress=seen.append)
    assert result.history == (Standing(2, 0, 4.0), Standing(5, 1, 4.0), Standing(6, 1, 1.0))
    assert tuple(seen) == result.history


def test_an_optimizer_with_nothing_more_to_ask_has_converged() -> None:
    result = search(Listed(*lanes(2)))
    assert (result.ending, result.remark) == (Ending.CONVERGED, "all asked")


@given(st.integers(1, 12))
def test_a_budget_is_spent_exactly(budget: int) -> None:
    evaluated: list[float] = []

    def worth(points: np.ndarray) -> np.ndarray:
        evaluated.extend(points[:, 0])
        return 1.0 - points[:, 0]

    optimizer = Listed(*lanes(4, 3, 5))
    result = search(optimizer, worth, budget=budget)
    assert result.evaluations == len(evaluated) == budget
    assert evaluated == [number / 1000.0 for number in range(1, budget + 1)]
    assert result.best[0] == budget / 1000.0
    assert len(optimizer.told) == sum(budget >= end for end in (4, 7, 12))
    assert result.ending is (Ending.CONVERGED if budget == 12 else Ending.BUDGET)


def test_a_budget_of_nothing_is_refused() -> None:
    with pytest.raises(ValueError, match="budget: expected at least 1 parameter vector, got 0"):
        search(Listed(*lanes(2)), budget=0)


def test_the_search_ends_with_the_block_that_reaches_the_target() -> None:
    values = iter([[5.0, 4.0], [3.0, 2.0], [1.0]])
    result = search(Listed(*lanes(2, 2, 1)), lambda points: np.array(next(values)), target=2.0)
    assert (result.ending, result.evaluations, result.loss) == (Ending.TARGET, 4, 2.0)


@pytest.mark.parametrize("where", ["evaluation", "progress"])
def test_an_interruption_keeps_the_best_point(where: str) -> None:
    def worth(points: np.ndarray) -> np.ndarray:
        if where == "evaluation" and points[0, 0] > 0.002:
            raise KeyboardInterrupt
        return 1.0 - points[:, 0]

    def progress(standing: Standing) -> None:
        if where == "progress":
            raise KeyboardInterrupt

    optimizer = Listed(*lanes(2, 2, 2))
    result = search(optimizer, worth, progress=progress)
    assert (result.ending, result.evaluations, result.best[0]) == (Ending.INTERRUPTED, 2, 0.002)
    assert optimizer.ask() is None


def test_the_optimizer_is_closed_when_the_evaluation_raises() -> None:
    def worth(points: np.ndarray) -> np.ndarray:
        raise OSError("disk")

    optimizer = Listed(*lanes(2))
    with pytest.raises(OSError, match="disk"):
        search(optimizer, worth)
    assert optimizer.ask() is None


@pytest.mark.parametrize("needs", ["losses", "residuals"])
@pytest.mark.parametrize("done", range(7))
@pytest.mark.parametrize("with_values", [True, False])
def test_a_replayed_search_ends_with_the_same_bits(needs: str, done: int, with_values: bool) -> None:
    kept: list[Block] = []
    whole = search(Drifting(needs), keep=kept.append)
    record = [Block(block.points, block.values if with_values else None) for block in kept[:done]]
    fresh: list[Block] = []
    resumed = search(Drifting(needs), recorded=record, keep=fresh.append)
    assert resumed.best.tobytes() == whole.best.tobytes()
    assert (resumed.loss, resumed.history) == (whole.loss, whole.history)
    assert [block.points.tobytes() for block in fresh] == [block.points.tobytes() for block in kept[done:]]


def test_recorded_values_are_not_evaluated_again() -> None:
    kept: list[Block] = []
    search(Drifting(), keep=kept.append)
    evaluated: list[np.ndarray] = []
    search(Drifting(), lambda points: evaluated.append(points) or losses(points), recorded=kept[:4])
    assert [points.tobytes() for points in evaluated] == [block.points.tobytes() for block in kept[4:]]


def test_a_search_that_spent_its_budget_goes_on_with_a_larger_one() -> None:
    kept: list[Block] = []
    search(Drifting(), budget=13, keep=kept.append)
    assert [len(block.points) for block in kept] == [5, 5]
    resumed, whole = search(Drifting(), recorded=kept, budget=23), search(Drifting(), budget=23)
    assert resumed.history == whole.history


def test_a_record_of_another_search_is_refused() -> None:
    kept: list[Block] = []
    search(Drifting(), seed=1, keep=kept.append)
    with pytest.raises(ReplayError, match=r"block 1 of the record: expected the points .* 5 x 2 from .* start again"):
        search(Drifting(), seed=2, recorded=kept)


def test_a_record_that_differs_in_the_last_bit_is_refused() -> None:
    kept: list[Block] = []
    search(Drifting(), keep=kept.append)
    points = kept[1].points.copy()
    points[0, 0] = np.nextafter(points[0, 0], 2.0)
    with pytest.raises(ReplayError, match="block 2 of the record"):
        search(Drifting(), recorded=[kept[0], Block(points, kept[1].values)])


@pytest.mark.parametrize("value", [-1e-12, 1.0 + 1e-12, np.nan])
def test_points_outside_the_unit_cube_are_refused_by_name(value: float) -> None:
    with pytest.raises(OptimizerError, match="optimizer listed: expected points inside .* for limit in lane 1"):
        search(Listed(np.array([[0.5, 0.5], [0.5, value]])))


@pytest.mark.parametrize("shape", [(2,), (0, 2), (3, 1), (1, 1, 2)])
def test_blocks_of_another_shape_are_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(OptimizerError, match=r"optimizer listed: expected points of shape \(lanes, 2\), got "):
        search(Listed(np.full(shape, 0.5)))


@pytest.mark.parametrize(
    ("needs", "values"),
    [
        ("losses", np.zeros(3)),
        ("losses", np.zeros((2, 1))),
        ("residuals", np.zeros(2)),
        ("residuals", np.zeros((2, 0))),
    ],
)
def test_answers_of_another_shape_are_refused(needs: str, values: np.ndarray) -> None:
    optimizer = Listed(np.full((2, 2), 0.5), needs=needs)
    with pytest.raises(ValueError, match=f"expected {needs} for 2 lanes, got an array of shape"):
        run_search(optimizer, lambda points: values, lambda points: values, SPACE, 1)
