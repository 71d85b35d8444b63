"""The order of interchangeable branches: which of two alike in parallel is the first, however a search has ended.

Two Maxwells side by side give the same force when they exchange their numbers. So that `maxwell_1` means the same in
every fit, in its intervals and in every refit, they stand by relaxation time, and sliders by yield travel (limit over
stiffness): rising, or falling where the file declares them so.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.model.network import Branch, Group, NetworkSpec, Slot, branch_slots

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Interchangeable:
    """Branches that may exchange their numbers: ``slots`` (branches, numbers) among all slots of the network.

    The key by which they stand is the number ``over`` divided by the number ``under`` (None: by nothing), both columns
    of ``slots``. They stand ``falling`` where the file declares them so.
    """

    names: tuple[str, ...]
    slots: NDArray[np.int64]
    over: int
    under: int | None
    falling: bool

    def keys(self, values: Array) -> Array:
        """The keys (lanes, branches) of lanes of slots."""
        below = 1.0 if self.under is None else values[:, self.slots[:, self.under]]
        return np.asarray(values[:, self.slots[:, self.over]] / below)

    def ordered(self, values: Array) -> Array:
        """Lanes of slots with these branches in their order."""
        keys = self.keys(values)
        order = np.argsort(-keys if self.falling else keys, axis=1, kind="stable")
        found = values.copy()
        for lane, own in enumerate(order):
            found[lane, self.slots] = values[lane, self.slots[own]]
        return found


def interchangeable(declared: NetworkSpec, spec: NetworkSpec) -> tuple[Interchangeable, ...]:
    """The branches of ``spec`` that may exchange their numbers, and the order in which ``declared`` has them.

    They lie in parallel between the same ends, are of one element, and no number tells them apart: what is fixed is
    equal, what is searched has the same bounds.
    """
    places = {slot.path: number for number, slot in enumerate(spec.slots())}
    starts = {slot.path: slot.value.number for slot in declared.slots()}
    found = []
    for branches in _alike(spec):
        over, under = _key(branches[0])
        if over is None:
            continue
        keys = [slot.path.removeprefix(branches[0].name) for slot in branch_slots(branches[0])]
        slots = np.array([[places[f"{branch.name}{key}"] for key in keys] for branch in branches])
        column = {key: number for number, key in enumerate(keys)}
        family = Interchangeable(
            tuple(branch.name for branch in branches),
            slots,
            column[f".{over}"],
            None if under is None else column[f".{under}"],
            False,
        )
        begin = np.array([[starts.get(slot.path, slot.value.number) for slot in spec.slots()]])
        falling = bool(np.all(np.diff(family.keys(begin)[0]) < 0.0))
        found.append(Interchangeable(family.names, slots, family.over, family.under, falling))
    return tuple(found)


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


def _alike(spec: NetworkSpec) -> Iterator[list[Branch]]:
    slots = spec.slots()
    shared = {branch.shares for branch in spec.leaves() if branch.shares}
    # a branch to whose numbers an expression refers is not another one's equal
    tied = {slots[k].path for rule in spec.derived.rules for k in (rule.slot, *rule.names.values())}
    families: dict[object, list[Branch]] = {}
    for group, branch in _in_parallel(spec.root):
        own = tuple(branch_slots(branch))
        if branch.shares or branch.name in shared or any(slot.value.over or slot.path in tied for slot in own):
            continue
        numbers = tuple((slot.path.removeprefix(branch.name), _distinct(slot)) for slot in own)
        forms = tuple((key, curve.form, curve.at, curve.data) for key, curve in branch.characteristics().items())
        families.setdefault((group, spec.ends.get(branch.name), branch.element, numbers, forms), []).append(branch)
    return (family for family in families.values() if len(family) > 1)


def _in_parallel(group: Group) -> Iterator[tuple[int, Branch]]:
    for member in group.members:
        if isinstance(member, Group):
            yield from _in_parallel(member)
        elif group.kind == "parallel":
            yield id(group), member


def _distinct(slot: Slot) -> object:
    # what would tell a branch from another one by this number
    value = slot.value
    return (value.bounds, value.scale, value.prior) if value.searched else value.number


def _key(branch: Branch) -> tuple[str | None, str | None]:
    """The parameters whose quotient orders branches of an element: a time alone, or a force over a stiffness."""
    units = {key: value.unit for key, value in branch.values.items()}
    times = [key for key, unit in units.items() if unit == "s"]
    limits, slopes = ([key for key, unit in units.items() if unit == wanted] for wanted in ("N", "N/m"))
    if len(times) == 1:
        return times[0], None
    return (limits[0], slopes[0]) if len(limits) == len(slopes) == 1 else (None, None)
