"""A parallel network branch by branch: what each branch adds to the force, and how that changes with its numbers.

The force of a parallel network is the sum over its branches, and a branch feels only its own numbers. So the Jacobian
of the whole network needs no more than every branch alone, moved number by number; branches of one make share a block.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive
from dashpot.kernel.columns import Rows
from dashpot.kernel.network import CompiledNetwork, compile_network
from dashpot.model.network import Branch, Group, NetworkSpec

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Part:
    """Branches of one make: ``network`` is the first of them alone, ``slots`` the numbers of each in the whole."""

    network: CompiledNetwork
    slots: tuple[tuple[int, ...], ...]


@dataclass(frozen=True, eq=False)
class Parts:
    """All branches of a network, and which one every slot belongs to; None for a slot outside the branches."""

    members: tuple[Part, ...]
    owner: tuple[tuple[int, int] | None, ...]

    def prepare(self, drive: Drive) -> list[Rows]:
        """The part of the work that depends on the drive alone."""
        return [part.network.prepare(drive) for part in self.members]

    def sensitivities(
        self, rows: Sequence[Rows], values: Array, which: Sequence[int], shifts: Array
    ) -> tuple[Array, Array]:
        """The force (n,) at ``values`` (slots,) and its changes (k, n) when slots ``which`` move by ``shifts``."""
        total = np.zeros(rows[0].drive.samples)
        changes = np.zeros((len(which), total.size))
        for number, (part, run) in enumerate(zip(self.members, rows, strict=True)):
            lanes = [values[list(slots)] for slots in part.slots]
            moved = [k for k, slot in enumerate(which) if self.owner[slot] and self.owner[slot][0] == number]
            for k in moved:
                branch = self.owner[which[k]][1]
                lane = lanes[branch].copy()
                lane[part.slots[branch].index(which[k])] += shifts[k]
                lanes.append(lane)
            forces = np.atleast_2d(part.network.simulate(run, np.array(lanes)))
            count = len(part.slots)
            total += forces[:count].sum(axis=0)
            for k, force in zip(moved, forces[count:], strict=True):
                changes[k] = force - forces[self.owner[which[k]][1]]
        return total, changes


def take_apart(spec: NetworkSpec) -> Parts:
    """Every branch of a parallel network on its own; branches with the same kernel and knots together."""
    paths = [slot.path for slot in spec.slots()]
    makes: dict[tuple, Part] = {}
    for branch in spec.leaves():
        network = compile_network(NetworkSpec(branch.name, Group("", "parallel", (branch,))))
        slots = tuple(paths.index(path) for path in network.paths)
        make = (network.native.file, _knots(branch))
        known = makes.get(make)
        makes[make] = Part(known.network, (*known.slots, slots)) if known else Part(network, (slots,))
    members = tuple(makes.values())
    owner: list[tuple[int, int] | None] = [None] * len(paths)
    for number, part in enumerate(members):
        for branch_number, slots in enumerate(part.slots):
            for slot in slots:
                owner[slot] = (number, branch_number)
    return Parts(members, tuple(owner))


def _knots(branch: Branch) -> tuple:
    return tuple((key, curve.form, curve.at) for key, curve in branch.characteristics().items())
