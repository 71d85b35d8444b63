"""Memory that is used again: what is asked for anew with every run is cleared by the system each time."""

from __future__ import annotations

import math
import threading

import numpy as np
from numpy.typing import NDArray


class Scratch(threading.local):
    """Arrays by name, of each thread its own; one that is taken again is overwritten."""

    def __init__(self) -> None:
        self._room: dict[str, NDArray[np.float64]] = {}

    def take(self, name: str, *shape: int) -> NDArray[np.float64]:
        """An array of this shape, not cleared."""
        size = math.prod(shape)
        room = self._room.get(name)
        if room is None or room.size < size:
            self._room[name] = room = np.empty(size)
        return room[:size].reshape(shape)
