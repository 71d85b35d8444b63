"""Steps along a bent valley: a Gauss-Newton step with the second order of the residual along it.

Where many numbers make up for each other, the residual hardly changes along a narrow valley that is bent. Straight
steps leave it and have to be short, however far it leads. The geodesic acceleration (Transtrum and Sethna 2012) bends
them as the valley is bent.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.coordinates import Coordinates
from dashpot.fit.linear import Linear, Loss, linearise

Array = NDArray[np.float64]

PROBED = 0.1  # of a step, over which the second order is measured, as of Transtrum and Sethna


def bent_steps(
    objective: Loss, linear: Linear, coordinates: Coordinates, point: Array, straight: Array, dampings: Sequence[float]
) -> Array:
    """Where ``straight`` steps (k, p), made with these ``dampings`` (k,), lead from a point (p,) if they are bent.

    It costs a linearisation with k more lanes. Numbers that come to a bound stay there.
    """
    values, normal = coordinates.to_values(np.vstack([point, point + PROBED * (straight - point)])), linear.normal
    probed = linearise(objective, coordinates, point, list(values[1:] - values[0])).beside
    felt = np.diag(normal) > 0.0
    found = straight.copy()
    for step, end, change, damping in zip(straight - point, found, probed, dampings, strict=True):
        second = 2.0 / PROBED * (change / PROBED - normal @ (step / coordinates.unit))
        free = felt & (end > coordinates.low) & (end < coordinates.high)
        end[free] -= 0.5 * _damped(normal[np.ix_(free, free)], second[free], damping) * coordinates.unit[free]
    return coordinates.allowed(found)


def _damped(normal: Array, right: Array, damping: float) -> Array:
    scale = np.sqrt(np.diag(normal))
    matrix = normal / np.outer(scale, scale) + damping * np.eye(scale.size)
    return np.asarray(np.linalg.lstsq(matrix, right / scale, rcond=None)[0] / scale)
