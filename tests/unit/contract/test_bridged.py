"""Facts of the bridge to libraries that take a function."""

from __future__ import annotations

import threading

import numpy as np
import pytest

from dashpot.contract.bridged import Bridged
from dashpot.contract.optimizer import Space
from dashpot.fit.search import Ending, run_search

SPACE = Space(("a", "b"), np.array([0.5, 0.5]))


class Library(Bridged):
    """Hands its function to any callable that calls it."""

    word = "library"
    needs = "losses"

    def __init__(self, call):
        self.call = call

    def minimize(self, evaluate, space, seed):
        return self.call(evaluate)


def threads() -> list[threading.Thread]:
    return [thread for thread in threading.enumerate() if thread.name == "optimizer"]


def worth(points: np.ndarray) -> np.ndarray:
    return points.sum(axis=1)


def forever(evaluate) -> None:
    while True:
        evaluate(np.full((4, 2), 0.5))


def stubborn(evaluate) -> None:
    while True:
        try:
            evaluate(np.full((4, 2), 0.5))
        except Exception:
            continue


def test_the_library_sees_what_its_points_are_worth_and_its_conclusion_is_kept() -> None:
    seen = []

    def call(evaluate):
        seen.append(evaluate(np.array([[0.1, 0.2], [0.3, 0.4]])))
        seen.append(evaluate([[0.5, 0.5]]))
        return "done twice"

    result = run_search(Library(call), worth, worth, SPACE, 1)
    assert [values.tolist() for values in seen] == [[pytest.approx(0.3), pytest.approx(0.7)], [1.0]]
    assert (result.ending, result.remark, result.evaluations) == (Ending.CONVERGED, "done twice", 3)
    assert threads() == []


def test_an_exception_in_the_library_comes_out_of_ask() -> None:
    def call(evaluate):
        evaluate(np.full((1, 2), 0.5))
        raise ArithmeticError("singular")

    with pytest.raises(ArithmeticError, match="singular"):
        run_search(Library(call), worth, worth, SPACE, 1)
    assert threads() == []


def afterthought(evaluate) -> None:
    try:
        forever(evaluate)
    finally:
        evaluate(np.full((4, 2), 0.5))


@pytest.mark.parametrize("call", [forever, stubborn, afterthought])
def test_the_thread_ends_when_the_budget_does(call) -> None:
    result = run_search(Library(call), worth, worth, SPACE, 1, budget=10)
    assert (result.ending, result.evaluations) == (Ending.BUDGET, 10)
    assert threads() == []


def test_the_thread_ends_when_the_evaluation_fails() -> None:
    def broken(points: np.ndarray) -> np.ndarray:
        raise OSError("disk")

    with pytest.raises(OSError, match="disk"):
        run_search(Library(forever), broken, broken, SPACE, 1)
    assert threads() == []


def test_points_are_copied_so_that_the_library_may_reuse_its_array() -> None:
    optimizer = Library(forever)
    block = np.full((1, 2), 0.5)

    def call(evaluate):
        evaluate(block)
        block[:] = 0.25
        evaluate(block)

    optimizer.call = call
    optimizer.begin(SPACE, 1)
    first = optimizer.ask()
    optimizer.tell(first, np.zeros(1))
    assert (first[0, 0], optimizer.ask()[0, 0]) == (0.5, 0.25)
    optimizer.close()


def test_beginning_again_ends_the_first_thread() -> None:
    optimizer = Library(forever)
    optimizer.begin(SPACE, 1)
    optimizer.begin(SPACE, 1)
    assert len(threads()) == 1
    optimizer.close()
    assert threads() == []


def test_telling_before_beginning_is_an_error() -> None:
    with pytest.raises(RuntimeError, match=r"Library: expected begin\(\) before tell\(\)"):
        Library(forever).tell(np.zeros((1, 2)), np.zeros(1))
