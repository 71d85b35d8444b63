"""The prior odds of a structure: how many causes there are, how usual each is; chance and a law without a name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite

import numpy as np

from dashpot.contract.cause import Cause
from dashpot.diagnose.term import Model

FALSE_ALARMS = 0.01  # of data sets in which nothing is hidden
RIG_ODDS = 0.01  # of a fault of the measurement against a law of the specimen
NUMBER_ODDS = 0.1  # of a law with a number more against one without it


@dataclass(frozen=True)
class Odds:
    """Prior odds of a term, in nats: with ``columns`` to choose from, none is named by chance but in 1 % of cases.

    Where it is certain that something is ``missing`` in the diagnosed network, nothing is hidden in no case: the first
    cause has to be told from the others only. A given branch was not chosen: it has the odds of its numbers.
    """

    columns: int
    missing: bool = False

    def price(self, kind: str, numbers: int = 1) -> float:
        """What a term with so many numbers has to predict before it is more likely than not."""
        if kind == "given":
            return float(-numbers * np.log(NUMBER_ODDS))
        found = np.log(max(self.columns, 1) / FALSE_ALARMS) - max(numbers - 1, 0) * np.log(NUMBER_ODDS)
        return float(found - (np.log(RIG_ODDS) if kind == "measurement" else 0.0))

    def of_any(self, causes: int) -> float:
        """What so many causes have to predict less, since there has to be one."""
        return float(np.log(FALSE_ALARMS)) if self.missing and causes else 0.0

    def of_model(self, model: Model) -> float:
        """The price of all terms of a model."""
        each = sum(self.price(term.kind, model.count(number)) for number, term in enumerate(model.terms))
        return each + self.of_any(len(model.causes))


def agreed_by_chance(groups: int) -> float:
    """How likely a law that is none predicts so many groups of runs all better: each by one half (sign test)."""
    return 0.5**groups


def against_unknown(cause: type[Cause], numbers: Mapping[str, float]) -> float:
    """The prior odds of a cause, with the numbers that were found, against an unknown law of the specimen.

    That the phase and the inertia are the same in every run tells a fault of the measurement from the laws that are
    known. A delay or a mass below zero may be an unknown law, and a passive one: damping in proportion to the stiffness
    shifts the phase as an early channel does, and relaxation stiffens with the frequency. Above zero they would have
    to give energy or be inertia.
    """
    passive = any(number < 0.0 for number in numbers.values())
    return RIG_ODDS if passive and cause.kind == "measurement" and cause.evidence_of == "phase" else 1.0


def share_of_both(explained: float, unexplained: float, odds: float = 1.0) -> float:
    """The probability of a cause against a law that nobody has named: its share of what both explain.

    Both are shares of the square of the residual, ``odds`` those of the cause beforehand against a law of the specimen.
    The unknown law acts in the same specimen, so that more runs do not say how much of what it does the cause has
    taken up.
    """
    return odds * explained / (odds * explained + unexplained) if isfinite(explained) else 1.0
