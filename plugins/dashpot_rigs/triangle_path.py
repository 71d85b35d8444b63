"""Slow loops of constant speed with rounded corners."""

from __future__ import annotations

import numpy as np

from dashpot.contract.rig import PrescribedPath

LOST = 0.75  # of a corner's half width, by which it is shorter than a sharp one


def triangle_path(depth: float, speed: float, loops: int, corner: float, sample_time: float) -> PrescribedPath:
    """`loops` times from 0 to `depth` (m) and back at `speed` (m/s); within `corner` s of a turn the speed fades.

    There it is speed (3 u - u^3) / 2 with u = time to the turn / corner, so that the acceleration has no jump.
    """
    half = depth / speed + LOST * corner
    time = sample_time * np.arange(round(2.0 * loops * half / sample_time) + 1)
    count = np.minimum(np.floor(time / half), 2 * loops - 1)
    since = np.minimum(time - count * half, half)
    way, rate, second = _climb(since, half, corner)
    up = count % 2 == 0
    sign = np.where(up, speed, -speed)
    return PrescribedPath(np.where(up, 0.0, depth) + sign * way, sign * rate, sign * second)


def _climb(since: np.ndarray, half: float, corner: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Way over speed (s), speed over speed and its rate (1/s) of a climb from turn to turn."""
    if corner == 0.0:
        return since, np.ones_like(since), np.zeros_like(since)
    first, last = np.minimum(since / corner, 1.0), np.minimum((half - since) / corner, 1.0)
    way = since - corner * (_missing(first) + LOST / 2.0 - _missing(last))
    rate = 1.0 - (1.0 - _speed(first)) - (1.0 - _speed(last))
    return way, rate, (_rise(first) - _rise(last)) / corner


def _speed(u: np.ndarray) -> np.ndarray:
    return 0.5 * u * (3.0 - u**2)


def _rise(u: np.ndarray) -> np.ndarray:
    return 1.5 * (1.0 - u**2)


def _missing(u: np.ndarray) -> np.ndarray:
    """Integral of 1 - speed from 0 to u."""
    return u - 0.75 * u**2 + 0.125 * u**4
