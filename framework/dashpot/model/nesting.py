"""How deep groups and used networks may lie in each other."""

from __future__ import annotations

from dashpot.model.network import Branch, Group
from dashpot.text.compose import MAX_DEPTH
from dashpot.text.problem import InputError, Place

# Written out into one text every group takes two levels of it; what is left holds the root and the inside of a branch.
LEFT = 16
MAXIMUM_DEPTH = (MAX_DEPTH - LEFT) // 2


class TooDeep(InputError):
    """What is deeper than this is not read on, so that nothing that uses it need be told of."""


def refuse_too_deep(depth: int, place: Place) -> None:
    """TooDeep at the group or ``use`` that is the ``depth``-th in others, where that is more than is allowed."""
    if depth > MAXIMUM_DEPTH:
        raise TooDeep.at(
            place,
            f"expected groups and used networks up to {MAXIMUM_DEPTH} deep in each other, got one that is {depth} deep",
            "build it flatter: leave out groups and networks that hold nothing but a single group or network",
        )


def height(member: Branch | Group) -> int:
    """How many groups lie in each other here, this one counted."""
    return 0 if isinstance(member, Branch) else 1 + max(map(height, member.members), default=0)
