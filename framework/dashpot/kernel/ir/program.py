"""The program of a network: what is known before the loop, and what the loop computes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from dashpot.expr.node import Node, table


@dataclass(frozen=True)
class Lookup:
    """A tabulated curve at an argument that depends on the drive alone."""

    curve: str
    argument: Node


@dataclass(frozen=True, eq=False)
class Program:
    """A network ready to be printed: what is hoisted, and what the passes over the lanes compute.

    A step computes ``force`` and ``updates``; at a turning point the states in ``turning`` alone move. Where one of the
    ``events`` is true, ``corrections`` of old states come first. ``digest`` stands for all that it is made of, where
    that is known.
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
    digest: str = ""

    @property
    def states(self) -> tuple[str, ...]:
        """The memories of the lanes."""
        return tuple(self.updates)

    @property
    def roots(self) -> list[Node]:
        """What a step computes."""
        return [self.force, *self.updates.values()]

    def graphs(self) -> dict[str, Any]:
        """All that it is made of, as nodes in tuples and mappings; see ``from_graphs``."""
        return {
            "columns": self.columns,
            "constants": self.constants,
            "lookups": tuple(table(look.curve, look.argument) for look in self.lookups),
            "followers": dict(self.followers),
            "force": self.force,
            "updates": dict(self.updates),
            "turning": {name: self.updates[name] for name in self.turning},
            "events": self.events,
            "corrections": dict(self.corrections),
        }

    @classmethod
    def from_graphs(cls, graphs: Mapping[str, Any], digest: str) -> Program:
        """The program of such graphs."""
        looked = tuple(Lookup(node.payload[0], node.arguments[0]) for node in graphs["lookups"])
        return cls(**{**graphs, "lookups": looked, "turning": tuple(graphs["turning"])}, digest=digest)
