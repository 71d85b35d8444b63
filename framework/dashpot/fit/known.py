"""Numbers that are known from elsewhere, such as a mass that was weighed, and what their errors do to a residual."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.objective import Objective
from dashpot.model.network import Value

Array = NDArray[np.float64]

STANDARD = 2.0 * 1.959964  # standard errors in a 95 % interval


@dataclass(frozen=True, eq=False)
class KnownNumber:
    """A number with an interval of its own; ``shift`` (samples,) is what one standard error does to the residual."""

    path: str
    value: Value
    shift: Array


def known_numbers(objective: Objective) -> list[KnownNumber]:
    """The known numbers of the objective's network, at the numbers of its file."""
    slots = objective.network.spec.slots()
    return [KnownNumber(slot.path, slot.value, _shift_of(objective, number, slot.value))
            for number, slot in enumerate(slots) if slot.value.known]  # fmt: skip


def residual_shift(objective: Objective, step: Array) -> Array:
    """What a ``step`` (p,) of all numbers (SI) does to the residual (samples,) at the numbers of the file.

    Where the network cannot be solved after the step it is taken the other way.
    """
    start = np.atleast_2d(objective.network.start)[:1]
    base, there, back = objective.residuals(np.concatenate([start, start + step, start - step]))
    return there - base if np.isfinite(there).all() else base - back


def _shift_of(objective: Objective, number: int, value: Value) -> Array:
    assert value.interval is not None
    step = np.zeros(len(objective.network.spec.slots()))
    step[number] = (value.interval[1] - value.interval[0]) / STANDARD
    return residual_shift(objective, step)
