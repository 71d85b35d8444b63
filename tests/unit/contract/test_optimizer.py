"""Facts of the optimizer protocol: the space, searches written as generators, what a block is worth."""

from __future__ import annotations

import inspect

import numpy as np
import pytest

from dashpot.contract.optimizer import Search, Space, losses_of
from dashpot.fit.search import run_search

SPACE = Space(("a", "b"), np.array([0.9, 0.1]))


class Halving(Search):
    """Looks around the best point so far, ever closer."""

    word = "halving"
    needs = "losses"

    def search(self, space, rng):
        best, width = space.start, 0.5
        for _ in range(30):
            points = np.clip(best + width * rng.uniform(-1, 1, (32, space.size)), 0, 1)
            losses = yield points
            best, width = points[losses.argmin()], 0.7 * width


def test_a_users_own_optimizer_takes_less_than_15_lines() -> None:
    def worth(points):
        return np.hypot(points[:, 0] - 0.3, points[:, 1] - 0.6)

    result = run_search(Halving(), worth, worth, SPACE, seed=1)
    assert len(inspect.getsource(Halving).splitlines()) < 15
    assert result.loss < 1e-3


class Two(Search):
    """Asks twice and tells what it was told."""

    word = "two"

    def search(self, space, rng):
        first = yield space.start[None, :]
        second = yield space.start[None, :] / 2
        return f"{first[0]:g} and {second[0]:g}"


def test_a_block_is_asked_again_until_it_is_told() -> None:
    optimizer = Two()
    optimizer.begin(SPACE, 1)
    assert optimizer.ask() is optimizer.ask()
    optimizer.tell(optimizer.ask(), np.array([1.0]))
    assert np.array_equal(optimizer.ask(), [[0.45, 0.05]])


def test_what_the_generator_returns_is_the_conclusion() -> None:
    optimizer = Two()
    optimizer.begin(SPACE, 1)
    for loss in (1.0, 2.0):
        optimizer.tell(optimizer.ask(), np.array([loss]))
    assert optimizer.ask() is None
    assert optimizer.conclusion == "1 and 2"


def test_a_new_search_forgets_the_old_one() -> None:
    optimizer = Two()
    for losses in ((1.0, 2.0), (3.0, 4.0)):
        optimizer.begin(SPACE, 1)
        assert optimizer.conclusion == ""
        for loss in losses:
            optimizer.tell(optimizer.ask(), np.array([loss]))
    assert optimizer.conclusion == "3 and 4"


def test_closing_ends_the_generator() -> None:
    ended = []

    class Held(Search):
        word = "held"

        def search(self, space, rng):
            try:
                yield space.start[None, :]
            finally:
                ended.append(True)

    optimizer = Held()
    optimizer.begin(SPACE, 1)
    optimizer.close()
    assert ended == [True]
    assert optimizer.ask() is None


def test_telling_before_beginning_is_an_error() -> None:
    with pytest.raises(RuntimeError, match=r"Two: expected begin\(\) before tell\(\)"):
        Two().tell(np.zeros((1, 2)), np.zeros(1))


def test_a_search_that_yields_nothing_is_an_error() -> None:
    class Plain(Search):
        word = "plain"

        def search(self, space, rng):
            return 0.5

    with pytest.raises(TypeError, match=r"Plain.search: expected a generator, values = yield points, got 0.5"):
        Plain().begin(SPACE, 1)


def test_losses_of_residuals_are_their_root_mean_square() -> None:
    assert np.allclose(losses_of(np.array([[3.0, -4.0], [0.0, 2.0]])), [np.sqrt(12.5), np.sqrt(2.0)])


def test_whatever_is_not_finite_is_worth_infinity() -> None:
    assert losses_of(np.array([1.0, np.nan, np.inf, -np.inf])).tolist() == [1.0, np.inf, np.inf, np.inf]
    assert losses_of(np.array([[1.0, np.nan], [-np.inf, 1.0], [1.0, 1.0]])).tolist() == [np.inf, np.inf, 1.0]


def test_a_space_cannot_be_changed() -> None:
    start = np.array([0.5, 0.5])
    space = Space(("a", "b"), start)
    start[0] = 0.7
    assert space.start.tolist() == [0.5, 0.5]
    with pytest.raises(ValueError, match="read-only"):
        space.start[0] = 0.7


@pytest.mark.parametrize("start", [[0.5], [0.5, 0.5, 0.5], [[0.5, 0.5]]])
def test_a_space_needs_a_start_for_every_name(start: list) -> None:
    with pytest.raises(ValueError, match="expected a start value for each of 2"):
        Space(("a", "b"), np.array(start))


def test_a_space_without_parameters_is_an_error() -> None:
    with pytest.raises(ValueError, match="expected a start value for each of 0"):
        Space((), np.array([]))


@pytest.mark.parametrize("value", [-0.1, 1.1, np.nan])
def test_a_start_lies_in_the_unit_cube(value: float) -> None:
    with pytest.raises(ValueError, match="expected start values between 0 and 1"):
        Space(("a", "b"), np.array([0.5, value]))
