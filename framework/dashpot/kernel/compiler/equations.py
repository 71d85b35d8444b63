"""The equations of a network with unknown nodes: passes, each a set of rows of the workspace and their new values.

start    a first guess of the static equilibrium
settle   Newton's step towards it
rest     the places and the memory with which the record begins
launch   Newton's step towards the velocities with which it begins, along a line
set_off  these velocities, and the forces of the first sample
predict  the part of a step that does not depend on the unknowns, and a first guess of them
turn     where all unknown nodes have masses: laws without rates at the point where their edge turns
correct  there as well: Newton's step with the tangents of before
improve  Newton's step, and the new memory and what is measured where it leads to
search   the same along a line, where Newton's steps alone do not end
commit   the end of the step becomes the begin of the next one
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from dashpot.kernel.compiler.equilibrium import Still
from dashpot.kernel.compiler.impact import Impacting, struck
from dashpot.kernel.compiler.launch import Launch
from dashpot.kernel.compiler.line_search import search
from dashpot.kernel.compiler.mechanics import MOVED, NOTHING, RULE, Meter, Moving, Rows, driven_symbol
from dashpot.kernel.compiler.multistep import QUICK_RULE, Multistep, multistep_fits
from dashpot.kernel.compiler.own_tables import with_own_tables
from dashpot.kernel.compiler.trace import trace_along
from dashpot.model.topology import Topology


@dataclass(frozen=True)
class Equations:
    """The ``passes`` of a network by name, in the order in which they run; ``known`` are the symbols of the drive."""

    passes: Mapping[str, Rows]
    known: frozenset[str]

    @property
    def rows(self) -> tuple[str, ...]:
        """The names of all rows."""
        return tuple(dict.fromkeys([NOTHING, *(name for rows in self.passes.values() for name in rows)]))


def write_equations(topology: Topology, meter: Meter | None = None) -> Equations:
    """The equations of a network, and those of a meter that goes along."""
    laws = [trace_along(edge.branch, "edge") for edge in topology.edges]
    known = {driven_symbol(joint, key) for joint in topology.held("driven") for key in MOVED}
    known |= {driven_symbol(joint, "load") for joint in topology.held("loaded")} | set(RULE)
    still, launch = Still(topology, laws), Launch(topology, laws)
    # a meter adds up the work of steps whose ends tell all of it
    quick = multistep_fits(topology) and meter is None
    rule = Impacting if struck(topology, laws) else Multistep if quick else Moving
    moving = rule(topology, laws)
    passes = {
        "start": still.start(),
        "settle": still.improve(),
        "rest": still.rest(),
        "launch": search(launch),
        "set_off": launch.set_off(),
        "predict": moving.predict(),
        "improve": moving.improve(),
        "search": search(moving),
        "commit": moving.commit(),
    }
    if isinstance(moving, Multistep):
        known |= set(QUICK_RULE)
        passes |= {"turn": moving.turn(), "correct": moving.correct()}
    passes["rest"] |= moving.rest()
    if meter:
        passes["rest"] |= meter.rest(still)
        passes["commit"] |= meter.commit(moving)
    return Equations({name: with_own_tables(rows, NOTHING) for name, rows in passes.items()}, frozenset(known))
