"""The time scheme of networks with unknown nodes: trapezoidal rule and backward differences in turn.

A pair of equal steps s, the first by the trapezoidal rule, the second by the second-order backward difference formula,
is of second order and forgets stiff errors at once (Bank et al., Transient simulation of silicon devices and circuits,
1985). In both the new velocity is linear in the new position: v = slope x + now x0 + before x1 + swing v0, where x0, v0
hold at the begin of the step and x1 one step earlier.

Where all unknown nodes have masses that are slow for the step, the rule of Adams and Moulton takes a cubic through the
new acceleration and the three before it: v = v0 + s SPEED a and x = x0 + s v0 + s^2 PLACE a. It is of fourth order.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

PAIR = 2
SPEED = (9 / 24, 19 / 24, -5 / 24, 1 / 24)  # of the accelerations, the new one first
PLACE = (38 / 360, 171 / 360, -36 / 360, 7 / 360)
PLACE_AHEAD = (19 / 24, -10 / 24, 3 / 24)  # of those before, by the parabola through them
KEPT = 8  # rules that stay known: a fit asks for the same ones run by run
FILLED = 3  # steps by other rules at the begin of a record, until there are as many accelerations
RENEWED = 16  # steps from one renewal of the tangents to the next
FIRMEST, FASTEST = 0.2, 0.7  # of stiffness s^2/mass and damping s/mass, for the short steps


@dataclass(frozen=True)
class Rule:
    """Coefficients of every step (steps,), in 1/s; ``swing`` is a plain factor."""

    slope: Array
    now: Array
    before: Array
    swing: Array
    pull: Array  # of the acceleration with the new velocity
    adams: Array  # 1.0 for the rule of Adams and Moulton
    renewed: Array  # 1.0 where the tangents of the laws are computed anew


@lru_cache(maxsize=KEPT)
def alternate(step: float, pairs: int, begins: bool = True) -> Rule:
    """The coefficients of ``pairs`` of steps of ``step`` seconds.

    Where a record ``begins``, the very first step is a backward Euler one: it needs no acceleration to begin with.
    """
    trapezoidal, backward = np.tile([1.0, 0.0], pairs), np.tile([0.0, 1.0], pairs)
    euler = np.zeros(PAIR * pairs)
    if begins:
        euler[:1], trapezoidal[:1] = 1.0, 0.0
    slope = (euler + 2.0 * trapezoidal + 1.5 * backward) / step
    return Rule(
        slope=slope,
        now=-(euler + 2.0 * trapezoidal + 2.0 * backward) / step,
        before=0.5 * backward / step,
        swing=-trapezoidal,
        pull=slope,
        adams=np.zeros(slope.size),
        renewed=np.ones(slope.size),
    )


def multistep(step: float, first: int, count: int) -> Rule:
    """The coefficients of ``count`` steps of ``step`` seconds from the ``first`` of a record on."""
    begin, order = alternate(step, FILLED), np.arange(first, first + count)
    then: dict[str, float | Array] = {"slope": SPEED[0] / PLACE[0] / step, "pull": 1.0 / SPEED[0] / step, "adams": 1.0}
    then["renewed"] = np.where((order == FILLED) | (order % RENEWED == 0), 1.0, 0.0)

    def column(key: str) -> Array:
        early = getattr(begin, key)[np.minimum(order, FILLED)]
        return np.where(order < FILLED, early, then.get(key, 0.0))

    return Rule(*(column(each.name) for each in fields(Rule)))
