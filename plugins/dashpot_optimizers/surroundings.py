"""A point and its neighbours for a finite-difference Jacobian, evaluated as one block."""

from __future__ import annotations

import numpy as np

from dashpot.contract.bridged import Evaluate
from dashpot.contract.optimizer import losses_of
from dashpot_optimizers.tall_matrix import triangle_of


class StartFailed(Exception):
    """The first point could not be evaluated."""


class Surroundings:
    """Residuals and Jacobian around the point looked at last, in units of the first loss and as a triangle.

    The Jacobian is asked together with the residuals: most trial steps are accepted, and a block of one lane takes
    the time of a block of sixteen. A neighbour that failed leaves its column empty: no step goes that way.
    """

    def __init__(self, evaluate: Evaluate, step: float):
        self.scale = 0.0
        self._evaluate = evaluate
        self._step = step
        self._point = self._triangle = np.empty(0)

    def residuals(self, point: np.ndarray) -> np.ndarray:
        """First column of the triangle; all inf where the point failed. Raises StartFailed when the first one did."""
        block, steps = neighbours(point, self._step)
        values = self._evaluate(block)
        alive = np.isfinite(values[:, 0])
        if not alive[0]:
            return self._failure()
        if not alive.all():
            values = np.where(alive[:, None], values, values[0])
        self.scale = self.scale or float(losses_of(values[:1])[0]) or 1.0
        self._triangle = triangle_of(values, steps) / (self.scale * np.sqrt(values.shape[1]))
        self._point = point.copy()
        return self._triangle[:, 0]

    def jacobian(self, point: np.ndarray) -> np.ndarray:
        """The other columns of the triangle."""
        if not np.array_equal(point, self._point):
            self.residuals(point)
        return self._triangle[:, 1:]

    def _failure(self) -> np.ndarray:
        if not self._triangle.size:
            raise StartFailed
        return np.full(len(self._triangle), np.inf)


def neighbours(point: np.ndarray, step: float) -> tuple[np.ndarray, np.ndarray]:
    """The point and one neighbour in each coordinate, (1 + n, n), and the signed steps (n,) taken, inside the cube."""
    steps = np.where(point + step <= 1.0, step, -step)
    block = np.vstack([point, point + np.diag(steps)])
    return block, block[1:].diagonal() - point
