"""What is prepared of a run, kept as long as there is room."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Any, Generic, Protocol, TypeVar

ROOM = 40e6  # bytes


class Sized(Protocol):
    """Something that knows its bytes."""

    @property
    def nbytes(self) -> int:
        """Its bytes."""


Kept = TypeVar("Kept", bound=Sized)


class Shelf(Generic[Kept]):
    """Answers what ``make`` makes of a key: the first ones are kept until the room is full, others made anew each time.

    It costs a few nanoseconds a sample to prepare a run, so that large data take a little time instead of memory.
    """

    def __init__(self, make: Callable[[Any], Kept]) -> None:
        self._make, self._room = make, ROOM
        self._kept: dict[Hashable, Kept] = {}

    def __call__(self, key: Hashable) -> Kept:
        found = self._kept.get(key)
        if found is None:
            found = self._make(key)
            if found.nbytes <= self._room:
                self._room -= found.nbytes
                self._kept[key] = found
        return found
