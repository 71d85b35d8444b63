"""A soft beginning whose acceleration has no jump."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def smooth_step(time: Array, duration: float) -> tuple[Array, Array, Array]:
    """10 u^3 - 15 u^4 + 6 u^5 with u = time / duration between zero and one, its rate (1/s) and its second (1/s^2)."""
    if duration == 0.0:
        return np.ones_like(time), np.zeros_like(time), np.zeros_like(time)
    u = np.clip(time / duration, 0.0, 1.0)
    level = u**3 * (10.0 - 15.0 * u + 6.0 * u**2)
    rate = 30.0 * u**2 * (1.0 - u) ** 2 / duration
    second = 60.0 * u * (1.0 - u) * (1.0 - 2.0 * u) / duration**2
    return level, rate, second
