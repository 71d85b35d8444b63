"""What becomes of the candidates that were refitted: causes with their proof, and those that did not hold."""

from __future__ import annotations

from dataclasses import dataclass

from dashpot.assess.contest import Model, Trial
from dashpot.assess.gain import Gain
from dashpot.assess.screen import Finding


@dataclass(frozen=True, eq=False)
class Accepted:
    """A cause with its proof: the model after it, the gain on held-out runs, what could not be told from it.

    ``others`` are the trials of its rivals, ``base`` the model before it, ``simpler`` the trials of causes with fewer
    numbers that came near.
    """

    finding: Finding
    trial: Trial
    expected_gain: float
    gain: Gain | None
    rivals: tuple[str, ...]
    others: tuple[Trial, ...] = ()
    base: Model | None = None
    simpler: tuple[Trial, ...] = ()


@dataclass(frozen=True)
class Rejection:
    """A candidate that was refitted and did not hold."""

    cause: str
    form: str
    reason: str
    expected_gain: float | None = None
    gain: float | None = None
    place: str | None = None
