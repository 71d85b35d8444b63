"""The rows of a Jacobian that was asked for last: steps, intervals and bootstrap ask for the same ones several times.

A network with unknown nodes takes a thousand times as long to simulate as its forces take to copy.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Key = TypeVar("Key", bound=Hashable)
Rows = tuple[int, Array]

ROOM = 64e6  # bytes of all that is kept


class LastMoved(Generic[Key]):
    """For each of so many keys the numbered rows (1 + k, n) at the last ``values``, with the last ``moves`` (k, slots).

    Of other moves at the same values only those are made that are not among the first of the kept ones. A key whose
    rows take more than its share of the room has them made anew each time.
    """

    def __init__(self, keys: int) -> None:
        self._room = ROOM / max(keys, 1)
        self._kept: dict[Key, tuple[Array, Array, list[Rows]]] = {}

    def __call__(
        self, key: Key, values: Array, moves: Array, make: Callable[[Array], Iterable[Rows]]
    ) -> Iterator[Rows]:
        """The rows of a key, which may be altered; ``make`` makes those of some moves."""
        known = self._kept.get(key)
        same = _same(known, values, moves)
        if known is None or same < len(moves):
            made = list(make(moves[same:]))
            if known is not None and same:
                made = [
                    (number, np.concatenate([rows[: 1 + same], more[1:]]))
                    for (number, rows), (_, more) in zip(known[2], made, strict=True)
                ]
            if sum(rows.nbytes for _, rows in made) > self._room:
                if not same:
                    self._kept.pop(key, None)
                yield from made
                return
            known = self._kept[key] = values.copy(), moves.copy(), made
        for number, rows in known[2]:
            yield number, rows[: 1 + len(moves)].copy()


def _same(known: tuple[Array, Array, list[Rows]] | None, values: Array, moves: Array) -> int:
    """How many of the moves are the first ones that are known at the same values."""
    if known is None or not np.array_equal(known[0], values):
        return 0
    count = min(len(known[1]), len(moves))
    other = np.flatnonzero((known[1][:count] != moves[:count]).any(axis=1))
    return int(other[0]) if other.size else count
