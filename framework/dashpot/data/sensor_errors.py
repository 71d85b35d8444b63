"""How the errors that a data sheet admits show in a force channel."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def error_shapes(force: Array, dt: float) -> dict[str, Array]:
    """The change of a force (n,) N under an error of unit size: a gain of 1, a zero of 1 N, a delay of 1 s."""
    return {"gain": force, "zero": np.ones(force.size), "delay": -np.gradient(force, dt)}
