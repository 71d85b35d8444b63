"""How long something will still take, at the pace so far."""

from __future__ import annotations

import time
from collections.abc import Callable


class Pace:
    """Told from time to time what share of the work is done; a smaller share than before begins a new piece of work."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._first = self._last = (clock(), 0.0)

    @property
    def share(self) -> float:
        """The share that was told last."""
        return self._last[1]

    def note(self, share: float | None) -> None:
        """Hear of the share in [0, 1] that is done; None says nothing about it."""
        if share is None:
            return
        now = (self._clock(), min(max(share, 0.0), 1.0))
        if now[1] < self.share:
            self._first = now
        if now[1] != self.share:
            self._last = now

    def left(self) -> float | None:
        """The time left in s; None as long as there is nothing to tell it from."""
        (began, before), (then, done) = self._first, self._last
        if done <= before:
            return None
        whole = (then - began) * (1.0 - done) / (done - before)
        return max(0.0, whole - (self._clock() - then))


def shown_left(seconds: float | None) -> str:
    """`2:05 left`; `-:-- left` where it is not known."""
    if seconds is None:
        return "-:-- left"
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02d}:{rest:02d} left" if hours else f"{minutes}:{rest:02d} left"
