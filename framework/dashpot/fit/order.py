"""The order of interchangeable branches: which of two alike in parallel is the first, however a search has ended.

Two Maxwells side by side give the same force when they exchange their numbers. So that `maxwell_1` means the same in
every fit, in its intervals and in every refit, they stand by relaxation time, and sliders by yield travel (limit over
stiffness): rising, or falling where the file declares them so. So do groups of the same elements, as springs and
dampers in series.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.side_by_side import Key, Member, in_parallel, leaves_of, makeup, slots_of, sorting_keys
from dashpot.model.network import NetworkSpec

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Interchangeable:
    """Branches or groups that may exchange their numbers: ``slots`` (members, numbers) among all slots of the network.

    They stand by their ``keys``, by the second one where the first is equal. A key is one number divided by another
    (None: by nothing), both columns of ``slots``. They stand ``falling`` where the file declares them so.
    """

    names: tuple[str, ...]
    slots: NDArray[np.int64]
    keys: tuple[Key, ...]
    falling: bool = False

    def ordered(self, values: Array) -> Array:
        """Lanes of slots with these members in their order."""
        found = values.copy()
        for lane, own in enumerate(self.order(values)):
            found[lane, self.slots] = values[lane, self.slots[own]]
        return found

    def order(self, values: Array) -> NDArray[np.int64]:
        """Which member comes when (lanes, members), in lanes of slots; of equals the first declared."""
        sign = -1.0 if self.falling else 1.0
        columns = [sign * self._quotient(values, key) for key in self.keys]
        return np.lexsort(columns[::-1], axis=1)

    def _quotient(self, values: Array, key: Key) -> Array:
        over, under = key
        below = 1.0 if under is None else values[:, self.slots[:, under]]
        return np.asarray(values[:, self.slots[:, over]] / below)


def interchangeable(declared: NetworkSpec, spec: NetworkSpec) -> tuple[Interchangeable, ...]:
    """The branches and groups of ``spec`` that may exchange their numbers, in the order in which ``declared`` has them.

    They lie in parallel between the same ends, are of the same elements, and no number tells them apart: what is fixed
    is equal, what is searched has the same bounds. What lies inside of groups comes before these.
    """
    slots = spec.slots()
    places = {slot.path: number for number, slot in enumerate(slots)}
    starts = {slot.path: slot.value.number for slot in declared.slots()}
    begin = np.array([[starts.get(slot.path, slot.value.number) for slot in slots]])
    found = []
    for members in _alike(spec):
        keys = sorting_keys(members[0])
        if keys:
            numbers = np.array([[places[slot.path] for slot in slots_of(member)] for member in members])
            found.append(_as_declared(Interchangeable(tuple(member.name for member in members), numbers, keys), begin))
    return tuple(found)


def _as_declared(family: Interchangeable, begin: Array) -> Interchangeable:
    """The same, falling where it begins so and does not rise as well, as equal ones do."""
    falling = replace(family, falling=True)
    declared = np.arange(len(family.names))
    falls = np.array_equal(falling.order(begin)[0], declared) and np.array_equal(family.order(begin)[0], declared[::-1])
    return falling if falls else family


def in_order(families: tuple[Interchangeable, ...], values: Array) -> Array:
    """Lanes of slots (lanes, slots) with all interchangeable branches in their order."""
    for family in families:
        values = family.ordered(values)
    return values


def ordered(declared: NetworkSpec, spec: NetworkSpec) -> NetworkSpec:
    """The network with its interchangeable branches in order."""
    slots = spec.slots()
    found = in_order(interchangeable(declared, spec), np.array([[slot.value.number for slot in slots]]))[0]
    return spec.with_values(
        {
            slot.path: replace(slot.value, number=float(number))
            for slot, number in zip(slots, found, strict=True)
            if slot.of is None
        }
    )


def _alike(spec: NetworkSpec) -> Iterator[list[Member]]:
    slots = spec.slots()
    shared = {branch.shares for branch in spec.leaves() if branch.shares}
    # a branch to whose numbers an expression refers is not another one's equal
    tied = {slots[k].path for rule in spec.derived.rules for k in (rule.slot, *rule.names.values())}
    families: dict[object, list[Member]] = {}
    for place, member in in_parallel(spec):
        own = slots_of(member)
        unlike = any(branch.shares or branch.name in shared for branch in leaves_of(member))
        if unlike or any(slot.value.over or slot.path in tied for slot in own):
            continue
        families.setdefault((place, makeup(member)), []).append(member)
    return (family for family in families.values() if len(family) > 1)
