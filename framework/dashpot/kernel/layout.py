"""Where the kernel finds what: names in the printed loops, rows in the workspace.

A row holds one number of each lane. First come the constants of the lanes, then the states, the score, and what one
stage of a pass hands to the next.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from dashpot.expr.node import Node, symbol
from dashpot.kernel.stages import cut_stages, kept_nodes, moments
from dashpot.kernel.tiers import Program

# printed as it is, hoisted per lane, hoisted per sample, a memory, or computed in the loop
Kind = Literal["number", "lane", "drive", "state", "result"]


def score_row(program: Program) -> int:
    """The row that gathers the score."""
    return len(program.constants) + len(program.states)


@dataclass(frozen=True)
class Shelf:
    """Where a curve's coefficients begin in the tables, and its knots among all knots."""

    base: int
    first: int
    count: int


class Layout:
    """The places of a program's nodes during one pass over the lanes; ``updates`` are the states that it moves.

    ``shelves`` says for every curve that lanes look up by themselves where it stands.
    """

    def __init__(self, program: Program, updates: Mapping[str, Node], force: Node | None = None,
                 shelves: Mapping[str, Shelf] | None = None) -> None:  # fmt: skip
        self.updates, self.force, self.shelves = updates, force, shelves or {}
        self.constants = {node.serial: number for number, node in enumerate(program.constants)}
        self.columns = {node.serial: number for number, node in enumerate(program.columns)}
        self.states = {name: len(self.constants) + number for number, name in enumerate(program.states)}
        self.lookups = {(look.curve, look.argument.serial): number for number, look in enumerate(program.lookups)}
        roots = [*([force] if force is not None else []), *updates.values()]
        self.stages = cut_stages(self._results(roots), roots)
        self.kept = self._house(score_row(program) + 1)
        self.rows = 1 + max([score_row(program), *self.kept.values()])

    def kind(self, node: Node) -> Kind:
        """What the loop has to do for a node."""
        if node.operation == "constant":
            return "number"
        if node.serial in self.constants:
            return "lane"
        if node.serial in self.columns:
            return "drive"
        return "state" if node.operation == "symbol" else "result"

    def row(self, node: Node) -> int:
        """The row that holds a constant, a state or a kept result."""
        kind = self.kind(node)
        if kind == "lane":
            return self.constants[node.serial]
        return self.states[node.payload] if kind == "state" else self.kept[node.serial]

    def moved(self) -> list[tuple[int, Node]]:
        """The rows of states, and their new values, that have not found their place before the last loop."""
        rows = [(self.states[name], node) for name, node in self.updates.items()]
        return [(row, node) for row, node in rows if self.kept.get(node.serial) != row]

    def _results(self, roots: Sequence[Node]) -> list[Node]:
        # arguments first
        found: dict[int, Node] = {}
        stack = [(root, False) for root in reversed(roots)]
        while stack:
            node, ready = stack.pop()
            if node.serial in found or self.kind(node) != "result":
                continue
            if ready or node.operation == "table":
                found[node.serial] = node
            else:
                stack.append((node, True))
                stack.extend((argument, False) for argument in reversed(node.arguments))
        return list(found.values())

    def _house(self, free: int) -> dict[int, int]:
        # a new state takes the place of the old one as soon as nobody reads that any more
        made, read = moments(self.stages)
        homes: dict[int, int] = {}
        for name, node in self.updates.items():
            if read.get(symbol(name).serial, -1) < made.get(node.serial, -1):
                homes.setdefault(node.serial, self.states[name])
        rows: dict[int, int] = {}
        for serial in kept_nodes(self.stages):
            rows[serial] = homes.get(serial, free)
            free += serial not in homes
        return rows


@dataclass(frozen=True)
class Passes:
    """The passes over the lanes: correcting states at an event, moving them to a turning point, making a step."""

    correct: Layout | None
    turn: Layout | None
    step: Layout

    @classmethod
    def of(cls, program: Program) -> Passes:
        """The passes of a program."""
        moved = {name: program.updates[name] for name in program.turning}
        return cls(
            Layout(program, program.corrections) if program.corrections else None,
            Layout(program, moved) if moved else None,
            Layout(program, program.updates, program.force),
        )

    @property
    def rows(self) -> int:
        """How many rows the workspace needs."""
        return max(layout.rows for layout in (self.correct, self.turn, self.step) if layout)
