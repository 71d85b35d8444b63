"""Dry friction that falls with speed."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response, State
from dashpot.model.picture import Symbol
from dashpot_elements.dahl import approach

TINY = 1e-12
SMALLEST = 1e-24  # (m/s)^2, of a discriminant


class Stribeck(Element):
    """A Dahl slider whose limit L falls with speed: dF/dx = stiffness |u|^exponent sgn(u), u = 1 - F/L sgn(v),
    L = limit + (breakaway - limit) exp(-|v/stribeck_velocity|^decay).

    A force above a limit that fell comes down with dF/dx = stiffness u, whatever the exponent. With bristle_damping,
    which adds bristle_damping u v while F is below the limit, and an exponent of one this is the LuGre model.

    The limit is frozen over a step at the mean speed; within the step the path may turn once or twice. Second order in
    the step.
    """

    picture = Symbol.SLIDER
    source = "Canudas de Wit et al., IEEE Trans. Automatic Control 40 (1995) 419"
    exact = False

    stiffness = Parameter("N/m", "slope of the unloaded slider", bounds=(1e-3, 1e12), symbol="sigma")
    limit = Parameter("N", "sliding force at high speed", bounds=(1e-6, 1e9), symbol="F_c")
    breakaway = Parameter("N", "sliding force at very low speed", bounds=(1e-6, 1e9), symbol="F_s")
    stribeck_velocity = Parameter("m/s", "speed over which the force falls", bounds=(1e-8, 1e3), symbol="v_s")
    decay = Parameter("1", "steepness of the fall", bounds=(0.5, 4.0), scale="linear", symbol="delta", default=2.0)
    exponent = Parameter(
        "1", "shape of the approach to sliding", bounds=(0.0, 4.0), scale="linear", symbol="i", default=1.0
    )
    bristle_damping = Parameter(
        "N*s/m",
        "damping of bristles that bend",
        bounds=(0.0, 1e11),
        scale="linear",
        symbol="sigma_1",
        default=0.0,
    )
    force = State("N", "force of the bent bristles")

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """Piece by piece between the places where the path turns."""
        path = _Path.of(x, dt)
        travels = [path.travel(begin, end) for begin, end in pairwise((0.0, *path.turns(), 1.0))]
        limit = _limit(sum(np.abs(travel) for travel in travels), p)
        force = z.force
        for travel in travels:
            force = _slide(force, dt * travel, limit, p)
        return Response(force + _damped(force, x.velocity_new, p), force=force)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the bristles, which bend as springs of the stiffness and slip for the rest of the way."""
        return 0.5 * z.force * z.force / p.stiffness


def _limit(speed: Any, p: Any) -> Any:
    ratio = np.maximum(speed / p.stribeck_velocity, TINY)
    return p.limit + (p.breakaway - p.limit) * np.exp(-np.exp(p.decay * np.log(ratio)))


def _slide(force: Any, travel: Any, limit: Any, p: Any) -> Any:
    side = np.where(travel < 0.0, -1.0, 1.0)
    way = p.stiffness * np.abs(travel) / limit
    distance = 1.0 - side * force / limit
    left = np.where(distance < 0.0, distance * np.exp(-way), approach(distance, way, p.exponent))
    return side * limit * (1.0 - left)


def _damped(force: Any, velocity: Any, p: Any) -> Any:
    """What the bristles resist while they bend; nothing from those that a limit which fell lets go."""
    distance = 1.0 - np.where(velocity < 0.0, -force, force) / _limit(np.abs(velocity), p)
    return p.bristle_damping * velocity * np.maximum(distance, 0.0)


@dataclass(frozen=True)
class _Path:
    """The velocity of a cubic path, first + slope u + bend u^2 over u = 0..1."""

    first: Any
    slope: Any
    bend: Any

    @classmethod
    def of(cls, x: Motion, dt: Any) -> _Path:
        bend = 3.0 * (x.velocity_old + x.velocity_new) - 6.0 * x.travel / dt
        return cls(x.velocity_old, x.velocity_new - x.velocity_old - bend, bend)

    def turns(self) -> tuple[Any, Any]:
        """Where the velocity changes its sign, in order; outside of the step it is at its begin or its end."""
        square = self.slope * self.slope - 4.0 * self.bend * self.first
        root = np.sqrt(np.maximum(square, SMALLEST))
        half = -0.5 * (self.slope + np.where(self.slope < 0.0, -root, root))
        far = half / np.where(self.bend == 0.0, SMALLEST, self.bend)
        places = [np.where(square > SMALLEST, np.clip(place, 0.0, 1.0), 1.0) for place in (self.first / half, far)]
        return np.minimum(*places), np.maximum(*places)

    def travel(self, begin: Any, end: Any) -> Any:
        """Of a piece, over the duration of the step."""
        squares = begin * begin + begin * end + end * end
        return (end - begin) * (self.first + 0.5 * self.slope * (begin + end) + self.bend * squares / 3.0)
