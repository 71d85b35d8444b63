"""A damped mass on a spring, moved exactly along the cubic path between two samples."""

from __future__ import annotations

from dataclasses import dataclass
from math import factorial
from typing import Any

import numpy as np

from dashpot.model.element import Motion

DOUBLINGS = 18
Pair = tuple[Any, Any]


def slowed(speed: Any, turbulence: Any) -> Any:
    """A speed after a while of quadratic damping alone."""
    return speed / (1.0 + turbulence * np.abs(speed))


@dataclass(frozen=True)
class Swinging:
    """Z = [[0, -1], [stiff, -damped]], which moves (place, speed dt) over a step: y' = Z y + (share, drag) v dt.

    As Z^2 = -stiff I - damped Z, every function of Z is a pair (a, b) that stands for a I + b Z.
    """

    damped: Any
    stiff: Any

    def product(self, f: Pair, g: Pair) -> Pair:
        """The product of two functions."""
        twice = f[1] * g[1]
        return f[0] * g[0] - self.stiff * twice, f[0] * g[1] + f[1] * g[0] - self.damped * twice

    def apply(self, f: Pair, place: Any, shift: Any) -> Pair:
        """A function of Z on a vector."""
        return f[0] * place - f[1] * shift, f[1] * (self.stiff * place) + (f[0] - self.damped * f[1]) * shift

    def moments(self) -> list[Pair]:
        """integral of w^j exp(Z w) over w = 0..1 for j = 0, 1, 2: by its series for a small part of Z, then doubled.

        It needs no difference of near numbers, whether the mass swings, creeps, or stands between both.
        """
        part = 0.5**DOUBLINGS
        square = -part * part * self.stiff, -part * part * self.damped
        powers = (1.0, 0.0), (0.0, part), square, self.product((0.0, part), square)
        found = [
            _sum(*(_sum(power, times=1.0 / (factorial(n) * (n + j + 1))) for n, power in enumerate(powers)))
            for j in range(3)
        ]
        for number in range(DOUBLINGS):
            found = self._doubled(found, 2.0**number * part)
        return found

    def _doubled(self, moments: list[Pair], part: float) -> list[Pair]:
        # the second half of the way holds exp(Z w) of the first one, times 1 + growth
        none, one, two = moments
        growth = self.product((0.0, part), none)
        late = none, _sum(one, none), _sum(two, one, one, none)
        return [
            _sum(early, later, self.product(growth, later), times=0.5 ** (j + 1))
            for j, (early, later) in enumerate(zip(moments, late, strict=True))
        ]

    def moved(self, memory: Pair, x: Motion, dt: Any, share: Any = 1.0, drag: Any = 0.0) -> Pair:
        """The memory after a step along the cubic path, whose velocity moves the place and drags the speed."""
        moments = self.moments()
        bow = 6.0 * (x.travel - 0.5 * dt * (x.velocity_old + x.velocity_new))
        # backwards from the end, with w = 1 - u, the travel is that of v_new + (v_old - v_new + bow/dt) w - bow/dt w^2
        ways = dt * x.velocity_new, dt * (x.velocity_old - x.velocity_new) + bow, -bow
        growth = self.product((0.0, 1.0), moments[0])
        pushes = [self.apply(moment, share * way, drag * way) for moment, way in zip(moments, ways, strict=True)]
        return _sum(memory, self.apply(growth, *memory), *pushes)


def _sum(*pairs: Pair, times: float = 1.0) -> Pair:
    return times * sum(pair[0] for pair in pairs), times * sum(pair[1] for pair in pairs)
