"""A parallel network branch by branch: what each branch adds to the force, and how that changes with its numbers.

The force of a parallel network is the sum over its branches, and a branch feels only its own numbers. So the Jacobian
of the whole network needs no more than every branch alone, parameter by parameter; branches of one structure share a
block.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive
from dashpot.data.excitation import Excitation
from dashpot.kernel.columns import Rows
from dashpot.kernel.network import CompiledNetwork, compile_network
from dashpot.model.network import Branch, Group, NetworkSpec, Value, branch_slots

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Part:
    """Branches of one structure: ``network`` is the first of them alone, ``slots`` those of each in the whole."""

    network: CompiledNetwork
    slots: tuple[tuple[int, ...], ...]


@dataclass(frozen=True, eq=False)
class Parts:
    """All branches of a network, and which one every slot belongs to; None for a slot outside the branches."""

    members: tuple[Part, ...]
    owner: tuple[tuple[int, int] | None, ...]

    def prepare(self, motion: Drive | Excitation) -> list[Rows]:
        """The part of the work that depends on the motion alone."""
        return [part.network.prepare(motion) for part in self.members]

    def sensitivities(
        self, rows: Sequence[Rows], values: Array, which: Sequence[int], shifts: Array
    ) -> tuple[Array, Array]:
        """The force (n,) at ``values`` (slots,) and its changes (k, n) when slots ``which`` move by ``shifts``."""
        total = np.zeros(rows[0].drive.samples)
        changes = np.zeros((len(which), total.size))
        for number, (part, run) in enumerate(zip(self.members, rows, strict=True)):
            lanes = [values[list(slots)] for slots in part.slots]
            homes = ((k, self.owner[slot]) for k, slot in enumerate(which))
            moved = [(k, home[1]) for k, home in homes if home and home[0] == number]
            for k, branch in moved:
                lane = lanes[branch].copy()
                lane[part.slots[branch].index(which[k])] += shifts[k]
                lanes.append(lane)
            forces = np.atleast_2d(part.network.simulate(run, np.array(lanes)))
            count = len(part.slots)
            total += forces[:count].sum(axis=0)
            for (k, branch), force in zip(moved, forces[count:], strict=True):
                changes[k] = force - forces[branch]
        return total, changes


def take_apart(spec: NetworkSpec) -> Parts:
    """Every branch of a parallel network on its own; branches of one law that are written alike together."""
    paths = [slot.path for slot in spec.slots()]
    makes: dict[Hashable, Part] = {}
    for branch in spec.leaves():
        network = compile_network(NetworkSpec(branch.name, Group("", "parallel", (branch,))))
        assert isinstance(network, CompiledNetwork)
        slots = tuple(paths.index(path) for path in network.paths)
        make = _make(branch)
        known = makes.get(make)
        makes[make] = Part(known.network, (*known.slots, slots)) if known else Part(network, (slots,))
    members = tuple(makes.values())
    owner: list[tuple[int, int] | None] = [None] * len(paths)
    for number, part in enumerate(members):
        for branch_number, slots in enumerate(part.slots):
            for slot in slots:
                owner[slot] = (number, branch_number)
    return Parts(members, tuple(owner))


def _make(branch: Branch) -> tuple[Hashable, ...]:
    # different laws may print the same kernel, as the drive is prepared outside: it does not tell them apart
    written = branch.characteristics().items()
    curves = ((key, curve.form, curve.at, len(curve.values)) for key, curve in written)
    given = (
        (slot.path.removeprefix(branch.numbers), slot.value.setting, _dependence(slot.value))
        for slot in branch_slots(branch)
        if slot.value.setting or slot.value.over
    )
    return (branch.element, *branch.values, *curves, *given)


def _dependence(value: Value) -> Hashable:
    # settings are looked up by the first branch of a make for all of them
    over = value.over
    return over and (over.word, over.channel, over.way, over.at, len(over.numbers), value.sensible)
