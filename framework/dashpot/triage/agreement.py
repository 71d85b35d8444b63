"""The runs of a dataset that agree with each other, found by a forward search, and how far they are apart.

Source: Atkinson, Riani, Cerioli, "Exploring Multivariate Data with the Forward Search", Springer 2004.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.triage.forecast import Moments, compared, fitted

Array = NDArray[np.float64]

FEWEST = 3
# of datasets without a fault, one in so many may have a sound run accused by chance
ONE_IN = 1000
# a machine of class 1 after ISO 7500-1 shows forces to so much
ACCURACY = 0.01
# a forecast that leaves more than half of the square of a force is none
MOSTLY = 0.5


@dataclass(frozen=True, eq=False)
class Agreement:
    """``inside``: numbers of the runs that agree; ``coefficients``: what they predict; ``spread``: root mean square of
    the logarithms of their gains against the other ones; ``likeness``: the least that any of them has.

    ``count``: how many runs there are; ``plain``: whether the plain functions predict them better than all.
    """

    inside: tuple[int, ...]
    coefficients: Array
    spread: float
    likeness: float
    count: int
    plain: bool = False

    def compare(self, moments: Moments) -> tuple[float, float]:
        """Force over forecast of a run, and the share of its force that is like it."""
        return compared(moments.plain() if self.plain else moments, self.coefficients)

    @property
    def reach(self) -> float:
        """How far the logarithm of a gain lies from zero by chance, in one of 1000 datasets."""
        return _student(0.5 / (ONE_IN * self.count), len(self.inside)) * self.spread + ACCURACY

    @property
    def tolerance(self) -> float:
        """How far it lies from zero in 95 % of all runs."""
        return _student(0.025, len(self.inside)) * self.spread + ACCURACY

    def is_like(self, likeness: float) -> bool:
        """Whether the course of a force is like the forecast as much as for those inside."""
        return likeness >= self.likeness - ACCURACY


def find_agreement(moments: Sequence[Moments]) -> Agreement | None:
    """The majority of the runs that agrees best, and what joins it; None where no majority can be predicted at all.

    By all functions, or by the plain ones if the runs agree better by these.
    """
    if len(moments) < FEWEST:
        return None
    rich, plain = _search(moments), _search([each.plain() for each in moments])
    if plain is not None and (rich is None or plain.reach < rich.reach):
        return replace(plain, plain=True)
    return rich


def _search(moments: Sequence[Moments]) -> Agreement | None:
    starts = [_majority(first, moments) for first in range(len(moments))]
    sound = [(_distances(inside, moments), inside) for inside in starts if inside]
    sound = [(apart, inside) for apart, inside in sound if np.all(np.isfinite(apart))]
    if not sound:
        return None
    _, inside = min(sound, key=lambda found: float(np.sum(found[0] ** 2)))
    inside = _joined(inside, moments)
    likeness = min(compared(moments[k], fitted(_others(inside, k, moments)))[1] for k in inside)
    return None if likeness < MOSTLY else _agreement(inside, moments, likeness)


def _agreement(inside: Sequence[int], moments: Sequence[Moments], likeness: float = 0.0) -> Agreement:
    spread = float(np.sqrt(np.mean(_distances(inside, moments) ** 2)))
    return Agreement(tuple(sorted(inside)), fitted([moments[k] for k in inside]), spread, likeness, len(moments))


def _majority(first: int, moments: Sequence[Moments]) -> list[int]:
    """More than half of the runs, from one of them on always the next nearest; empty where they point elsewhere."""
    inside = [first]
    while len(inside) <= len(moments) // 2:
        coefficients = fitted([moments[k] for k in inside])
        apart = {k: distance(moments[k], coefficients) for k in range(len(moments)) if k not in inside}
        nearest = min(apart, key=lambda k: apart[k])
        if not math.isfinite(apart[nearest]):
            return []
        inside.append(nearest)
    return inside


def _joined(inside: list[int], moments: Sequence[Moments]) -> list[int]:
    """With every further run that is no farther away than chance allows, the nearest first."""
    while len(inside) < len(moments):
        known = _agreement(inside, moments)
        apart = {k: distance(moments[k], known.coefficients) for k in range(len(moments)) if k not in inside}
        nearest = min(apart, key=lambda k: apart[k])
        if not apart[nearest] <= known.reach:
            break
        inside = [*inside, nearest]
    return inside


def distance(moments: Moments, coefficients: Array) -> float:
    """The logarithm of force over forecast without sign; infinite where one points against the other."""
    gain, _ = compared(moments, coefficients)
    return abs(math.log(gain)) if gain > 0.0 else math.inf


def _distances(inside: Sequence[int], moments: Sequence[Moments]) -> Array:
    return np.array([distance(moments[k], fitted(_others(inside, k, moments))) for k in inside])


def _others(inside: Sequence[int], number: int, moments: Sequence[Moments]) -> list[Moments]:
    return [moments[k] for k in inside if k != number]


def _student(probability: float, freedom: int) -> float:
    from scipy.special import stdtrit

    return float(-stdtrit(freedom, probability))
