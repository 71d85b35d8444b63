"""Groups of lanes that run together, and their memory."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
LINE = 8  # numbers in a cache line


@dataclass(frozen=True, eq=False)
class Block:
    """``count`` lanes from ``first`` on: their tables, their workspace before the first sample."""

    first: int
    count: int
    tables: Array
    workspace: Array

    @property
    def place(self) -> slice:
        """Where the lanes stand among all lanes."""
        return slice(self.first, self.first + self.count)

    def fresh_workspace(self) -> Array:
        """A workspace to run in."""
        return aligned_copy(self.workspace)


def blocks_of(tables: Array, workspace: Array, width: int) -> Iterator[Block]:
    """Blocks of ``width`` lanes, from arrays whose last axis counts the lanes."""
    count = workspace.shape[-1]
    for number, own in enumerate(zip(grouped(tables, width), grouped(workspace, width), strict=True)):
        yield Block(number * width, min(width, count - number * width), *own)


def grouped(numbers: Array, width: int) -> Array:
    """Numbers (..., lanes) as (groups, ..., width), the last lane repeated until the last group is full."""
    missing = -numbers.shape[-1] % width
    full = np.concatenate([numbers, np.repeat(numbers[..., -1:], missing, axis=-1)], axis=-1)
    parts = full.reshape(*full.shape[:-1], full.shape[-1] // width, width)
    return aligned_copy(np.moveaxis(parts, -2, 0))


def aligned_copy(numbers: Array) -> Array:
    """A copy that begins at a cache line: vectors that cross lines take twice the time."""
    room = np.empty(numbers.size + LINE)
    first = -room.ctypes.data // room.itemsize % LINE
    copy = room[first : first + numbers.size].reshape(numbers.shape)
    copy[...] = numbers
    return copy
