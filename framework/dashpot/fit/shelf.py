"""What is prepared of a run, kept as long as there is room."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Any, Generic, Protocol, TypeVar

ROOM = 40e6  # bytes
TIMES_FOR_STEPS = 3.0  # the room of what takes a microsecond and more to prepare a sample


class Sized(Protocol):
    """Something that knows its bytes."""

    @property
    def nbytes(self) -> int:
        """Its bytes."""


Kept = TypeVar("Kept", bound=Sized)


class Shelf(Generic[Kept]):
    """Answers what ``make`` makes of a key: the first ones are kept until the room is full, others made anew each time.

    It costs a few nanoseconds a sample to prepare a run, so that large data take a little time instead of memory. What
    is kept may grow as it is used. There is so many ``times`` the usual room.
    """

    def __init__(self, make: Callable[[Any], Kept], times: float = 1.0) -> None:
        self._make, self._room = make, times * ROOM
        self._kept: dict[Hashable, Kept] = {}

    def __call__(self, key: Hashable) -> Kept:
        found = self._kept.get(key)
        if found is None:
            found = self._make(key)
            if found.nbytes + sum(other.nbytes for other in list(self._kept.values())) <= self._room:
                self._kept[key] = found
        return found
