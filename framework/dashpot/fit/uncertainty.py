"""How well a fit knows its parameters, from the scatter of its gradient between blocks of the record."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.coordinates import Coordinates
from dashpot.fit.objective import Objective
from dashpot.fit.refine import linearise

Array = NDArray[np.float64]

NORMAL_95 = 1.959963984540054
BLOCK_SECONDS = 0.25
FEWEST_BLOCKS = 8
WEAK = 1e-6
UNDECIDED = 1e-12  # of the largest eigenvalue, with parameters scaled alike
SHARE = 1e-6


@dataclass(frozen=True, eq=False)
class Uncertainty:
    """``covariance`` (p, p) in natural steps of the coordinates; ``idle`` names parameters the data do not feel.

    The interval of an idle parameter, and of one that others can make up for entirely, is its whole range.
    """

    covariance: Array
    intervals: tuple[tuple[float, float], ...]
    at_bound: tuple[str, ...]
    idle: tuple[str, ...]


def assess_uncertainty(objective: Objective, coordinates: Coordinates, point: Array) -> Uncertainty:
    """Sandwich covariance with blocks of a quarter of a second, so that coloured noise and small model errors count.

    Source: Liang and Zeger, Biometrika 73 (1986) 13, with blocks of time as clusters.
    """
    residual, jacobian = linearise(objective, coordinates, point)
    normal = jacobian @ jacobian.T
    scale = np.sqrt(np.diag(normal))
    loss = np.sqrt(np.mean(residual**2))
    idle = scale / np.sqrt(residual.size) < WEAK * max(loss, 1e-300)
    safe = np.where(idle, 1.0, scale)
    inverse, lost = _inverse(normal / np.outer(safe, safe))
    scores = np.array([jacobian[:, block] @ residual[block] for block in _blocks(objective)]) / safe
    count = len(scores)
    middle = scores.T @ scores * (count / max(count - len(point), 1))
    covariance = inverse @ middle @ inverse / np.outer(safe, safe)
    width = np.where(idle | lost, np.inf, NORMAL_95 * np.sqrt(np.diag(covariance)) * coordinates.unit)
    near = 1e-6 * (coordinates.high - coordinates.low)
    bound = (point <= coordinates.low + near) | (point >= coordinates.high - near)
    return Uncertainty(
        covariance,
        tuple(_interval(coordinates, k, point[k], width[k]) for k in range(point.size)),
        tuple(np.array(coordinates.paths)[bound].tolist()),
        tuple(np.array(coordinates.paths)[idle].tolist()),
    )


def _inverse(normal: Array) -> tuple[Array, NDArray[np.bool_]]:
    """The inverse where the data decide, and which parameters share in a direction in which they do not."""
    values, vectors = np.linalg.eigh(normal)
    kept = values > UNDECIDED * values[-1]
    inverse = (vectors[:, kept] / values[kept]) @ vectors[:, kept].T
    return inverse, np.sum(vectors[:, ~kept] ** 2, axis=1) > SHARE


def _blocks(objective: Objective) -> list[slice]:
    found = []
    for run, piece in zip(objective.runs, objective.pieces, strict=True):
        length = max(1, min(round(BLOCK_SECONDS / run.drive.dt), run.samples // FEWEST_BLOCKS))
        edges = range(piece.start, piece.stop, length)
        found += [slice(first, min(first + length, piece.stop)) for first in edges]
    return found


def _interval(coordinates: Coordinates, number: int, middle: float, width: float) -> tuple[float, float]:
    low = max(middle - width, coordinates.low[number])
    high = min(middle + width, coordinates.high[number])
    if coordinates.log[number]:
        return float(np.exp(low)), float(np.exp(high))
    return float(low), float(high)
