"""Where the kernel finds what: rows of the workspace, columns of the drive, tables.

A row holds one number of each lane of a group. First come the constants of the lanes, then the states, then the score.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from dashpot.expr.node import Node
from dashpot.kernel.ir.program import Program
from dashpot.kernel.ir.stages import cut_stages
from dashpot.model.network import Characteristic

LANES = 8  # that every target takes side by side, or one after the other

# printed as it is, hoisted per lane, hoisted per sample, a memory, or computed in the loop
Kind = Literal["number", "lane", "drive", "state", "result"]


def score_row(program: Program) -> int:
    """The row that gathers the score, the last one."""
    return len(program.constants) + len(program.states)


@dataclass(frozen=True)
class Shelf:
    """Where a curve begins in the tables, by segments, and how many knots it has.

    A list of knots has the knot from which each segment is measured: the first one twice. Outside its knots a curve
    goes on straight, a ``level`` one stays as it is.
    """

    base: int
    count: int
    level: bool = False


def shelves_of(curves: Mapping[str, Characteristic]) -> dict[str, Shelf]:
    """Where every tabulated one of the curves stands, one after the other."""
    shelves, base = {}, 0
    for path, curve in curves.items():
        if curve.form == "table":
            shelves[path] = Shelf(base, len(curve.at), curve.curve.value[1] == "1")
            base += len(curve.at) + 1
    return shelves


@dataclass(frozen=True)
class Fusion:
    """A ``product`` that nobody needs but a sum, with the ``term`` of the sum that it is, ``negative`` or not."""

    product: Node
    term: Node
    negative: bool


class Layout:
    """The places of a program's nodes during one pass over the lanes; ``updates`` are the states that it moves.

    ``shelves`` says for every curve that lanes look up by themselves where it stands; ``results`` are the nodes that
    are computed, arguments first.
    """

    def __init__(
        self,
        program: Program,
        updates: Mapping[str, Node],
        force: Node | None = None,
        shelves: Mapping[str, Shelf] | None = None,
    ) -> None:
        self.updates, self.force, self.shelves = updates, force, shelves or {}
        self.constants = {node.serial: number for number, node in enumerate(program.constants)}
        self.columns = {node.serial: number for number, node in enumerate(program.columns)}
        self.states = {name: len(self.constants) + number for number, name in enumerate(program.states)}
        self.lookups = {(look.curve, look.argument.serial): number for number, look in enumerate(program.lookups)}
        roots = [*([force] if force is not None else []), *updates.values()]
        self.results = results = self._results(roots)
        self.stages = cut_stages(results)
        self.driven = _unique(node for node in (*roots, *_arguments(results)) if self.kind(node) == "drive")
        self.fused = self._fused(results, roots)

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
        """The row that holds a constant or a state."""
        return self.constants[node.serial] if node.serial in self.constants else self.states[node.payload]

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

    def _fused(self, results: Sequence[Node], roots: Sequence[Node]) -> dict[int, Fusion]:
        uses = Counter(node.serial for node in (*roots, *_arguments(results)))

        def own(node: Node, operation: str) -> bool:
            return node.operation == operation and uses[node.serial] == 1 and self.kind(node) == "result"

        found = {}
        for node in results:
            for argument in node.arguments if node.operation in ("add", "subtract") else ():
                turned = own(argument, "negative")
                product = argument.arguments[0] if turned else argument
                if own(product, "multiply"):
                    minus = node.operation == "subtract" and argument is node.arguments[1]
                    found[node.serial] = Fusion(product, argument, turned != minus)
        return found


def _arguments(nodes: Sequence[Node]) -> list[Node]:
    return [argument for node in nodes if node.operation != "table" for argument in node.arguments]


def _unique(nodes: Iterable[Node]) -> tuple[Node, ...]:
    return tuple({node.serial: node for node in nodes}.values())


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


def vectors_of(program: Program) -> int:
    """How many vectors of lanes keep the processor from waiting: the more, the fewer long functions stand together."""
    calls = [len(stage.calls) for stage in Passes.of(program).step.stages if stage.calls]
    return 4 if sum(calls) <= 2 * len(calls) else 2
