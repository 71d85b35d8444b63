"""How lanes go through a record: by which steps, and what becomes of the long and the short ones."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.kernel.block import Block
from dashpot.kernel.pieces import Piece, SystemRows

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Course:
    """``quick`` are steps of high order. The ``code`` is for the kernel: 0 where the forces are those of the short
    steps with the error taken away that the long ones tell, 1 where they are those of the short ones as they are, 2
    where there are no others. With ``fewer`` the long steps are taken in place of the short ones.
    """

    quick: bool
    code: int
    fewer: bool = False

    def pieces(self, run: SystemRows) -> Iterable[Piece]:
        """What drives the steps."""
        return (run.quick if self.quick else None) or run.pieces

    def columns(self, piece: Piece) -> tuple[Array, Array]:
        """What drives the long and the short steps to some samples."""
        return piece.coarse, piece.coarse if self.fewer else piece.fine

    def steps(self, run: SystemRows) -> int:
        """How many long steps lie in a sample, half as many as short ones."""
        return run.steps(self.quick) // (2 if self.fewer else 1)


@dataclass(frozen=True, eq=False)
class Marched:
    """What came of a block of lanes: answers (lanes, ...), squared ``miss`` (lanes, driven nodes), codes (lanes,).

    ``blocks`` are as they were after the last sample.
    """

    out: Array
    miss: Array
    status: Array
    blocks: tuple[Block, ...]

    def replaced(self, lanes: NDArray[np.bool_], other: Marched) -> Marched:
        """The same with those of another march for some ``lanes``."""
        for own, new in ((self.out, other.out), (self.miss, other.miss), (self.status, other.status)):
            own[lanes] = new
        return self


EXTRAPOLATED = Course(quick=False, code=0)
QUICK, QUICK_ALONE = Course(quick=True, code=1), Course(quick=True, code=2)
LONG_ALONE = Course(quick=False, code=2, fewer=True)
