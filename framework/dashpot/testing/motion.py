"""Random motions of the two ends of a specimen."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive, drive_from_samples

Array = NDArray[np.float64]

NOISE = 2e-4
PARTS = 6


def random_drive(
    rng: np.random.Generator, kind: str, length: float, time: float, samples: int = 300, dt: float | None = None
) -> Drive:
    """A motion of one of the ``MOTIONS`` from rest at zero deflection.

    ``length`` (m) is about its amplitude, ``time`` (s) that of its fastest part by 2 pi; the sample time is a fraction
    of it unless it is given.
    """
    dt = time / 12.0 if dt is None else dt
    t = np.arange(samples, dtype=np.float64) * dt
    begin = np.minimum(t / t[-1] * 8.0, 1.0)
    gently = begin**3 * (begin * (6.0 * begin - 15.0) + 10.0)
    path: Array = length * gently * MOTIONS[kind](rng, t, 1.0 / time)
    return drive_from_samples(dt, path, smooth=kind == "noisy")


def _sweep(rng: np.random.Generator, t: Array, fastest: float) -> Array:
    slowest = fastest * rng.uniform(0.02, 0.2)
    return np.sin((slowest + (fastest - slowest) * t / (2.0 * t[-1])) * t + rng.uniform(0.0, 6.3))


def _multisine(rng: np.random.Generator, t: Array, fastest: float) -> Array:
    speeds = fastest * rng.uniform(0.02, 1.0, PARTS)
    parts = np.sin(np.outer(speeds, t) + rng.uniform(0.0, 6.3, (PARTS, 1)))
    return rng.uniform(-1.0, 1.0, PARTS) @ parts / np.sqrt(PARTS) + rng.uniform(-0.3, 0.3)


def _noisy(rng: np.random.Generator, t: Array, fastest: float) -> Array:
    return _multisine(rng, t, fastest) + NOISE * rng.standard_normal(t.size)


def _dwelling(rng: np.random.Generator, t: Array, fastest: float) -> Array:
    # ramps between places where nothing moves
    return np.clip(1.4 * _sweep(rng, t, 0.4 * fastest), -0.8, 0.9)


MOTIONS: dict[str, Callable[[np.random.Generator, Array, float], Array]] = {
    "sweep": _sweep,
    "multisine": _multisine,
    "noisy": _noisy,
    "dwelling": _dwelling,
}
