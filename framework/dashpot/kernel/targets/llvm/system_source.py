"""Writing a network with unknown nodes as one self-contained text of LLVM assembly.

Every pass over a group of lanes is a function of its own; the loop of ``SystemProgram`` calls them.
"""

from __future__ import annotations

from collections.abc import Sequence

from dashpot.kernel.ir.layout import LANES, Layout
from dashpot.kernel.ir.system import (
    MOST_CORRECTIONS,
    MOST_PLACES,
    MOST_STATIC_STEPS,
    MOST_STEPS,
    THIRD,
    UNBALANCED,
    UNSOLVED,
    SystemProgram,
)
from dashpot.kernel.targets.llvm.assembly import Assembly, Bundle, number
from dashpot.kernel.targets.llvm.passes import Arrays, Pass
from dashpot.kernel.targets.llvm.source import whole

ARGUMENTS = (
    "ptr %still",
    "ptr %coarse",
    "ptr %fine",
    "i64 %per",
    "i64 %samples",
    "ptr %space",
    "ptr %status",
    "ptr %tables",
    "ptr %knots",
    "ptr %measured",
    "ptr %weight",
    "ptr %out",
    "ptr %miss",
    "i64 %scoring",
    "i64 %begins",
    "i64 %course",
    "i64 %asked",
)
PASSED = ("ptr %columns", "ptr %w", "ptr %tables", "ptr %knots")


def print_system(system: SystemProgram, vectors: int, alone: bool = False) -> str:
    """The text for groups of so many ``vectors`` of lanes: the function ``run``.

    With ``alone`` all lanes of a group are the same one.

    ``still`` (1, columns), ``coarse`` and ``fine`` (steps, columns) are what drives the steps, ``per`` is the number of
    coarse steps in a sample, ``space`` (2, rows, lanes) is a workspace for each of the two, ``status`` (lanes,) stays 0
    where all goes well. Where the record ``begins`` (1), the first of the ``samples`` is the equilibrium; a later
    piece of it (0) goes on from the workspace as the piece before has left it. Without ``scoring`` it fills ``out``
    (samples, driven nodes then unknown nodes, lanes); with it, it adds weight * (force - measured)^2 to the first of
    ``out``, the other two being (samples, driven nodes).
    ``miss`` (driven nodes, lanes) gathers the squared differences of the forces of the two courses. The ``course``
    is that of ``Course``: 0 where the answer is extrapolated from both, 1 where it is that of the short steps, 2 where
    there are no long ones.
    """
    passes = (_pass(layout, name, vectors, alone) for name, layout in system.passes.items())
    return whole("run", ARGUMENTS, _run(system, vectors)) + "".join(passes)


def _run(system: SystemProgram, vectors: int) -> Assembly:
    a, width, done = Assembly(), LANES * vectors, system.row(system.done)
    a.do("%left = alloca i64")
    halves = ["%space", a.address("%space", system.rows * width)]
    finer = a.new("mul i64 %per, 2")
    long = a.new(f"select i1 {a.new('icmp eq i64 %course, 2')}, i64 0, i64 %per")
    with a.when(a.new("icmp ne i64 %begins, 0")):
        for space in halves:
            _call(a, "start", "%still", space)
            _newton(a, "settle", "%still", space, MOST_STATIC_STEPS, UNBALANCED, done, vectors)
            _call(a, "rest", "%still", space)
            _newton(a, "launch", "%still", space, MOST_PLACES, None, done, vectors)
            _call(a, "set_off", "%still", space)
    with a.loop(0, "%samples") as k:
        before = a.new(f"sub i64 {k}, %begins")
        with a.when(a.new(f"icmp sge i64 {before}, 0")):
            for space, columns, count in zip(halves, ("%coarse", "%fine"), (long, finer), strict=True):
                first = a.product(before, count)
                with a.loop(first, a.new(f"add i64 {first}, {count}")) as j:
                    row = a.address(columns, a.product(j, len(system.program.columns)))
                    _call(a, "predict", row, space)
                    if system.turns and system.kept:
                        with a.when(_some(a, space, system.row(system.turns), vectors)):
                            _call(a, "turn", row, space)
                        with a.when(_some(a, space, system.row(system.kept), vectors)):
                            _newton(a, "correct", row, space, MOST_CORRECTIONS, None, done, vectors)
                    _newton(a, "improve", row, space, MOST_STEPS, None, done, vectors)
                    _newton(a, "search", row, space, MOST_PLACES, UNSOLVED, done, vectors)
                    _call(a, "commit", row, space)
        writer = _Writer(a, halves, vectors, k)
        forces = [system.row(name) for name in system.forces]
        places = [system.row(name) for name in system.places]
        with a.when(a.new("icmp eq i64 %scoring, 0")):
            writer.store([*forces, *places], len(forces))
        with a.when(a.new("icmp ne i64 %scoring, 0")):
            writer.score(forces)
    a.do("ret void")
    return a


class _Writer:
    """What is made of both courses at a sample."""

    def __init__(self, a: Assembly, halves: Sequence[str], vectors: int, k: str) -> None:
        self.a, self.halves, self.vectors, self.width, self.k = a, halves, vectors, LANES * vectors, k
        short = a.new("icmp ne i64 %course, 0")
        self.ahead = a.spread(a.new(f"select i1 {short}, double 0.0, double {number(THIRD)}"), vectors)

    def store(self, rows: Sequence[int], driven: int) -> None:
        """Fill the next row of ``out``."""
        first = self.a.product(self.k, len(rows))
        for order, row in enumerate(rows):
            best, gap = self._best(row)
            place = self.a.product(self.a.new(f"add i64 {first}, {order}"), self.width)
            self.a.store(best, self._places(self.a.address("%out", place)))
            if order < driven:
                self._add("%miss", order, gap, gap)

    def score(self, rows: Sequence[int]) -> None:
        """Add to the scores."""
        first = self.a.product(self.k, len(rows))
        for order, row in enumerate(rows):
            best, gap = self._best(row)
            place = self.a.new(f"add i64 {first}, {order}")
            away = best - self.a.spread(self.a.scalar("%measured", place), self.vectors)
            self._add("%out", order, away * self.a.spread(self.a.scalar("%weight", place), self.vectors), away)
            self._add("%miss", order, gap, gap)

    def _best(self, row: int) -> tuple[Bundle, Bundle]:
        long, short = (self.a.load(self._places(half), row * self.width) for half in self.halves)
        gap = short - long
        return gap.times_plus(self.ahead, short), gap

    def _add(self, array: str, order: int, first: Bundle, second: Bundle) -> None:
        places = self._places(array)
        before = self.a.load(places, order * self.width)
        self.a.store(first.times_plus(second, before), places, order * self.width)

    def _places(self, base: str) -> list[str]:
        return _places(self.a, base, self.vectors)


def _places(a: Assembly, base: str, vectors: int) -> list[str]:
    return [a.address(base, LANES * order) for order in range(vectors)]


def _pass(layout: Layout, name: str, vectors: int, alone: bool) -> str:
    # a function of its own: the compiler's work grows faster than the length of a function
    a = Assembly()
    Pass(a, layout, Arrays("%columns", _places(a, "%w", vectors)), alone).write()
    a.do("ret void")
    return a.function(f"internal void @{name}({', '.join(PASSED)})")


def _some(a: Assembly, space: str, row: int, vectors: int) -> str:
    """Whether a row is not zero in some lane."""
    return a.any(a.load(_places(a, space, vectors), row * LANES * vectors).compare("une", 0.0))


def _call(a: Assembly, name: str, columns: str, space: str) -> None:
    a.do(f"call void @{name}(ptr {columns}, ptr {space}, ptr %tables, ptr %knots)")


def _newton(
    a: Assembly, name: str, columns: str, space: str, most: int, failure: int | None, row: int, vectors: int
) -> None:
    """Steps until every lane is done, ``most`` of them at most; what is left then has failed, if there is a code.

    A lane that was not solved in an earlier step is not waited for.
    """

    def undone() -> Bundle:
        left = a.load(_places(a, space, vectors), row * LANES * vectors).compare("oeq", 0.0)
        return left & a.load(_places(a, "%status", vectors)).compare("une", float(UNSOLVED))

    def going_on() -> str:
        left = a.new("load i64, ptr %left")
        some, allowed = a.any(undone()), a.new(f"icmp sgt i64 {left}, 0")
        return a.new(f"and i1 {some}, {allowed}")

    a.do(f"store i64 {most}, ptr %left")
    with a.repeat(going_on):
        _call(a, name, columns, space)
        a.do(f"store i64 {a.new('sub i64 ' + a.new('load i64, ptr %left') + ', 1')}, ptr %left")
    if failure is None:
        return
    found = undone()
    with a.when(a.any(found)):
        places = _places(a, "%status", vectors)
        failed = found.choose(float(failure), a.load(places))
        a.store(failed, places)
