"""The intervals of numbers that follow from identified ones, to first order."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from dashpot.fit.coordinates import Coordinates
from dashpot.fit.linear import STEP
from dashpot.fit.uncertainty import Uncertainty
from dashpot.model.network import Slot


def derived_intervals(
    slots: Sequence[Slot], coordinates: Coordinates, known: Uncertainty
) -> dict[str, tuple[float, float]]:
    """The 95 % interval, in SI, of each number with an expression over identified ones, by path.

    By the half widths and the correlation of the identified parameters, inside the range in which the number makes
    sense. One that follows from a parameter that the data do not determine has this whole range.
    """
    rules = {rule.slot: rule for rule in coordinates.derived.rules}
    point, step = coordinates.start, STEP * coordinates.unit
    values = coordinates.to_values(np.concatenate([point + np.diag(step), point - np.diag(step)]))
    slopes = (values[: point.size] - values[point.size :]) / (2.0 * STEP)
    found = {}
    for slot, rule in rules.items():
        felt = slopes[:, slot] != 0.0
        if felt.any():
            shares = slopes[felt, slot] * known.widths[felt]
            width = float(np.sqrt(max(shares @ known.correlation[np.ix_(felt, felt)] @ shares, 0.0)))
            number = slots[slot].value.number
            low, high = (number - width, number + width) if np.isfinite(width) else rule.sensible
            found[slots[slot].path] = (max(low, rule.sensible[0]), min(high, rule.sensible[1]))
    return found
