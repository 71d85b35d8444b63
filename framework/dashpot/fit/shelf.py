"""What is prepared of runs, kept as long as there is room."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable
from threading import Lock
from typing import Generic, Protocol, TypeVar

ROOM = 40e6  # bytes
TIMES_FOR_STEPS = 3.0  # the room of what takes a microsecond and more to prepare a sample


class Sized(Protocol):
    """Something that knows its bytes."""

    @property
    def nbytes(self) -> int:
        """Its bytes."""


Kept = TypeVar("Kept", bound=Sized)


class Shelf(Generic[Kept]):
    """Keeps what was made of a kind for a key. What has no room is made anew each time.

    It takes a few nanoseconds a sample to prepare a run, so that large data take a little time instead of memory. Room
    is made by letting go of the kinds that were asked for longest ago, and never of the one that is asked for: of runs
    that do not all have room the first ones stay. What is kept may grow as it is used. There is so many ``times`` the
    usual room.
    """

    def __init__(self, times: float = 1.0) -> None:
        self._room = times * ROOM
        self._kinds: OrderedDict[Hashable, dict[Hashable, Kept]] = OrderedDict()
        self._bytes: dict[Hashable, int] = {}
        self._lock = Lock()  # several threads prepare runs of one network

    def __call__(self, kind: Hashable, key: Hashable, make: Callable[[], Kept]) -> Kept:
        with self._lock:
            known = self._kinds.setdefault(kind, {})
            self._kinds.move_to_end(kind)
            found = known.get(key)
        if found is None:
            found = make()
            with self._lock:
                self._keep(kind, key, found)
        return found

    def kept(self, kind: Hashable) -> list[Kept]:
        """What is kept of a kind."""
        with self._lock:
            return list(self._kinds.get(kind, {}).values())

    def clear(self) -> None:
        """Keep nothing any more."""
        with self._lock:
            self._kinds.clear()
            self._bytes.clear()

    def _keep(self, kind: Hashable, key: Hashable, made: Kept) -> None:
        own = self._kinds.setdefault(kind, {})
        self._bytes[kind] = sum(one.nbytes for one in own.values())
        while sum(self._bytes.values()) + made.nbytes > self._room and (oldest := next(iter(self._kinds))) != kind:
            del self._kinds[oldest]
            self._bytes.pop(oldest, None)
        if self._bytes[kind] + made.nbytes <= self._room:
            own[key] = made
            self._bytes[kind] += made.nbytes
