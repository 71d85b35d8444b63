"""A valve with a column of oil in front of it."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.model.element import Element, Motion, Parameter, Response
from dashpot.model.picture import Series, Symbol
from dashpot_elements.behind_spring import memory, pressed

STEPS = 2  # of Householder's method of third order: 6e-9 of the force, 5e-8 of the velocity of the flow
TINY = 1e-30


class Valve(Element):
    """A valve that opens at a knee, in series with a spring: F = g(v - F'/stiffness),
    g = opened w + (damping - opened) w/(1 + |w/knee|^sharpness)^(1/sharpness).

    w is the velocity of the flow through the valve. Below the knee velocity the slope is `damping`, far above it
    `opened` (blow-off); without `opened` the force approaches damping times knee (digressive). Compression and rebound
    have numbers of their own. With a sharpness of 1 the force at the knee is half of that of the straight line; with a
    large one it is a line with a kink. `stiffness` is that of oil, hoses and mounts, of the gas in the oil: it lets the
    force lag behind the velocity, so that the curve of force over velocity opens to a loop.

    One step follows TR-BDF2, of second order in the step; its equation is solved by Householder's method from between
    the solutions for the gentlest and for the sharpest knee.
    """

    picture = Series(Symbol.SPRING, Symbol.DASHPOT)
    source = "Hosea and Shampine, Applied Numerical Mathematics 20 (1996) 21, for TR-BDF2"
    exact = False

    stiffness = Parameter("N/m", "stiffness in series", bounds=(1e-3, 1e12), symbol="k")
    compression = Parameter("N*s/m", "damping in compression below the knee", bounds=(1e-4, 1e11), symbol="d_c")
    rebound = Parameter("N*s/m", "damping in rebound below the knee", bounds=(1e-4, 1e11), symbol="d_r")
    compression_knee = Parameter("m/s", "velocity at which it opens in compression", bounds=(1e-8, 1e3), symbol="v_c")
    rebound_knee = Parameter("m/s", "velocity at which it opens in rebound", bounds=(1e-8, 1e3), symbol="v_r")
    compression_opened = Parameter(
        "N*s/m",
        "slope far above the knee in compression, at most its damping",
        bounds=(0.0, 1e11),
        scale="linear",
        symbol="b_c",
        default=0.0,
    )
    rebound_opened = Parameter(
        "N*s/m",
        "slope far above the knee in rebound, at most its damping",
        bounds=(0.0, 1e11),
        scale="linear",
        symbol="b_r",
        default=0.0,
    )
    sharpness = Parameter("1", "how suddenly it opens", bounds=(1.0, 8.0), scale="linear", symbol="m", default=1.0)
    load, speed = memory()

    def step(self, x: Motion, z: Any, p: Any, dt: Any) -> Response:
        """Spring and valve together."""

        def law(given: Any, rate: Any) -> tuple[Any, Any]:
            outward = given < 0.0
            damping = np.where(outward, p.rebound, p.compression)
            knee = np.where(outward, p.rebound_knee, p.compression_knee)
            opened = np.minimum(np.where(outward, p.rebound_opened, p.compression_opened), damping)
            return _flow(given, rate, damping - opened, knee, opened, p.sharpness)

        return pressed(x, z, p.stiffness, dt, law)

    def stored(self, x: Motion, z: Any, p: Any) -> Any:
        """The energy of the spring."""
        return 0.5 * z.load * z.load / p.stiffness


def _flow(given: Any, rate: Any, closing: Any, knee: Any, opened: Any, sharpness: Any) -> tuple[Any, Any]:
    """Force and velocity at which the force and rate times the velocity are ``given``.

    In r = |w|/knee: (rate + opened) r + closing r/(1 + r^m)^(1/m) = |given|/knee. The root falls with m: for m = 1 it
    is that of a quadratic equation, for a kink where one of the asymptotes meets the right side.
    """
    size, straight = np.abs(given) / knee, rate + opened
    gentle = _gentle(size, straight, closing)
    kinked = np.maximum(size / (straight + closing), (size - closing) / straight)
    ratio = np.where(sharpness == 1.0, gentle, _between(kinked, gentle, size, straight, closing, sharpness))
    speed = knee * np.where(given < 0.0, -ratio, ratio)
    return given - rate * speed, speed


def _gentle(size: Any, straight: Any, closing: Any) -> Any:
    # straight r^2 + level r = size, whichever form of the root has no difference of equal numbers
    level = straight + closing - size
    root = np.sqrt(level * level + 4.0 * straight * size)
    high = level > 0.0
    return np.where(high, 2.0 * size, root - level) / np.where(high, level + root, 2.0 * straight)


def _between(kinked: Any, gentle: Any, size: Any, straight: Any, closing: Any, sharpness: Any) -> Any:
    low, high = np.log(np.maximum(kinked, TINY)), np.log(np.maximum(gentle, TINY))
    place = low + (high - low) / sharpness  # the logarithm of the ratio
    for _ in range(STEPS):
        power = np.exp(sharpness * place)
        part = 1.0 / (1.0 + power)
        rest = sharpness * power * part
        free, carried = straight * np.exp(place), closing * np.exp(place - np.log(1.0 + power) / sharpness)
        # the force less what is given, and its derivatives with the logarithm of the ratio
        excess, first = free + carried - size, carried * part
        second = first * (part - rest)
        third = second * (part - rest) - first * rest * part * (1.0 + sharpness)
        place = place - _householder(excess, free + first, free + second, free + third)
    return np.exp(place)


def _householder(value: Any, slope: Any, bend: Any, turn: Any) -> Any:
    """By how much a root lies lower, from a value and its first three derivatives."""
    steep = slope * slope - 0.5 * value * bend
    return value * steep / (slope * (steep - 0.5 * value * bend) + value * value * turn / 6.0)
