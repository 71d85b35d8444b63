"""Which node of one network is which of the other."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations, permutations

from dashpot.model.likeness.reduced import Reduced
from dashpot.model.network import Joint

MOST_TRIED = 7  # nodes of which every pairing is tried where no pairing fits exactly

Pairing = Mapping[str, str]


def pair_nodes(first: Reduced, second: Reduced) -> dict[str, str]:
    """The nodes of the first network with those of the second: an exact pairing where there is one, else a close one.

    With many nodes and no exact pairing, nodes of one name belong together.
    """
    exact = _exact(first, second, {}) if len(first.joints) == len(second.joints) else None
    if exact is not None:
        return exact
    if max(len(first.joints), len(second.joints)) > MOST_TRIED:
        return {name: name for name in first.joints if name in second.joints}
    turned = len(first.joints) > len(second.joints)
    small, large = (second, first) if turned else (first, second)
    pairings = [
        dict(zip(small.joints, chosen, strict=True)) for chosen in permutations(large.joints, len(small.joints))
    ]
    best = min(pairings, key=lambda pairing: _distance(small, large, pairing))
    return {there: here for here, there in best.items()} if turned else best


def role(joint: Joint) -> tuple[object, ...]:
    """What a node is in the structure: how it is held and which masses it has, fixed, told by runs or to be found."""
    masses = [(key, value.searched, bool(value.setting)) for key, value in joint.masses.items()]
    tied = bool(joint.shares) and any(value.searched for value in joint.masses.values())
    return (joint.hold, tied, *sorted(masses))


def _exact(first: Reduced, second: Reduced, known: dict[str, str]) -> dict[str, str] | None:
    left = [name for name in first.joints if name not in known]
    if not left:
        return known
    here = left[0]
    # the same name first: where several pairings fit, it is the one that is meant
    for there in sorted(second.joints, key=lambda name: name != here):
        if there not in known.values() and _fits(first, second, known, here, there):
            found = _exact(first, second, {**known, here: there})
            if found is not None:
                return found
    return None


def _fits(first: Reduced, second: Reduced, known: Pairing, here: str, there: str) -> bool:
    return role(first.joints[here]) == role(second.joints[there]) and all(
        first.labels[here, other] == second.labels[there, known[other]] for other in known
    )


def _distance(first: Reduced, second: Reduced, pairing: Pairing) -> tuple[int, int]:
    roles = [(role(first.joints[name]), role(second.joints[other])) for name, other in pairing.items()]
    # how a node is held weighs more than its masses
    far = sum(3 * (here[0] != there[0]) + (here != there) for here, there in roles)
    common = sum(
        (first.labels[lower, upper] & second.labels[pairing[lower], pairing[upper]]).total()
        for lower, upper in combinations(pairing, 2)
    )
    return far - 2 * common, sum(name != other for name, other in pairing.items())
