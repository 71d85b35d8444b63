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
    """The known numbers of the objective's network, at the parameters of its file."""
    known = {number: slot for number, slot in enumerate(objective.network.spec.slots()) if slot.value.known}
    shifts = _shifts_of(objective, list(known), [_standard_error(slot.value) for slot in known.values()])
    return [KnownNumber(slot.path, slot.value, shift) for slot, shift in zip(known.values(), shifts, strict=True)]


def residual_shift(objective: Objective, step: Array) -> Array:
    """What a ``step`` (p,) of all numbers (SI) does to the residual (samples,) at the parameters of the file.

    Where the network cannot be solved after the step it is taken the other way.
    """
    start = np.atleast_2d(objective.network.start)[:1]
    base, there, back = objective.residuals(np.concatenate([start, start + step, start - step]))
    return there - base if np.isfinite(there).all() else base - back


def _standard_error(value: Value) -> float:
    assert value.interval is not None
    return (value.interval[1] - value.interval[0]) / STANDARD


def _shifts_of(objective: Objective, which: list[int], steps: list[float]) -> Array:
    """What each of some numbers does to the residual when it moves by its step, or, where that fails, back by it."""
    if not which:
        return np.empty((0, objective.total))
    start, forth = np.atleast_2d(objective.network.start)[0], np.array(steps)
    shifts = objective.linearise(start, which, forth)[1]
    failed = ~np.isfinite(shifts).all(axis=1)
    if failed.any():
        shifts[failed] = -objective.linearise(start, which, -forth)[1][failed]
    return shifts
