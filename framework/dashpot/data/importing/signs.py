"""Which way round displacement and force are: a specimen takes up work, and is mostly pressed."""

from __future__ import annotations

import numpy as np

from dashpot.data.importing.correlation import correlation

_CLEAR, _PRESSED = 0.1, 0.5


def find_signs(displacement: np.ndarray, force: np.ndarray) -> tuple[int, int, str]:
    """Signs of displacement and force, and why, where one of them is to be turned.

    Raw numbers of both (n,). The force goes with the velocity, as work is lost, else with the displacement. A force
    that nearly always pulls is taken for one whose tension counts positive.
    """
    loss, slope = correlation(np.gradient(displacement), force), correlation(displacement, force)
    opposed = loss < 0 if abs(loss) > _CLEAR else slope < 0
    sign = -1 if opposed else 1
    pulled = np.mean(sign * force) < -_PRESSED * np.max(np.abs(force))
    if pulled:
        return -1, -sign, "the force pulls nearly all the time: compression seems to count negative here"
    if opposed:
        return 1, -1, "the force points against the motion as if work were given back: its sign is turned"
    return 1, 1, ""
