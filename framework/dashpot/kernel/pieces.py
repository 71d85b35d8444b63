"""What drives a network with unknown nodes: the steps of a record, piece by piece."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field

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
        """The bytes of what is prepared so far, or at least of the steps that are taken first."""
        made = [pieces for pieces in (self.quick, self.pieces) if isinstance(pieces, Pieces)]
        return max(sum(pieces.nbytes for pieces in made), made[0].expected if made else 0)

    def steps(self, quick: bool) -> int:
        """How many long steps lie in a sample."""
        return self.pairs if quick else PAIR * self.pairs


@dataclass(frozen=True, eq=False)
class Pieces:
    """The pieces of a record, each made when it is asked for; those of a short record are ``kept``.

    Each has ``size`` samples but the first one, which has ``begin``, and the last one. A sample takes ``weight`` bytes.
    """

    samples: int
    begin: int
    size: int
    weight: int
    kept: bool
    make: Callable[[int, int], Piece]
    _made: dict[int, Piece] = field(default_factory=dict)

    @property
    def nbytes(self) -> int:
        """The bytes of what stays prepared."""
        return sum(piece.coarse.nbytes + piece.fine.nbytes for piece in self._made.values())

    @property
    def expected(self) -> int:
        """The bytes that stay prepared once the whole record was gone through."""
        return self.samples * self.weight if self.kept else 0

    def __iter__(self) -> Iterator[Piece]:
        first, end = 0, self.begin
        while first < self.samples:
            end = min(end, self.samples)
            yield self._piece(first, end)
            first, end = end, end + self.size

    def _piece(self, first: int, end: int) -> Piece:
        if not self.kept:
            return self.make(first, end)
        if first not in self._made:
            self._made[first] = self.make(first, end)
        return self._made[first]


@dataclass(frozen=True, eq=False)
class Changed:
    """Pieces with a ``change``, which is made each time they are gone through."""

    pieces: Iterable[Piece]
    change: Callable[[Piece], Piece]

    def __iter__(self) -> Iterator[Piece]:
        return map(self.change, self.pieces)
