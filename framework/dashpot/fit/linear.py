"""A residual and its Jacobian in products: what every user of a Jacobian needs, whatever the length of the data.

A Jacobian has as many rows as there are samples. Steps, intervals and directions need its products alone, which are
summed run by run; what needs the rows themselves goes through them run by run once more.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.coordinates import Coordinates

Array = NDArray[np.float64]
Result = TypeVar("Result")

STEP = 1e-5  # of a natural step


class Loss(Protocol):
    """What is refined: the root mean square of a residual, and how the residual changes with the parameters."""

    def losses(self, values: Array) -> Array:
        """The loss of every lane (lanes,) of slots (lanes, slots) in SI; a lane that fails costs infinity."""

    def linearise(self, values: Array, moves: Array, reduce: Callable[[int, Array], Result]) -> Iterator[Result]:
        """What ``reduce`` makes of one run after the other, from its number and its rows (1 + k, values).

        The rows are the residual at ``values`` (slots,) and its changes with each of the ``moves`` (k, slots); those of
        the next run may overwrite them.
        """


class Held:
    """A loss that holds its last rows in memory: asked for the same changes once more, it simulates nothing."""

    def __init__(self, loss: Loss) -> None:
        self._loss, self._asked = loss, np.zeros((0, 0))
        self._rows: list[tuple[int, Array]] = []

    def losses(self, values: Array) -> Array:
        """The loss of every lane (lanes,)."""
        return self._loss.losses(values)

    def linearise(self, values: Array, moves: Array, reduce: Callable[[int, Array], Result]) -> Iterator[Result]:
        """As that of the loss; the rows are the caller's to keep."""
        asked = np.concatenate([values[None], moves])
        if not np.array_equal(asked, self._asked):
            self._rows = list(self._loss.linearise(values, moves, lambda number, rows: (number, rows.copy())))
            self._asked = asked
        for number, rows in self._rows:
            yield reduce(number, rows.copy())


@dataclass(frozen=True, eq=False)
class Linear:
    """An objective around ``values`` (slots,): products of its residual r and of the changes J of r, over all runs.

    Of the p coordinates J has the changes with natural steps, which are ``factors`` times those with the small
    ``moves`` (p + m, slots); behind them stand the changes with m other steps, as they are. ``gram`` (1 + p + m, same)
    holds the products of r and all changes. What could not be moved either way is ``unsolved`` (p + m,) and has the
    change zero.
    """

    objective: Loss
    size: int
    values: Array
    moves: Array
    factors: Array
    gram: Array
    unsolved: NDArray[np.bool_]

    @property
    def normal(self) -> Array:
        """J J' (p, p) of the coordinates."""
        return self.gram[1 : 1 + self.size, 1 : 1 + self.size]

    @property
    def gradient(self) -> Array:
        """J r (p,) of the coordinates."""
        return self.gram[1 : 1 + self.size, 0]

    @property
    def square(self) -> float:
        """The sum of the squares of r."""
        return float(self.gram[0, 0])

    @property
    def beside(self) -> Array:
        """The products (m, p) of the changes with the other steps and those of the coordinates."""
        return self.gram[1 + self.size :, 1 : 1 + self.size]

    def each(self, reduce: Callable[[int, Array], Result]) -> Iterator[Result]:
        """What ``reduce`` makes of one run after the other, from its number and its rows r and J (1 + p, values)."""

        def scaled(number: int, rows: Array) -> Result:
            rows[1:] *= self.factors[: self.size, None]
            rows[1:][self.unsolved[: self.size]] = 0.0
            return reduce(number, rows)

        return self.objective.linearise(self.values, self.moves[: self.size], scaled)


def linearise(objective: Loss, coordinates: Coordinates, point: Array, steps: Sequence[Array] = ()) -> Linear:
    """The products of the residual and its changes around a point (p,), with those of ``steps`` (slots,) in SI beside.

    What cannot be moved one way is moved the other way.
    """
    shifts = STEP * coordinates.unit
    shifts = np.where(point + shifts > coordinates.high, -shifts, shifts)
    room = (point - shifts >= coordinates.low) & (point - shifts <= coordinates.high)
    others = np.reshape(steps, (len(steps), coordinates.base.size))
    found = _around(objective, coordinates, point, shifts, others, np.ones(len(others)))
    again = found.unsolved & np.append(room, np.ones(len(others), dtype=bool))
    if again.any():
        signs = np.where(again, -1.0, 1.0)
        found = _around(objective, coordinates, point, shifts * signs[: point.size], others, signs[point.size :])
    return found


def _around(
    objective: Loss, coordinates: Coordinates, point: Array, shifts: Array, steps: Array, signs: Array
) -> Linear:
    values = coordinates.to_values(np.concatenate([point[None], point + np.diag(shifts)]))
    moves = np.concatenate([values[1:] - values[0], signs[:, None] * steps])
    scale = np.concatenate([[1.0], coordinates.unit / shifts, signs])
    gram = sum(objective.linearise(values[0], moves, lambda _, rows: rows @ rows.T), np.zeros((scale.size, scale.size)))
    unsolved = ~np.isfinite(np.diag(gram)[1:])
    lost = np.append(False, unsolved)
    gram[lost], gram[:, lost] = 0.0, 0.0
    return Linear(objective, point.size, values[0], moves, scale[1:], gram * np.outer(scale, scale), unsolved)
