"""Numbers that are known from elsewhere, such as a mass that was weighed, and how far they may be off."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.model.network import NetworkSpec, Value

Array = NDArray[np.float64]

STANDARD = 2.0 * 1.959964  # standard errors in a 95 % interval


@dataclass(frozen=True, eq=False)
class KnownNumber:
    """A number with an interval of its own; ``step`` (slots,) moves it by one standard error."""

    path: str
    value: Value
    step: Array


def known_numbers(spec: NetworkSpec) -> list[KnownNumber]:
    """The known parameters of a network; what follows from them moves with them."""
    slots = spec.slots()
    start = np.array([slot.value.number for slot in slots])
    return [
        KnownNumber(
            slot.path, slot.value, spec.derived.fill((start + _standard_error(slot.value) * unit)[None])[0] - start
        )
        for slot, unit in zip(slots, np.eye(len(slots)), strict=True)
        if slot.value.known
    ]


def _standard_error(value: Value) -> float:
    assert value.interval is not None
    return (value.interval[1] - value.interval[0]) / STANDARD
