"""What data can tell about numbers, from their Fisher information, in words."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.coordinates import Coordinates
from dashpot.fit.objective import Objective
from dashpot.fit.refine import linearise

Array = NDArray[np.float64]

WEAK, LOST = 0.1, 1.0  # standard deviation in natural steps: of 10 %, of a factor of e
NOTHING = 3.0  # standard deviation from which nothing is known but what other numbers leave over
FELT = 1e-9
SHARE = 0.35  # of the largest part of a direction, from which a part is named
NAMED, SHOWN = 4, 6


@dataclass(frozen=True)
class Direction:
    """Numbers that can make up for one another: ``parts`` are (path, share), the largest first; all squares add to 1.

    ``deviation`` is the standard deviation along the direction, in natural steps: 0.1 is about 10 %.
    """

    deviation: float
    parts: tuple[tuple[str, float], ...]

    @property
    def lost(self) -> bool:
        """Whether the data do not tell anything about the direction."""
        return not self.deviation < LOST

    @property
    def words(self) -> str:
        """The direction in a sentence."""
        largest = abs(self.parts[0][1])
        named = [part for part in self.parts if abs(part[1]) >= SHARE * largest]
        known = f"known to {_percent(self.deviation * largest)}" if self.deviation < NOTHING else "otherwise unknown"
        if len(named) == 1:
            how = f"weakly determined, {known}" if not self.lost else "not determined"
            return f"{number_in_words(named[0][0])} is {how}"
        shown = named[:NAMED]
        sign = np.sign(shown[0][1])
        moves = ", ".join(f"{10.0 * sign * share / largest:+.2g} %" for _, share in shown)
        more = f" (and {len(named) - NAMED} more)" if len(named) > NAMED else ""
        names = " and ".join(number_in_words(path) for path, _ in shown)
        return f"{names}{more} trade off: {moves} together hardly change the force; {known}"


@dataclass(frozen=True)
class Identifiability:
    """``condition`` of the Fisher information in natural steps; ``deviations`` (path -> standard deviation, natural
    steps); ``loose`` directions, the worst first; ``idle`` numbers, which the data do not feel."""

    condition: float
    deviations: dict[str, float]
    loose: tuple[Direction, ...]
    idle: tuple[str, ...]

    @property
    def sentences(self) -> list[str]:
        """Everything that is not well known, in words."""
        idle = [f"{number_in_words(path)} has no influence on these data" for path in self.idle]
        more = len(self.loose) - SHOWN
        rest = [f"{more} more combinations are weakly determined"] if more > 0 else []
        return idle + [direction.words for direction in self.loose[:SHOWN]] + rest

    @property
    def firm(self) -> list[str]:
        """The numbers that are known to better than 10 % each."""
        return [path for path, deviation in self.deviations.items() if deviation < WEAK]


def identifiability(objective: Objective, coordinates: Coordinates, point: Array, noise: float) -> Identifiability:
    """The Fisher information at a point (p,) under white noise of the force (root mean square, N).

    ``objective`` counts every sample alike: it is made with `unweighted`.
    """
    _, jacobian = linearise(objective, coordinates, point)
    fisher = jacobian @ jacobian.T / noise**2
    size = np.sqrt(np.diag(fisher))
    idle = size < FELT * max(size.max(initial=0.0), 1e-300)
    felt = np.flatnonzero(~idle)
    values, vectors = np.linalg.eigh(fisher[np.ix_(felt, felt)])
    values = np.maximum(values, 1e-15 * values[-1]) if values.size else values
    spread = np.sqrt(np.sum(vectors**2 / values, axis=1))
    paths = [coordinates.paths[k] for k in felt]
    loose = [_direction(paths, vector, value) for value, vector in zip(values, vectors.T, strict=True)]
    return Identifiability(
        float(values[-1] / values[0]) if values.size else 1.0,
        dict(zip(paths, spread.tolist(), strict=True)),
        tuple(direction for direction in loose if direction.deviation > WEAK),
        tuple(np.array(coordinates.paths)[idle].tolist()),
    )


def unweighted(run: str, misfits: Array) -> Array:
    """For `Objective(whiten=...)`: every sample counts alike, in N."""
    return misfits


def number_in_words(path: str) -> str:
    """`maxwell_1.relaxation_time` as `relaxation time of maxwell_1`."""
    branch, _, key = path.rpartition(".")
    return f"{key.replace('_', ' ')} of {branch}" if branch else path


def _direction(paths: list[str], vector: Array, value: float) -> Direction:
    order = np.argsort(-np.abs(vector), kind="stable")
    return Direction(float(value**-0.5), tuple((paths[k], float(vector[k])) for k in order))


def _percent(deviation: float) -> str:
    return f"+-{100.0 * deviation:.2g} %" if deviation < 0.5 else f"a factor of {np.exp(min(deviation, 40.0)):.2g}"
