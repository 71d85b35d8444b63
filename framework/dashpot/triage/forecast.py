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
# what the numbers of a force may be times those of a displacement: N against m, mm and um, kN against mm
SWAPS = (1.0, 1e-3, 1e-6, 1e-9)
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
        speed = float(np.median([np.quantile(np.abs(rate_of(run)), 0.95) for run in runs])) or 1.0
        return cls(reach, speed)


@dataclass(frozen=True, eq=False)
class Moments:
    """All that a forecast needs of a run: products of the functions (8, 8), with the force (8,), and of the force."""

    gram: Array
    right: Array
    power: float

    def centred(self) -> Moments:
        """Those of the deviations from the means."""
        count, sums, total = self.gram[0, 0], self.gram[0], self.right[0]
        power = max(self.power - float(total**2 / count), _TINY)
        return Moments(self.gram - np.outer(sums, sums) / count, self.right - sums * total / count, power)

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
    return moments_of(run.displacement, rate_of(run), run.force, sizes)


def swapped(run: Run) -> list[tuple[Array, Array, Array]]:
    """Deflection, velocity and force of a run with its channels taken for each other, in each pair of units."""
    x, force, slope = run.displacement, run.force, np.gradient(run.force, run.sample_time)
    return [(factor * force, factor * slope, x / factor) for factor in SWAPS]


def fitted(moments: Sequence[Moments]) -> Array:
    """The coefficients that explain the forces of all runs best, each weighed by its own size.

    What differs from their means counts: each run may have a zero of its own.
    """
    centred = [each.centred() for each in moments]
    gram = np.sum([each.gram[1:, 1:] / each.power for each in centred], axis=0)
    right = np.sum([each.right[1:] / each.power for each in centred], axis=0)
    scale = np.sqrt(np.maximum(np.diag(gram), _TINY))
    matrix = gram / np.outer(scale, scale) + RIDGE * np.eye(scale.size)
    return np.concatenate([[0.0], np.linalg.solve(matrix, right / scale) / scale])


def compared(moments: Moments, coefficients: Array) -> tuple[float, float]:
    """Force over forecast, and the share of the variance of the force that this times the forecast explains.

    Of both what differs from their means: a weight that was not tared is predicted whatever the motion is.
    """
    centred = moments.centred()
    product, predicted = float(coefficients @ centred.right), float(coefficients @ centred.gram @ coefficients)
    if not predicted > 0.0:
        return 0.0, 0.0
    return product / predicted, product**2 / (predicted * centred.power)


def rate_of(run: Run) -> Array:
    """The velocity (n,) in m/s of the deflection as it was measured."""
    return np.gradient(run.displacement, run.sample_time)


def _functions(x: Array, v: Array) -> Array:
    return np.array([np.ones(x.size), x, x**2, x**3, v, v * np.abs(v), v * x, np.tanh(10.0 * v)])
