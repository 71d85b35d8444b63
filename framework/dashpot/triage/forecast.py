"""What some runs predict for the force of another one, without a model.

Their forces are fitted by a handful of general functions of deflection and velocity.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.data.run import Run

Array = NDArray[np.float64]

SAMPLES = 2000
RIDGE = 1e-8
PLAIN = (0, 1, 4, 7)
_TINY = 1e-300


@dataclass(frozen=True)
class Sizes:
    """The usual reach in m and speed in m/s of the runs that are compared."""

    reach: float
    speed: float

    @classmethod
    def of(cls, runs: Sequence[Run]) -> Sizes:
        """Medians over the runs, which a single wrong unit does not move."""
        reach = float(np.median([np.max(np.abs(run.displacement)) for run in runs])) or 1.0
        speed = float(np.median([np.quantile(np.abs(_rate(run)), 0.95) for run in runs])) or 1.0
        return cls(reach, speed)


@dataclass(frozen=True, eq=False)
class Moments:
    """All that a forecast needs of a run: products of the functions (8, 8), with the force (8,), and of the force."""

    gram: Array
    right: Array
    power: float

    def plain(self) -> Moments:
        """Those of the functions that do not run away beyond what was measured: preload, spring, dashpot, friction."""
        return Moments(self.gram[np.ix_(PLAIN, PLAIN)], self.right[list(PLAIN)], self.power)


def moments_of(x: Array, v: Array, force: Array, sizes: Sizes) -> Moments:
    """The moments of deflection in m, velocity in m/s and force in N (n,), of at most 2000 samples each."""
    stride = max(1, force.size // SAMPLES)
    rows, seen = _functions(x[::stride] / sizes.reach, v[::stride] / sizes.speed), force[::stride]
    return Moments(rows @ rows.T, rows @ seen, max(float(seen @ seen), _TINY))


def moments_of_run(run: Run, sizes: Sizes) -> Moments:
    """The moments of a run as it was measured."""
    return moments_of(run.displacement, _rate(run), run.force, sizes)


def fitted(moments: Sequence[Moments]) -> Array:
    """The coefficients that explain the forces of all runs best, each weighed by its own size."""
    gram = np.sum([each.gram / each.power for each in moments], axis=0)
    right = np.sum([each.right / each.power for each in moments], axis=0)
    scale = np.sqrt(np.maximum(np.diag(gram), _TINY))
    matrix = gram / np.outer(scale, scale) + RIDGE * np.eye(scale.size)
    return np.linalg.solve(matrix, right / scale) / scale


def compared(moments: Moments, coefficients: Array) -> tuple[float, float]:
    """Force over forecast, and the share of the square of the force that this times the forecast explains."""
    product, predicted = float(coefficients @ moments.right), float(coefficients @ moments.gram @ coefficients)
    if not predicted > 0.0:
        return 0.0, 0.0
    return product / predicted, product**2 / (predicted * moments.power)


def _rate(run: Run) -> Array:
    return np.gradient(run.displacement, run.sample_time)


def _functions(x: Array, v: Array) -> Array:
    return np.array([np.ones(x.size), x, x**2, x**3, v, v * np.abs(v), v * x, np.tanh(10.0 * v)])
