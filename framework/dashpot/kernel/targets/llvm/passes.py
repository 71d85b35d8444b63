"""Writing one pass over a group of lanes: every node of a graph becomes the instructions that compute it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from dashpot.expr.node import Node, is_logical
from dashpot.kernel.ir.layout import LANES, Fusion, Layout, Shelf
from dashpot.kernel.targets.llvm import functions
from dashpot.kernel.targets.llvm.assembly import BITS, NUMBER, TRUTH, Assembly, Bundle, joined, parted
from dashpot.kernel.targets.llvm.library import LIBRARY, one_by_one
from dashpot.kernel.targets.llvm.packing import packed, unpacked

POWERS = 4  # coefficients of a cubic
TOGETHER = 8  # vectors of arguments of long functions at once
SHORT = 4  # stages that the compiler may mix
COMPARED = {
    "less": "olt",
    "less_equal": "ole",
    "greater": "ogt",
    "greater_equal": "oge",
    "equal": "oeq",
    "not_equal": "une",
}
ARITHMETIC: dict[str, Callable[..., Bundle]] = {
    "add": lambda a, b: a + b,
    "subtract": lambda a, b: a - b,
    "multiply": lambda a, b: a * b,
    "divide": lambda a, b: a / b,
    "negative": lambda a: -a,
    "absolute": lambda a: a.called("fabs"),
    "sqrt": lambda a: a.called("sqrt"),
    "logical_and": lambda a, b: a & b,
    "logical_or": lambda a, b: a | b,
    "logical_not": lambda a: ~a,
    "where": lambda condition, yes, no: condition.choose(yes, no),
    "minimum": functions.minimum,
    "maximum": functions.maximum,
    "sign": functions.sign,
}
LONG: dict[str, Callable[..., Bundle | functions.Rare]] = {
    "exp": functions.exp,
    "log": functions.log,
    "expm1": functions.expm1,
    "log1p": functions.log1p,
    "tanh": functions.tanh,
    "power": functions.power,
    "wrightomega": functions.wrightomega,
}


@dataclass(frozen=True)
class Arrays:
    """Names of the arrays that a pass reads: ``columns`` is the row of the drive for this step, ``index`` and ``local``
    those of the tables along the drive; ``bases`` are the places of each vector in the workspace."""

    columns: str
    bases: Sequence[str]
    tables: str = "%tables"
    knots: str = "%knots"
    index: str = ""
    local: str = ""

    @property
    def width(self) -> int:
        """Lanes in a group."""
        return LANES * len(self.bases)


@dataclass
class Pass:
    """A pass while it is being written: the bundles of the nodes that are computed so far, by serial.

    With ``alone`` all lanes are the same one, so that a vector has room for several arguments of a long function.
    """

    assembly: Assembly
    layout: Layout
    arrays: Arrays
    alone: bool = False
    bundles: dict[int, Bundle] = field(default_factory=dict)
    segments: dict[tuple[str, int], tuple[Bundle, list[Bundle]]] = field(default_factory=dict)

    def write(self) -> None:
        """Compute everything, then move the states."""
        for node in self.layout.driven:
            self.bundles[node.serial] = self._driven(node)
        hidden = {part.serial for fusion in self.layout.fused.values() for part in (fusion.product, fusion.term)}
        for stage in self.layout.stages:
            self._compute([node for node in stage.nodes if node.serial not in hidden])
            beside = [node for node in stage.beside if node.serial not in hidden]
            if any(node.operation == "lookup" for node in beside):  # it has branches
                self._compute(beside)
                beside = []
            for calls in self._batches(stage.calls):
                self._call(calls, beside)
                beside = []
            self._compute(beside)
        # all are read before any is moved
        moved = [(self.layout.states[name], self.number(node)) for name, node in self.layout.updates.items()]
        for row, bundle in moved:
            self.store(row, bundle)

    def _batches(self, calls: Sequence[Node]) -> list[Sequence[Node]]:
        # more side by side than there are registers would wait for memory
        most = TOGETHER * LANES if self.alone else max(TOGETHER // len(self.arrays.bases), 1)
        return [calls[first : first + most] for first in range(0, len(calls), most)]

    def _call(self, calls: Sequence[Node], beside: Sequence[Node]) -> None:
        # long functions, each kind at once, among what does not need them
        together, apart = (packed, unpacked) if self.alone else (joined, parted)
        kinds: dict[str, list[Node]] = {}
        for call in calls:
            kinds.setdefault(call.operation, []).append(call)
        parts: list[Callable[[], Any]] = [partial(self._compute, beside)]
        for kind, same in kinds.items():
            given = zip(*([self.value(argument) for argument in call.arguments] for call in same), strict=True)
            parts.append(partial(LONG[kind], *(together(column) for column in given)))
        _, *answers = self.assembly.woven(parts)
        for same, answer in zip(kinds.values(), answers, strict=True):
            whole = answer.amended() if isinstance(answer, functions.Rare) else answer
            if len(self.layout.stages) > SHORT and len(self.arrays.bases) > 1:
                # left free, the compiler takes one vector through many stages, each waiting for the one before
                whole = self.assembly.settled(whole, "%w")
            for call, part in zip(same, apart(whole, len(same)), strict=True):
                self.bundles[call.serial] = part

    def _compute(self, nodes: Sequence[Node]) -> None:
        for node in nodes:
            self.bundles[node.serial] = self._result(node)

    def value(self, node: Node) -> Bundle:
        """The bundle of a node."""
        if node.serial not in self.bundles:
            self.bundles[node.serial] = self._given(node)
        return self.bundles[node.serial]

    def number(self, node: Node) -> Bundle:
        """The same, with 1.0 for true."""
        return self.value(node).cast(NUMBER, "uitofp") if is_logical(node) else self.value(node)

    def load(self, row: int) -> Bundle:
        """A row of the workspace."""
        return self.assembly.load(self.arrays.bases, self.arrays.width * row)

    def store(self, row: int, bundle: Bundle) -> None:
        """A new row of the workspace."""
        self.assembly.store(bundle, self.arrays.bases, self.arrays.width * row)

    def _given(self, node: Node) -> Bundle:
        if node.operation == "constant":
            kind = TRUTH if is_logical(node) else NUMBER
            return Bundle(self.assembly, kind, ("",) * len(self.arrays.bases)).like(node.payload)
        row = self.load(self.layout.row(node))
        return row.compare("une", 0.0) if is_logical(node) else row

    def _driven(self, node: Node) -> Bundle:
        scalar, kind = self.assembly.scalar(self.arrays.columns, self.layout.columns[node.serial]), "double"
        if is_logical(node):
            scalar, kind = self.assembly.new(f"fcmp une double {scalar}, 0.0"), "i1"
        return self.assembly.spread(scalar, len(self.arrays.bases), kind)

    def _result(self, node: Node) -> Bundle:
        if node.serial in self.layout.fused:
            return self._fused(node, self.layout.fused[node.serial])
        if node.operation == "table":
            return self._along(node)
        if node.operation == "lookup":
            return self._looked_up(node)
        arguments = [self.value(argument) for argument in node.arguments]
        if node.operation in COMPARED:
            return arguments[0].compare(COMPARED[node.operation], arguments[1])
        if node.operation in LIBRARY:
            return one_by_one(LIBRARY[node.operation], arguments)
        return ARITHMETIC[node.operation](*arguments)

    def _fused(self, node: Node, fusion: Fusion) -> Bundle:
        first, second = (self.value(argument) for argument in fusion.product.arguments)
        other = node.arguments[1] if fusion.term is node.arguments[0] else node.arguments[0]
        minus = node.operation == "subtract" and other is node.arguments[1]
        rest = -self.value(other) if minus else self.value(other)
        return (-first if fusion.negative else first).times_plus(second, rest)

    def _along(self, node: Node) -> Bundle:
        # a table whose segment the drive knows
        number = self.layout.lookups[node.payload[0], node.arguments[0].serial]
        segment = self.assembly.scalar(self.arrays.index, number, "i64")
        part = self.assembly.address(self.arrays.tables, self.assembly.product(segment, POWERS * self.arrays.width))
        u = self.assembly.spread(self.assembly.scalar(self.arrays.local, number), len(self.arrays.bases))
        return _cubic(self._coefficients([part]), u, node.payload[1])

    def _coefficients(self, parts: Sequence[str]) -> list[Bundle]:
        # one part for all vectors, or one for each
        whole = [*parts] * (len(self.arrays.bases) // len(parts))
        bases = [self.assembly.address(part, LANES * place) for place, part in enumerate(whole)]
        return [self.assembly.load(bases, self.arrays.width * power) for power in range(POWERS)]

    def _looked_up(self, node: Node) -> Bundle:
        # value and slope of the same place share what is read
        (curve, order), argument = node.payload, node.arguments[0]
        key = curve, argument.serial
        if key not in self.segments:
            self.segments[key] = self._find(self.layout.shelves[curve], self.value(argument))
        u, coefficients = self.segments[key]
        return _cubic(coefficients, u, order)

    def _find(self, shelf: Shelf, x: Bundle) -> tuple[Bundle, list[Bundle]]:
        # lanes are close together: the segment of the first lane of a vector mostly serves all of it
        segment = x.like(shelf.base, BITS)
        for place in range(shelf.base + 1, shelf.base + 1 + shelf.count):
            knot = self.assembly.spread(self.assembly.scalar(self.arrays.knots, place), len(x.names))
            segment = x.compare("oge", knot).choose(segment + 1, segment)
        firsts = [self.assembly.new(f"extractelement {BITS} {name}, i64 0") for name in segment.names]
        parts = [
            self.assembly.address(self.arrays.tables, self.assembly.product(first, POWERS * self.arrays.width))
            for first in firsts
        ]
        starts = [self.assembly.spread(self.assembly.scalar(self.arrays.knots, first), 1) for first in firsts]
        elsewhere = segment.differs(joined([self.assembly.spread(first, 1, "i64") for first in firsts]))
        near = joined([*starts, *self._coefficients(parts)])
        start, *coefficients = parted(
            self.assembly.amended(elsewhere, near, lambda: self._gathered(segment)), 1 + POWERS
        )
        return x - start, coefficients

    def _gathered(self, segment: Bundle) -> Bundle:
        # every lane from its own segment
        width, tables = self.arrays.width, self.arrays.tables
        lanes = [self.assembly.lanes(LANES * place) for place in range(len(self.arrays.bases))]
        first = segment.times(POWERS * width) + joined(lanes)
        start = self.assembly.gather(self.arrays.knots, segment)
        return joined([start, *(self.assembly.gather(tables, first + width * power) for power in range(POWERS))])


def _cubic(coefficients: Sequence[Bundle], u: Bundle, order: int) -> Bundle:
    # a cubic of a table, or its first or second derivative
    c0, c1, c2, c3 = coefficients
    if order == 0:
        return u.times_plus(u.times_plus(u.times_plus(c3, c2), c1), c0)
    if order == 1:
        return u.times_plus(u.times_plus(c3 * 3.0, c2 * 2.0), c1)
    return u.times_plus(c3 * 6.0, c2 * 2.0)
