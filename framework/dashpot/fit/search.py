"""The driver of every optimizer: evaluates what is asked, keeps the best point, says why the search ended."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import Enum
from typing import TypeAlias

import numpy as np

from dashpot.contract.optimizer import Optimizer, Space
from dashpot.fit.algebra import single_threaded_algebra
from dashpot.fit.replay import Answers, Block, Evaluate


class Ending(Enum):
    """Why a search ended."""

    CONVERGED = "the optimizer has nothing more to ask"
    BUDGET = "the budget is spent"
    TARGET = "the target is reached"
    INTERRUPTED = "interrupted; the best point so far is kept"


@dataclass(frozen=True)
class Standing:
    """How far a search is after a block: parameter vectors evaluated, how many of them failed, best loss."""

    evaluations: int
    failures: int
    loss: float


Progress: TypeAlias = Callable[[Standing], None]


@dataclass(frozen=True, eq=False)
class SearchResult:
    """The best point (n,) of a search. When every lane failed it is the start, and the loss is inf.

    remark: the optimizer's own words on why it had nothing more to ask.
    """

    best: np.ndarray
    loss: float
    evaluations: int
    failures: int
    history: tuple[Standing, ...]
    ending: Ending
    remark: str


class OptimizerError(Exception):
    """An optimizer broke its promise."""


@dataclass(frozen=True)
class Limits:
    """Where a search ends at the latest: after `budget` parameter vectors, at a loss of `target` or less."""

    budget: int | None = None
    target: float | None = None

    def __post_init__(self) -> None:
        if self.budget is not None and self.budget < 1:
            raise ValueError(f"budget: expected at least 1 parameter vector, got {self.budget}")

    def affords(self, evaluations: int, lanes: int) -> int:
        """How many of the next lanes may be evaluated."""
        return lanes if self.budget is None else min(lanes, self.budget - evaluations)

    def reached(self, loss: float) -> bool:
        """True when the loss is small enough."""
        return self.target is not None and loss <= self.target


@single_threaded_algebra
def run_search(
    optimizer: Optimizer,
    evaluate_losses: Evaluate,
    evaluate_residuals: Evaluate,
    space: Space,
    seed: int,
    budget: int | None = None,
    target: float | None = None,
    progress: Progress | None = None,
    recorded: Iterable[Block] = (),
    keep: Callable[[Block], None] | None = None,
) -> SearchResult:
    """Run `optimizer` to its end, its budget or its target.

    evaluate_losses: points (lanes, n) -> (lanes,), the root mean square of what evaluate_residuals gives,
    (lanes, samples); a lane that is not finite has failed and cannot win. budget: parameter vectors to evaluate, kept
    exactly: a block that is too large is cut, and its values are not told. recorded: blocks of an interrupted search,
    replayed first (ReplayError when the points differ in a bit); keep: is given each new block that was evaluated
    whole. KeyboardInterrupt ends the search with what was found. Raises OptimizerError for points that are not inside
    the unit cube.
    """
    ledger = _Ledger(space, progress)
    answers = Answers(evaluate_losses, evaluate_residuals, recorded, keep)
    optimizer.allowance = budget
    try:
        optimizer.begin(space, seed)
        ending = _advance(optimizer, answers, ledger, Limits(budget, target))
        remark = optimizer.conclusion
    except KeyboardInterrupt:
        ending, remark = Ending.INTERRUPTED, ""
    finally:
        optimizer.close()
    return ledger.close(ending, remark)


def _advance(optimizer: Optimizer, answers: Answers, ledger: _Ledger, limits: Limits) -> Ending:
    while (asked := optimizer.ask()) is not None:
        points = _checked(asked, ledger.space, optimizer)
        lanes = limits.affords(ledger.evaluations, len(points))
        if lanes == 0:
            return Ending.BUDGET
        evaluate = answers.full if lanes == len(points) else answers.part
        values, losses = evaluate(points[:lanes], optimizer.needs)
        ledger.enter(points[:lanes], losses)
        if limits.reached(ledger.loss):
            return Ending.TARGET
        if lanes < len(points):
            return Ending.BUDGET
        optimizer.tell(points, values)
    return Ending.CONVERGED


def _checked(asked: np.ndarray, space: Space, optimizer: Optimizer) -> np.ndarray:
    points = np.array(asked, dtype=float, order="C")
    who = f"optimizer {getattr(optimizer, 'word', type(optimizer).__name__)}"
    if points.ndim != 2 or len(points) == 0 or points.shape[1] != space.size:
        raise OptimizerError(f"{who}: expected points of shape (lanes, {space.size}), got {points.shape}")
    outside = ~((points >= 0.0) & (points <= 1.0))
    if outside.any():
        lane, column = np.argwhere(outside)[0]
        raise OptimizerError(
            f"{who}: expected points inside the unit cube, got {points[lane, column]!r} for {space.names[column]} "
            f"in lane {lane}. Clip or reflect the points before they are asked"
        )
    return points


class _Ledger:
    """What was evaluated, and the best of it."""

    def __init__(self, space: Space, progress: Progress | None):
        self.space = space
        self.evaluations = self.failures = 0
        self.best, self.loss = space.start, np.inf
        self._progress = progress
        self._history: list[Standing] = []

    def enter(self, points: np.ndarray, losses: np.ndarray) -> None:
        winner = int(np.argmin(losses))
        if losses[winner] < self.loss:
            self.best, self.loss = points[winner].copy(), float(losses[winner])
        self.evaluations += len(points)
        self.failures += int(np.count_nonzero(np.isinf(losses)))
        self._history.append(Standing(self.evaluations, self.failures, self.loss))
        if self._progress is not None:
            self._progress(self._history[-1])

    def close(self, ending: Ending, remark: str) -> SearchResult:
        history = tuple(self._history)
        return SearchResult(self.best, float(self.loss), self.evaluations, self.failures, history, ending, remark)
