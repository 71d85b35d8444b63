"""What sound runs predict of another one, and how far it may be from that by chance.

Where they have been, all functions of the forecast tell; beyond, a polynomial may go anywhere, and only the plain
functions do, which know the course of a force but not its size.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from dashpot.data.run import Run
from dashpot.triage.agreement import MOSTLY
from dashpot.triage.energy import ONE_IN
from dashpot.triage.forecast import Moments, Sizes, compared, fitted, moments_of, rate_of

Array = NDArray[np.float64]
Signals = tuple[Array, Array, Array]  # deflection in m, velocity in m/s and force in N, (n,) each
Seen = tuple[float, float]  # force over forecast, and the share of the variance of the force that a multiple explains
Measure = Callable[[float, float], float]

_TINY = 1e-300


@dataclass(frozen=True, eq=False)
class Forecast:
    """The moments of sound runs, by all functions or by the ``plain`` ones."""

    moments: Sequence[Moments]
    plain: bool

    def compare(self, moments: Moments) -> Seen:
        """A run beside what all of them predict."""
        return compared(self._chosen(moments), self._all)

    def usual(self, measure: Measure) -> list[float]:
        """How far each of them is from what the others predict."""
        each = [self._chosen(moments) for moments in self.moments]
        rest = ([other for other in each if other is not one] for one in each)
        return [measure(*compared(one, fitted(others))) for one, others in zip(each, rest, strict=True)]

    @cached_property
    def _all(self) -> Array:
        return fitted([self._chosen(moments) for moments in self.moments])

    def _chosen(self, moments: Moments) -> Moments:
        return moments.plain() if self.plain else moments


@dataclass(frozen=True, eq=False)
class Others:
    """Sound runs, where they have been (m), and what they predict there and beyond."""

    sizes: Sizes
    low: float
    high: float
    there: Forecast
    beyond: Forecast

    @classmethod
    def of(cls, runs: Sequence[Run], signals: Iterable[Signals] | None = None) -> Others:
        """What ``runs`` predict, by their ``signals`` where these are not as they were measured."""
        sizes = Sizes.of(runs)
        moments = [moments_of(*each, sizes) for each in signals or map(signals_of, runs)]
        low = min(float(np.min(run.displacement)) for run in runs)
        high = max(float(np.max(run.displacement)) for run in runs)
        return cls(sizes, low, high, Forecast(moments, plain=False), Forecast(moments, plain=True))

    def know(self, x: Array) -> bool:
        """Whether they have been at most of some deflections (n,) in m."""
        return float(np.mean((self.low <= x) & (x <= self.high))) >= MOSTLY

    def forecast(self, x: Array) -> Forecast:
        """The one for a run with these deflections."""
        return self.there if self.know(x) else self.beyond

    def apart(self, signals: Signals, measure: Measure) -> float:
        """How far a run with such signals is from what they predict."""
        return measure(*self.forecast(signals[0]).compare(moments_of(*signals, self.sizes)))

    def course(self, run: Run) -> Seen:
        """A run beside what they predict by the plain functions."""
        return self.beyond.compare(moments_of(*signals_of(run), self.sizes))


def signals_of(run: Run) -> Signals:
    """The signals of a run as it was measured."""
    return run.displacement, rate_of(run), run.force


def unlike(gain: float, likeness: float) -> float:
    """The share of the square of a force that no multiple of the forecast explains; all of it for a negative one."""
    return 1.0 - likeness if gain > 0.0 else 1.0


def missed(gain: float, likeness: float) -> float:
    """The share of the square of a force that the forecast as it is leaves, at most all of it."""
    return min(1.0 - likeness + (1.0 / gain - 1.0) ** 2 * likeness, 1.0) if gain > 0.0 else 1.0


def farthest(usual: Sequence[float]) -> float:
    """The share of the square of its force that the others leave of a sound run in all but one of 1000 cases.

    By Student's t over the logarithms of what they leave of each other; never more than half.
    """
    from scipy.special import stdtrit

    logs = np.log(np.maximum(usual, _TINY))
    beyond = float(stdtrit(logs.size - 1, 1.0 - 1.0 / ONE_IN)) * np.sqrt(1.0 + 1.0 / logs.size)
    reach = float(np.mean(logs) + beyond * np.std(logs, ddof=1))
    return float(np.exp(min(max(reach, float(np.max(logs))), np.log(MOSTLY))))
