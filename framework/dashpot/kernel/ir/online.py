"""The program of a network that somebody else steps: one lane, one sample at a time, all its memory in one array.

The array holds, one after the other: the step that the constants were made for, how far the run is, how it went, the
span of the motion, how many steps of high order were taken, the inputs, the outputs, the inputs of the sample before,
the followers, the motion within a step, the rows of one or two workspaces, and the tables.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from dashpot.expr.node import symbols_of
from dashpot.kernel.ir.layout import Shelf
from dashpot.kernel.ir.program import Program
from dashpot.kernel.ir.system import SystemProgram

DT, BEGUN, STATUS, SPAN, STEPS, INPUTS = range(6)
MOTION = ("x", "v", "a")
NOT_FINITE = 3  # as a status: a force that is no finite number
POWERS = 4  # coefficients of a cubic


@dataclass(frozen=True, eq=False)
class Online:
    """``driven`` nodes have a displacement, a velocity and an acceleration as inputs, ``loaded`` ones a force.

    Outputs are the forces at the driven nodes and the positions of the ``free`` ones; ``mounts`` says which
    driven node carries a free one. ``numbers`` are the paths of the
    slots, ``knots`` the places of the tables, the first of each twice.
    """

    program: Program
    system: SystemProgram | None
    driven: tuple[str, ...]
    loaded: tuple[str, ...]
    free: tuple[str, ...]
    mounts: Mapping[str, str]
    numbers: tuple[str, ...]
    gravity: float
    shelves: Mapping[str, Shelf]
    knots: tuple[float, ...]

    @cached_property
    def read(self) -> frozenset[str]:
        """The symbols that the program reads."""
        arguments = [look.argument for look in self.program.lookups]
        nodes = [*self.program.columns, *self.program.roots, *arguments]
        return frozenset(name for node in nodes for name in symbols_of(node))

    @cached_property
    def followers(self) -> tuple[str, ...]:
        """Those followers of the drive that the program reads."""
        return tuple(name for name in self.program.followers if name in self.read)

    @property
    def accelerated(self) -> bool:
        """Whether the forces depend on the accelerations."""
        return self.system is not None or any(name.endswith(".acceleration") for name in self.read)

    @property
    def high_order(self) -> bool:
        """Whether there are steps of high order, where the numbers allow them."""
        return self.system is not None and self.system.pace is not None

    @cached_property
    def known(self) -> tuple[str, ...]:
        """The symbols of the motion within a step of a network with unknown nodes."""
        return tuple(sorted({*self.system.known, "dt"})) if self.system else ()

    @property
    def inputs(self) -> int:
        """How many inputs there are."""
        return len(MOTION) * len(self.driven) + len(self.loaded)

    @property
    def outputs(self) -> int:
        """Where the outputs begin."""
        return INPUTS + self.inputs

    @property
    def before(self) -> int:
        """Where the inputs of the sample before begin."""
        return self.outputs + len(self.driven) + len(self.free)

    @property
    def following(self) -> int:
        """Where the followers begin."""
        return self.before + self.inputs

    @property
    def motion(self) -> int:
        """Where the motion within a step begins."""
        return self.following + len(self.followers)

    @property
    def courses(self) -> tuple[int, ...]:
        """Where the workspaces begin: one, or that of the long and that of the short steps."""
        first = self.motion + len(self.known)
        return (first, first + self.rows) if self.system else (first,)

    @property
    def rows(self) -> int:
        """How many numbers a workspace has."""
        return len(self.program.constants) + len(self.program.states)

    @property
    def tables(self) -> int:
        """Where the coefficients of the tables begin."""
        return self.courses[-1] + self.rows

    @property
    def size(self) -> int:
        """How many numbers the whole memory has."""
        return self.tables + POWERS * len(self.knots)
