"""Writing LLVM assembly: the operations that a kernel is made of, on vectors of lanes.

A bundle is one quantity of several vectors of eight lanes. Every operation on it is written for one vector after the
other, so that the processor always finds several that do not wait for each other; a long function over a bundle keeps
its coefficients in registers. The text has no optimiser to wait for: it is what the machine will do.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TypeVar

from dashpot.kernel.ir.layout import LANES

T = TypeVar("T")
# a vector has all LANES; processors with narrower ones take several steps
NUMBER, BITS, TRUTH = f"<{LANES} x double>", f"<{LANES} x i64>", f"<{LANES} x i1>"


@dataclass(frozen=True, eq=False)
class Bundle:
    """The names of vectors of one type; a number beside a bundle stands for that number in all lanes."""

    assembly: Assembly
    type: str
    names: tuple[str, ...]

    def __add__(self, other: Bundle | float) -> Bundle:
        return self._paired("fadd" if self.type == NUMBER else "add", other)

    def __sub__(self, other: Bundle | float) -> Bundle:
        return self._paired("fsub" if self.type == NUMBER else "sub", other)

    def __rsub__(self, other: float) -> Bundle:
        return self.like(other)._paired("fsub" if self.type == NUMBER else "sub", self)

    def __mul__(self, other: Bundle | float) -> Bundle:
        return self._paired("fmul", other)

    def __truediv__(self, other: Bundle | float) -> Bundle:
        return self._paired("fdiv", other)

    def __neg__(self) -> Bundle:
        return self.made("fneg {type} {0}", self.type)

    def __and__(self, other: Bundle | int) -> Bundle:
        return self._paired("and", other)

    def __or__(self, other: Bundle | int) -> Bundle:
        return self._paired("or", other)

    def __invert__(self) -> Bundle:
        return self._paired("xor", True)

    def __lshift__(self, places: int) -> Bundle:
        return self._paired("shl", places)

    def __rshift__(self, places: int) -> Bundle:
        return self._paired("ashr", places)

    def compare(self, how: str, other: Bundle | float) -> Bundle:
        """True where the comparison holds: olt, ole, ogt, oge, oeq, une, uno as in LLVM."""
        return self.made(f"fcmp {how} {{type}} {{0}}, {{1}}", TRUTH, other)

    def times_plus(self, factor: Bundle | float, term: Bundle | float) -> Bundle:
        """The product plus a term, rounded once where the processor can do that."""
        return self.called("fmuladd", factor, term)

    def times_plus_exactly(self, factor: Bundle | float, term: Bundle | float) -> Bundle:
        """The product plus a term, rounded once whatever it costs."""
        return self.called("fma", factor, term)

    def called(self, intrinsic: str, *others: Bundle | float) -> Bundle:
        """An intrinsic function of LLVM."""
        places = ", ".join(f"{NUMBER} {{{number}}}" for number in range(1 + len(others)))
        return self.made(f"call {NUMBER} @llvm.{intrinsic}.v{LANES}f64({places})", NUMBER, *others)

    def differs(self, other: Bundle) -> Bundle:
        """True where the bits are not the same."""
        return self.made("icmp ne {type} {0}, {1}", TRUTH, other)

    def times(self, factor: int) -> Bundle:
        """Bits as integers, multiplied."""
        return self._paired("mul", factor)

    def choose(self, yes: Bundle | float, no: Bundle | float) -> Bundle:
        """One of two where this is true, the other elsewhere."""
        model = yes if isinstance(yes, Bundle) else no if isinstance(no, Bundle) else None
        type_ = model.type if model else TRUTH if isinstance(yes, bool) else NUMBER
        first, second = (value if isinstance(value, Bundle) else self.like(value, type_) for value in (yes, no))
        return self.made(f"select {TRUTH} {{0}}, {type_} {{1}}, {type_} {{2}}", type_, first, second)

    def cast(self, type_: str, how: str = "bitcast") -> Bundle:
        """The same bits, or, with ``uitofp``, truth as 1.0 and 0.0."""
        return self.made(f"{how} {{type}} {{0}} to {type_}", type_)

    def like(self, value: float, type_: str | None = None) -> Bundle:
        """A number in all lanes of as many vectors."""
        type_ = type_ or self.type
        return Bundle(self.assembly, type_, (splat(value, type_),) * len(self.names))

    def made(self, form: str, type_: str, *others: Bundle | float) -> Bundle:
        """The answer of an instruction, written for every vector."""
        columns = [self.names, *((other if isinstance(other, Bundle) else self.like(other)).names for other in others)]
        names = tuple(self.assembly.new(form.format(*row, type=self.type)) for row in zip(*columns, strict=True))
        return Bundle(self.assembly, type_, names)

    def _paired(self, instruction: str, other: Bundle | float) -> Bundle:
        return self.made(f"{instruction} {{type}} {{0}}, {{1}}", self.type, other)


def splat(value: float, type_: str = NUMBER) -> str:
    """A constant vector."""
    if type_ == NUMBER:
        return f"splat (double {number(value)})"
    return f"splat (i64 {value})" if type_ == BITS else f"splat (i1 {str(bool(value)).lower()})"


def number(value: float) -> str:
    """A number as the bits that it has."""
    return f"0x{struct.pack('>d', value).hex().upper()}"


def joined(bundles: Sequence[Bundle]) -> Bundle:
    """Several bundles as one."""
    return Bundle(bundles[0].assembly, bundles[0].type, tuple(name for bundle in bundles for name in bundle.names))


def parted(bundle: Bundle, count: int) -> list[Bundle]:
    """A bundle as ``count`` of equal size."""
    size = len(bundle.names) // count
    return [
        Bundle(bundle.assembly, bundle.type, bundle.names[first : first + size])
        for first in range(0, len(bundle.names), size)
    ]


@dataclass
class Assembly:
    """The text of a function while it is being written."""

    lines: list[str] = field(default_factory=list)
    block: str = "entry"
    count: int = 0

    def function(self, head: str) -> str:
        """All that is written, as a function."""
        body = "\n".join(self.lines)
        return f"define {head} #0 {{\nentry:\n{body}\n}}\n"

    def new(self, text: str) -> str:
        """The name of what an instruction answers."""
        self.count += 1
        self.do(f"%v{self.count} = {text}")
        return f"%v{self.count}"

    def do(self, text: str) -> None:
        """An instruction without an answer."""
        self.lines.append(f"  {text}")

    def address(self, base: str, index: str | int, type_: str = "double") -> str:
        """The place of a number in an array."""
        return self.new(f"getelementptr {type_}, ptr {base}, i64 {index}")

    def scalar(self, base: str, index: str | int, type_: str = "double") -> str:
        """A number of an array."""
        return self.new(f"load {type_}, ptr {self.address(base, index, type_)}")

    def product(self, *factors: str | int) -> str:
        """A product of integers."""
        first, *rest = factors
        for factor in rest:
            first = self.new(f"mul i64 {first}, {factor}")
        return str(first)

    def load(self, bases: Sequence[str], offset: int = 0) -> Bundle:
        """A vector from each base."""
        places = [self.address(base, offset) for base in bases]
        return Bundle(self, NUMBER, tuple(self.new(f"load {NUMBER}, ptr {place}, align 8") for place in places))

    def store(self, bundle: Bundle, bases: Sequence[str], offset: int = 0) -> None:
        """A vector to each base."""
        for name, base in zip(bundle.names, bases, strict=True):
            self.do(f"store {NUMBER} {name}, ptr {self.address(base, offset)}, align 8")

    def spread(self, scalar: str, count: int, type_: str = "double") -> Bundle:
        """One number in all lanes of ``count`` vectors."""
        vector = f"<{LANES} x {type_}>"
        first = self.new(f"insertelement {vector} poison, {type_} {scalar}, i64 0")
        mask = f"<{LANES} x i32> zeroinitializer"
        return Bundle(self, vector, (self.new(f"shufflevector {vector} {first}, {vector} poison, {mask}"),) * count)

    def lanes(self, first: int) -> Bundle:
        """The numbers of the lanes of a vector."""
        return Bundle(self, BITS, (f"<{', '.join(f'i64 {first + lane}' for lane in range(LANES))}>",))

    def gather(self, base: str, index: Bundle) -> Bundle:
        """Numbers of an array, one place for each lane."""
        pointers = [self.new(f"getelementptr double, ptr {base}, {BITS} {name}") for name in index.names]
        form = f"call {NUMBER} @llvm.masked.gather.v{LANES}f64.v{LANES}p0(<{LANES} x ptr> {{}}, i32 8, {TRUTH} "
        return Bundle(
            self,
            NUMBER,
            tuple(self.new(form.format(each) + f"{splat(True, TRUTH)}, {NUMBER} poison)") for each in pointers),
        )

    def woven(self, parts: Sequence[Callable[[], T]]) -> list[T]:
        """What parts without branches answer that do not need each other, their instructions taken in turn."""
        whole, answers, pieces = self.lines, [], []
        for part in parts:
            self.lines = []
            answers.append(part())
            pieces.append(self.lines)
        order = [
            ((place + 0.5) / len(piece), number, line)
            for number, piece in enumerate(pieces)
            for place, line in enumerate(piece)
        ]
        self.lines = whole + [line for *_, line in sorted(order, key=lambda entry: entry[:2])]
        return answers

    @contextmanager
    def loop(self, first: str | int, end: str | int, step: int = 1) -> Iterator[str]:
        """What is written inside is done for an index from ``first`` on, as long as it is below ``end``."""
        label, before = self._label("loop"), self.block
        self._open(f"{label}.test")
        index = f"%{label}"
        self.do(f"{index} = phi i64 [ {first}, %{before} ], [ {index}.more, %{label}.next ]")
        self._branch(self.new(f"icmp slt i64 {index}, {end}"), f"{label}.body", f"{label}.end")
        self._begin(f"{label}.body")
        yield index
        self._open(f"{label}.next")
        self.do(f"{index}.more = add i64 {index}, {step}")
        self.do(f"br label %{label}.test")
        self._begin(f"{label}.end")

    @contextmanager
    def repeat(self, condition: Callable[[], str]) -> Iterator[None]:
        """What is written inside is done as long as the condition holds."""
        label = self._label("while")
        self._open(f"{label}.test")
        self._branch(condition(), f"{label}.body", f"{label}.end")
        self._begin(f"{label}.body")
        yield
        self.do(f"br label %{label}.test")
        self._begin(f"{label}.end")

    @contextmanager
    def when(self, condition: str) -> Iterator[None]:
        """What is written inside is done where the condition holds."""
        label = self._label("when")
        self._branch(condition, f"{label}.body", f"{label}.end")
        self._begin(f"{label}.body")
        yield
        self._open(f"{label}.end")

    def settled(self, bundle: Bundle, pointer: str) -> Bundle:
        """The same bundle, complete in all its vectors before anything that needs it is computed of one of them.

        For the compiler it may be another one: where the ``pointer`` is null, which it never is.
        """
        null = self.new(f"icmp eq ptr {pointer}, null")
        return self._amended(null, bundle, lambda: bundle.like(math.nan))

    def amended(self, where: Bundle, bundle: Bundle, amend: Callable[[], Bundle]) -> Bundle:
        """What amends a bundle where this is true in some lane; nothing is spent on it as long as it is in none."""
        return self._amended(self.any(where), bundle, amend)

    def _amended(self, condition: str, bundle: Bundle, amend: Callable[[], Bundle]) -> Bundle:
        label, before = self._label("rare"), self.block
        self._branch(condition, label, f"{label}.end")
        self._begin(label)
        new, after = amend(), self.block
        self._open(f"{label}.end")
        pairs = zip(new.names, bundle.names, strict=True)
        names = [self.new(f"phi {bundle.type} [ {yes}, %{after} ], [ {no}, %{before} ]") for yes, no in pairs]
        return Bundle(self, bundle.type, tuple(names))

    def any(self, truth: Bundle) -> str:
        """Whether something is true in any lane."""
        bits = [self.new(f"bitcast {TRUTH} {name} to i{LANES}") for name in truth.names]
        found = bits[0]
        for other in bits[1:]:
            found = self.new(f"or i{LANES} {found}, {other}")
        return self.new(f"icmp ne i{LANES} {found}, 0")

    def _label(self, kind: str) -> str:
        self.count += 1
        return f"{kind}{self.count}"

    def _open(self, label: str) -> None:
        self.do(f"br label %{label}")
        self._begin(label)

    def _begin(self, label: str) -> None:
        self.lines.append(f"{label}:")
        self.block = label

    def _branch(self, condition: str, yes: str, no: str) -> None:
        self.do(f"br i1 {condition}, label %{yes}, label %{no}")
