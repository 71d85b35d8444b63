"""The program of a network: what is known before the loop, and what the loop computes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from dashpot.expr.node import Node


@dataclass(frozen=True)
class Lookup:
    """A tabulated curve at an argument that depends on the drive alone."""

    curve: str
    argument: Node


@dataclass(frozen=True, eq=False)
class Program:
    """A network ready to be printed: what is hoisted, and what the passes over the lanes compute.

    A step computes ``force`` and ``updates``; at a turning point the states in ``turning`` alone move. Where one of the
    ``events`` is true, ``corrections`` of old states come first.
    """

    columns: tuple[Node, ...]
    constants: tuple[Node, ...]
    lookups: tuple[Lookup, ...]
    followers: Mapping[str, Node]
    force: Node
    updates: Mapping[str, Node]
    turning: tuple[str, ...]
    events: tuple[Node, ...]
    corrections: Mapping[str, Node]

    @property
    def states(self) -> tuple[str, ...]:
        """The memories of the lanes."""
        return tuple(self.updates)

    @property
    def roots(self) -> list[Node]:
        """What a step computes."""
        return [self.force, *self.updates.values()]
