"""The lines of a text: a long file is kept as its bytes, and becomes strings block by block."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import overload

import numpy as np

# what an encoding may let through that UTF-8 has no place for
LONE = "surrogatepass"
# bytes of a block: some thousand lines, so that a step over a block costs next to nothing
_BLOCK = 1 << 18
# bytes that are looked through for line ends at a time
_PIECE = 1 << 24


class Lines(Sequence[str]):
    """The lines of a text in UTF-8 whose lines end with a line feed, as ``text.split("\\n")`` would give them.

    A list of them takes ten times the memory of a short number, and is passed through faster than this; iterate, or
    go through ``blocks``, where there may be many.
    """

    def __init__(self, text: bytes) -> None:
        self._text = text
        ends = [
            start + np.flatnonzero(np.frombuffer(text[start : start + _PIECE], dtype=np.uint8) == ord("\n"))
            for start in range(0, len(text), _PIECE)
        ]
        # where each line begins, and where one behind the last would
        self._starts = np.concatenate([[0], *(found + 1 for found in ends), [len(text) + 1]])

    def __len__(self) -> int:
        return self._starts.size - 1

    @overload
    def __getitem__(self, index: int) -> str: ...
    @overload
    def __getitem__(self, index: slice) -> list[str]: ...
    def __getitem__(self, index: int | slice) -> str | list[str]:
        if isinstance(index, slice):
            chosen = range(len(self))[index]
            plain = chosen.step == 1 and len(chosen) > 0
            return self._between(chosen.start, chosen.stop) if plain else [self[number] for number in chosen]
        number = range(len(self))[index]
        return self._between(number, number + 1)[0]

    def __iter__(self) -> Iterator[str]:
        for _, block in self.blocks():
            yield from block

    def blocks(self, first: int = 0) -> Iterator[tuple[int, list[str]]]:
        """All lines from ``first`` (from 0) on in blocks, each with the number of its first line."""
        while first < len(self):
            behind = int(np.searchsorted(self._starts, self._starts[first] + _BLOCK))
            last = min(max(behind, first + 1), len(self))
            yield first, self._between(first, last)
            first = last

    def without_first(self, count: int) -> Lines:
        """The same lines, the first ones empty: numbers of lines stay what they are."""
        count = min(count, len(self))
        return Lines(b"\n" * count + self._text[self._starts[count] :]) if count else self

    def _between(self, first: int, last: int) -> list[str]:
        start, stop = self._starts[first], self._starts[last] - 1
        return self._text[start:stop].decode("utf-8", LONE).split("\n")
