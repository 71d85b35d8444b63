"""What comes of solving a network with unknown nodes."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from dashpot.kernel.ir.system import UNBALANCED, UNSOLVED

Array = NDArray[np.float64]

HALVED = 3.0  # times the error of the short steps is that by which the long ones differ, at an order of two


class Status(Enum):
    """How a lane ended; the value is the message."""

    GOOD = "solved"
    UNSOLVED = "the forces at the inner nodes could not be balanced in some step"
    UNBALANCED = "no static equilibrium was found at the begin of the record"
    NOT_FINITE = "a force is not a finite number"


_CODES = {0: Status.GOOD, UNSOLVED: Status.UNSOLVED, UNBALANCED: Status.UNBALANCED}


def status_of(code: float, answer: Array) -> Status:
    """How a lane ended, from the code of the kernel and what it answered."""
    return _CODES[int(code)] if np.isfinite(answer).all() else Status.NOT_FINITE


@dataclass(frozen=True, eq=False)
class Solution:
    """Forces (lanes, driven nodes, samples) in N and motions (lanes, unknown nodes, samples) in m, of the nodes named.

    ``error`` (lanes, driven nodes) in N is the estimated root mean square error of the forces, from halving the steps;
    it is that of the short steps, also where their leading error is taken away. ``status`` is one for each lane.
    """

    driven: tuple[str, ...]
    unknown: tuple[str, ...]
    force: Array
    motion: Array
    error: Array
    status: tuple[Status, ...]

    @property
    def solved_force(self) -> Array:
        """The forces; NaN in lanes that failed."""
        failed = np.array([status is not Status.GOOD for status in self.status])
        return np.where(failed[:, None, None], np.nan, self.force) if failed.any() else self.force
