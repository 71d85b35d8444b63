"""What a metric promises: one number of a run, measured or simulated."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar

from dashpot.data.run import Run


class Metric(ABC):
    """A scalar result of a test, such as the least contact force of a wheel in per cent of the static one.

    Examples:
        >>> class LeastForce(dp.Metric):
        ...     '''The least force of a run.'''
        ...     word, unit = "least_force", "N"
        ...     def measure(self, run):
        ...         return float(run.force.min())
        >>> run = dp.load_dataset("mount").runs[0]
        >>> LeastForce().measure(run) == float(run.force.min())
        True
    """

    word: ClassVar[str]
    """The name of the metric in result files."""

    unit: ClassVar[str]
    """The unit of the number, as a report shows it."""

    everywhere: ClassVar[bool] = True
    """Whether it is told of every run that has it; False: only where a sensitivity study names it."""

    @abstractmethod
    def measure(self, run: Run) -> float | None:
        """The result of a run with ``displacement`` (n,) m and ``force`` (n,) N; None for a run of another test."""
