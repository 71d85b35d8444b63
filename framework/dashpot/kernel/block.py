"""Lanes that run together, and their memory."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
LINE = 8  # numbers in a cache line


@dataclass(frozen=True, eq=False)
class Block:
    """``count`` lanes from ``first`` on, padded to ``width``: their tables, their workspace before the first sample."""

    first: int
    count: int
    width: int
    tables: Array
    workspace: Array

    @property
    def place(self) -> slice:
        """Where the lanes stand among all lanes."""
        return slice(self.first, self.first + self.count)

    def fresh_workspace(self) -> Array:
        """A workspace to run in."""
        return aligned_copy(self.workspace)


def aligned_copy(numbers: Array) -> Array:
    """A copy that begins at a cache line: vectors that cross lines take twice the time."""
    room = np.empty(numbers.size + LINE)
    first = -room.ctypes.data // room.itemsize % LINE
    copy = room[first : first + numbers.size]
    copy[:] = numbers
    return copy
