"""Points that fill the unit cube evenly in every coordinate."""

from __future__ import annotations

import numpy as np


def latin_hypercube(rng: np.random.Generator, points: int, size: int) -> np.ndarray:
    """Random points (points, size): each of `points` equal intervals of each coordinate holds exactly one."""
    slots = rng.permuted(np.tile(np.arange(points), (size, 1)), axis=1).T
    return (slots + rng.random((points, size))) / points


def scatter(rng: np.random.Generator, points: int, start: np.ndarray) -> np.ndarray:
    """The start, then a Latin hypercube: (points, n)."""
    return np.vstack([start, latin_hypercube(rng, points - 1, len(start))]) if points > 1 else start[None, :]
