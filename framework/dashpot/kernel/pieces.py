"""What drives a network with unknown nodes: the steps of a record, piece by piece."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from dashpot.data.excitation import Excitation
from dashpot.kernel.scheme import PAIR

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Piece:
    """Samples ``first`` up to ``end`` of a record, and what drives the steps that lead to them."""

    first: int
    end: int
    coarse: Array
    fine: Array


@dataclass(frozen=True, eq=False)
class SystemRows:
    """The part of the work on a run that depends on its excitation alone; pieces may be gone through again.

    ``quick`` ones have steps of high order, for lanes that are slow enough for them; None: the network has none.
    """

    excitation: Excitation
    pairs: int
    still: Array
    pieces: Iterable[Piece]
    quick: Iterable[Piece] | None

    @property
    def nbytes(self) -> int:
        """The bytes that stay prepared for the steps which are taken first."""
        first = self.quick or self.pieces
        return first.nbytes if isinstance(first, Pieces) else 0

    def steps(self, quick: bool) -> int:
        """How many long steps lie in a sample."""
        return self.pairs if quick else PAIR * self.pairs


@dataclass(frozen=True, eq=False)
class Pieces:
    """The pieces of a record, made when they are asked for; those of a short one are ``kept``.

    Each has ``size`` samples but the first one, which has ``begin``, and the last one.
    """

    samples: int
    begin: int
    size: int
    kept: bool
    make: Callable[[int, int], Piece]

    @property
    def nbytes(self) -> int:
        """The bytes of what stays prepared."""
        return sum(piece.coarse.nbytes + piece.fine.nbytes for piece in self._all) if self.kept else 0

    def __iter__(self) -> Iterator[Piece]:
        return iter(self._all) if self.kept else self._made()

    @cached_property
    def _all(self) -> tuple[Piece, ...]:
        return tuple(self._made())

    def _made(self) -> Iterator[Piece]:
        first, end = 0, self.begin
        while first < self.samples:
            end = min(end, self.samples)
            yield self.make(first, end)
            first, end = end, end + self.size


@dataclass(frozen=True, eq=False)
class Changed:
    """Pieces with a ``change``, which is made each time they are gone through."""

    pieces: Iterable[Piece]
    change: Callable[[Piece], Piece]

    def __iter__(self) -> Iterator[Piece]:
        return map(self.change, self.pieces)
