"""The profile likelihood of a number: how good the best fit can be while it is held somewhere else."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.algebra import single_threaded_algebra
from dashpot.fit.coordinates import Coordinates
from dashpot.fit.linear import linearise
from dashpot.fit.objective import Objective
from dashpot.fit.refine import refine
from dashpot.fit.uncertainty import assess_uncertainty
from dashpot.kernel.workers import pieces

if TYPE_CHECKING:
    from dashpot.kernel.workers import Jobs

Array = NDArray[np.float64]

MOST, STEPS, TOLERANCE = 12, 12, 1e-6
WIDEST = 30.0  # standard deviations under white noise
PACE = 0.7  # of the interval that the curvature promises


@dataclass(frozen=True)
class Profile:
    """``values`` (k,) in SI and the ``losses`` (k,) in N of the best fits there; the 95 % ``interval``.

    ``open_ends`` says which ends of the interval are only the end of the range: the data do not rule out more.
    """

    path: str
    values: tuple[float, ...]
    losses: tuple[float, ...]
    interval: tuple[float, float]
    open_ends: tuple[bool, bool]


def profile_likelihood(
    objective: Objective, coordinates: Coordinates, point: Array, number: int, noise: float | None = None
) -> Profile:
    """Walk from the fitted point (p,) along coordinate ``number``, refitting all others, until the fit is worse.

    Worse is where the root of twice the fall of the log likelihood is as large as the half width of the interval of
    `assess_uncertainty` in standard deviations under white noise: 1.96 for white noise, more for coloured noise, and
    more where the RMSE of the model is more than ``noise`` (N).

    Source: Raue et al., Bioinformatics 25 (2009) 1923.
    """
    climb = _Climb(objective, coordinates, point, number, noise)
    sides = [climb.walk(direction) for direction in (-1.0, 1.0)]
    visited = sorted([*sides[0].visited, (point[number], climb.loss), *sides[1].visited])
    ends = [side.end for side in sides]
    return Profile(
        coordinates.paths[number],
        tuple(coordinates.number(number, at) for at, _ in visited),
        tuple(loss for _, loss in visited),
        (coordinates.number(number, ends[0]), coordinates.number(number, ends[1])),
        (sides[0].open, sides[1].open),
    )


def profiles(
    objective: Objective,
    coordinates: Coordinates,
    point: Array,
    numbers: Sequence[int],
    noise: float | None = None,
    jobs: Jobs = 1,
) -> list[Profile]:
    """The profile likelihoods of several coordinates, each a piece of work."""
    return pieces(_profile, (objective, coordinates, point, noise), numbers, jobs)


@single_threaded_algebra
def _profile(shared: tuple[Objective, Coordinates, Array, float | None], number: int) -> Profile:
    objective, coordinates, point, noise = shared
    return profile_likelihood(objective, coordinates, point, number, noise)


@dataclass(frozen=True)
class _Side:
    visited: list[tuple[float, float]]
    end: float
    open: bool


class _Climb:
    def __init__(
        self, objective: Objective, coordinates: Coordinates, point: Array, number: int, noise: float | None
    ) -> None:
        self.objective, self.coordinates, self.point, self.number = objective, coordinates, point, number
        self.loss = float(objective.losses(coordinates.to_values(point))[0])
        normal = linearise(objective, coordinates, point).normal
        naive = self.loss**2 * np.linalg.pinv(normal, hermitian=True)[number, number]
        if not naive > 0.0:
            # nothing is known of the number: half its range is to be walked at once
            naive = ((coordinates.high - coordinates.low) / coordinates.unit)[number] ** 2 / WIDEST**2
        width = float(assess_uncertainty(objective, coordinates, point, noise=noise).widths[number])
        self.limit = min(width / np.sqrt(naive), WIDEST)
        self.pace = PACE * self.limit * np.sqrt(naive) * coordinates.unit[number]

    def walk(self, direction: float) -> _Side:
        wall = self.coordinates.high[self.number] if direction > 0.0 else self.coordinates.low[self.number]
        visited: list[tuple[float, float]] = []
        at, rest, before = self.point[self.number], np.delete(self.point, self.number), (0.0, self.point[self.number])
        pace = self.pace
        for _ in range(MOST):
            at = float(
                np.clip(at + direction * pace, self.coordinates.low[self.number], self.coordinates.high[self.number])
            )
            held = self.coordinates.held(self.number, at)
            refined = refine(self.objective, held, rest, STEPS, TOLERANCE)
            rest, depth = refined.point, self.depth(refined.loss)
            visited.append((at, refined.loss))
            if depth >= self.limit:
                share = (self.limit - before[0]) / (depth - before[0])
                return _Side(visited, before[1] + share * (at - before[1]), False)
            if at == wall:
                return _Side(visited, at, True)
            pace *= 2.0 if depth - before[0] < 0.3 * self.limit else 1.0
            before = (depth, at)
        return _Side(visited, float(wall), True)

    def depth(self, loss: float) -> float:
        """The signed root of the fall of twice the log likelihood, nearly linear in the coordinate."""
        return float(np.sqrt(max(self.objective.total * (loss**2 / self.loss**2 - 1.0), 0.0)))
