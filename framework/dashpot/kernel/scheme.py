"""The time scheme of networks with unknown nodes: trapezoidal rule and backward differences in turn.

A pair of equal steps s, the first by the trapezoidal rule, the second by the second-order backward difference formula,
is of second order and forgets stiff errors at once (Bank et al., Transient simulation of silicon devices and circuits,
1985). In both the new velocity is linear in the new position: v = slope x + now x0 + before x1 + swing v0, where x0, v0
hold at the begin of the step and x1 one step earlier.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

PAIR = 2


@dataclass(frozen=True)
class Rule:
    """Coefficients of every step (steps,), in 1/s; ``swing`` is a plain factor."""

    slope: Array
    now: Array
    before: Array
    swing: Array


def alternate(step: float, pairs: int, begins: bool = True) -> Rule:
    """The coefficients of ``pairs`` of steps of ``step`` seconds.

    Where a record ``begins``, the very first step is a backward Euler one: it needs no acceleration to begin with.
    """
    trapezoidal, backward = np.tile([1.0, 0.0], pairs), np.tile([0.0, 1.0], pairs)
    euler = np.zeros(PAIR * pairs)
    if begins:
        euler[:1], trapezoidal[:1] = 1.0, 0.0
    return Rule(
        slope=(euler + 2.0 * trapezoidal + 1.5 * backward) / step,
        now=-(euler + 2.0 * trapezoidal + 2.0 * backward) / step,
        before=0.5 * backward / step,
        swing=-trapezoidal,
    )
