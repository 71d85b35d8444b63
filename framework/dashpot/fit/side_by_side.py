"""What branches and groups side by side are made of, and the numbers by which equal ones have an order."""

from __future__ import annotations

from collections.abc import Iterator

from dashpot.model.network import Branch, Group, NetworkSpec, Slot, branch_slots
from dashpot.text.quantity import base_unit

Member = Branch | Group
# a number of a member, among its own, divided by another one, or by nothing
Key = tuple[int, int | None]

# a time orders by itself, damping and a limit when divided by a stiffness
_TIME, _DAMPING, _LIMIT, _STIFFNESS = (base_unit(unit) for unit in ("s", "N*s/m", "N", "N/m"))


def in_parallel(spec: NetworkSpec) -> Iterator[tuple[object, Member]]:
    """What lies in parallel, with a mark of where: equal between the same ends. What lies deeper comes first."""
    found: list[tuple[int, object, Member]] = []
    for member in spec.root.members:
        found += _within(member, (id(spec.root), spec.ends.get(member.name)), spec.root.kind == "parallel", 0)
    for _, place, member in sorted(found, key=lambda each: -each[0]):
        yield place, member


def _within(member: Member, place: object, parallel: bool, depth: int) -> Iterator[tuple[int, object, Member]]:
    if isinstance(member, Group):
        # a group in parallel inside of another one has its ends
        opened = parallel and member.kind == "parallel"
        for inner in member.members:
            yield from _within(inner, place if opened else id(member), member.kind == "parallel", depth + 1)
        if opened:
            return
    if parallel:
        yield depth, place, member


def leaves_of(member: Member) -> tuple[Branch, ...]:
    """The branches with elements, in the order of the file."""
    return tuple(member.leaves()) if isinstance(member, Group) else (member,)


def slots_of(member: Member) -> tuple[Slot, ...]:
    """All numbers, in the order of the file."""
    return tuple(slot for branch in leaves_of(member) for slot in branch_slots(branch))


def makeup(member: Member) -> object:
    """Structure, elements and what may not differ in numbers: equal for members that may exchange what is searched."""
    if isinstance(member, Group):
        return (member.kind, *(makeup(inner) for inner in member.members))
    numbers = tuple((slot.path.removeprefix(member.name), _distinct(slot)) for slot in branch_slots(member))
    forms = tuple((key, curve.form, curve.at, curve.data) for key, curve in member.characteristics().items())
    return (member.element, numbers, forms)


def _distinct(slot: Slot) -> object:
    # what would tell a branch from another one by this number
    value = slot.value
    return (value.bounds, value.scale, value.prior) if value.searched else value.number


def sorting_keys(member: Member) -> tuple[Key, ...]:
    """The numbers that order members like this one; none for a branch without a time or a yield travel of its own.

    A group stands by the first time or yield travel among its numbers, a damper on a spring by its relaxation time,
    and what has none of these, or equal ones, by its numbers as they are declared.
    """
    units = [base_unit(slot.value.unit) for slot in slots_of(member)]
    if isinstance(member, Group):
        return (*_natural(units), *((number, None) for number in range(len(units))))
    plain = [number for number, slot in enumerate(slots_of(member)) if _is_plain(member, slot)]
    times, limits, slopes = ([k for k in plain if units[k] == unit] for unit in (_TIME, _LIMIT, _STIFFNESS))
    if len(times) == 1:
        return ((times[0], None),)
    return ((limits[0], slopes[0]),) if len(limits) == len(slopes) == 1 else ()


def _is_plain(branch: Branch, slot: Slot) -> bool:
    # not a point of a curve
    return slot.path.removeprefix(f"{branch.name}.") in branch.values


def _natural(units: list[str]) -> tuple[Key, ...]:
    times, dampings, limits, slopes = (
        [number for number, own in enumerate(units) if own == unit] for unit in (_TIME, _DAMPING, _LIMIT, _STIFFNESS)
    )
    if times:
        return ((times[0], None),)
    above = dampings or limits
    return ((above[0], slopes[0]),) if above and slopes else ()
