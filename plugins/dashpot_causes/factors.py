"""From strengths at the places of a table to the factors that are written there."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom

SMALLEST_FACTOR, LARGEST_FACTOR = 0.05, 20.0


def at_all_places(places: Sequence[float], atoms: Sequence[Atom]) -> list[Atom]:
    """The strengths at all places in their order: zero where there is no atom."""
    strengths = dict.fromkeys(places, 0.0) | {place: strength for strength, place in atoms}
    return [(strengths[place], place) for place in places]


def factors_of(strengths: Sequence[float], unit: float = 1.0) -> tuple[NDArray[np.float64], int]:
    """The factors on a parameter that changes by strengths over ``unit``, and the place of the one that stays one.

    It is the place that changes least, so that the value found before is a good start.
    """
    changes = np.asarray(strengths, dtype=float)
    return np.clip(1.0 + changes / unit, SMALLEST_FACTOR, LARGEST_FACTOR), int(np.argmin(np.abs(changes)))
