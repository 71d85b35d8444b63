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

from dashpot.kernel.columns import Rows
from dashpot.kernel.network import CompiledNetwork, compile_network
from dashpot.kernel.scratch import Scratch
from dashpot.model.network import Branch, Group, NetworkSpec, Value, branch_slots

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Part:
    """Branches of one structure: ``network`` is the first of them alone, ``slots`` those of each in the whole."""

    network: CompiledNetwork
    slots: tuple[tuple[int, ...], ...]


@dataclass(frozen=True, eq=False)
class MovedLanes:
    """Lanes of one structure: its branches as they are, then each row (move, branch) of ``touched`` after its move."""

    lanes: Array
    touched: NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Parts:
    """All branches of a network, and which slots (slots,) lie outside the branches."""

    members: tuple[Part, ...]
    outside: NDArray[np.bool_]

    def lanes(self, values: Array, moves: Array) -> list[MovedLanes]:
        """What has to be simulated of each structure for moves (k, slots) of ``values`` (slots,)."""
        found = []
        for part in self.members:
            slots = np.array(part.slots, dtype=np.int64)
            stand, moved = values[slots], moves[:, slots]
            touched = np.argwhere(moved.any(axis=2))
            move, branch = touched.T
            found.append(MovedLanes(np.concatenate([stand, stand[branch] + moved[move, branch]]), touched))
        return found

    def sensitivities(self, rows: Sequence[Rows], lanes: Sequence[MovedLanes], count: int, scratch: Scratch) -> Array:
        """The force of the whole and its changes (1 + count, n) with the moves from which the ``lanes`` came.

        ``rows`` are those of one run, as each structure sees it.
        """
        samples = rows[0].drive.samples
        found = scratch.take("changes", 1 + count, samples)
        empty = set(range(1 + count))
        for part, run, moved in zip(self.members, rows, lanes, strict=True):
            forces = part.network.simulate(run, moved.lanes, scratch.take("forces", len(moved.lanes), samples))
            stand, changed = np.split(forces, [len(part.slots)])
            for force, branch in zip(changed, moved.touched[:, 1], strict=True):
                force -= stand[branch]
            for place, force in zip([0] * len(stand) + (1 + moved.touched[:, 0]).tolist(), forces, strict=True):
                if place in empty:
                    found[place] = force
                else:
                    found[place] += force
                empty.discard(place)
        found[list(empty)] = 0.0
        return found


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
    outside = np.ones(len(paths), dtype=bool)
    for part in members:
        outside[[slot for slots in part.slots for slot in slots]] = False
    return Parts(members, outside)


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
