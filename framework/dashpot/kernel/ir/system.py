"""The program of a network with unknown nodes.

The equilibrium is found first: ``start``, then ``settle`` until every lane is done, then ``rest``; the first sample is
``launch`` until every lane is done, then ``set_off``. Then every sample is
reached twice, in few long steps and in twice as many short ones: their difference tells the error and takes its leading
term away (Richardson). A step is ``predict``, then ``improve`` until every lane is done, ``search`` for those that it
leaves, then ``commit``.

Where there is a pass ``turn``, records may also be run ``quick``: the steps are such that an edge may turn within one,
and then ``turn`` follows ``predict``; and where the tangents of before do, ``correct`` comes before ``improve``. Their
order is high, and the forces are those of the short steps; the long ones only tell the error, and are left out where
nobody asks for it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from dashpot.kernel.ir.layout import Layout
from dashpot.kernel.ir.program import Program

MOST_CORRECTIONS, MOST_STEPS, MOST_PLACES, MOST_STATIC_STEPS = 2, 12, 1000, 400
UNSOLVED, UNBALANCED = 1, 2
THIRD = 0.3333333333333333
TOLERANCE, FARTHEST, SMALLEST_SPAN = 1e-6, 2.0, 1e-3  # of Newton's steps: shares of the span of the motion, and m


@dataclass(frozen=True, eq=False)
class SystemProgram:
    """The passes by name in the order in which they run, and the names of some rows of the workspace.

    ``forces`` are the rows of the forces at the driven nodes, ``places`` those of the positions of the unknown ones;
    ``done`` tells whether Newton's method has ended. ``known`` are the symbols that the drive gives. ``turns`` tells
    whether an edge turns in this step, ``kept`` whether the tangents of before do, ``pace`` how quick the quickest node
    was; where nothing may be run quick there is none of them.
    """

    program: Program
    passes: Mapping[str, Layout]
    forces: Sequence[str]
    places: Sequence[str]
    done: str
    known: frozenset[str]
    turns: str | None = None
    kept: str | None = None
    pace: str | None = None

    @property
    def rows(self) -> int:
        """How many rows the workspace needs."""
        return len(self.program.constants) + len(self.program.states)

    def row(self, name: str) -> int:
        """The number of a row."""
        return next(iter(self.passes.values())).states[name]
