"""Writing a sorted network as one self-contained text of LLVM assembly.

A group of lanes goes through the whole record: its constants and states stay in the nearest cache, and the states of
several vectors move side by side. At turning points of the drive only the states of rate-independent branches move;
then comes the step itself. Where an event is due, states are corrected before.
"""

from __future__ import annotations

from collections.abc import Sequence

from dashpot.kernel.ir.layout import LANES, Passes, score_row
from dashpot.kernel.ir.program import Program
from dashpot.kernel.targets.llvm.assembly import Assembly, Bundle
from dashpot.kernel.targets.llvm.library import library_functions
from dashpot.kernel.targets.llvm.passes import Arrays, Pass

# the machine's full width; without the word LLVM halves the vectors of many processors
ATTRIBUTES = 'attributes #0 = { nounwind "prefer-vector-width"="512" }\n'
ARGUMENTS = (
    "ptr %columns",
    "ptr %index",
    "ptr %local",
    "i64 %samples",
    "ptr %turn_at",
    "ptr %turn_columns",
    "ptr %tables",
    "ptr %w",
    "ptr %measured",
    "ptr %weight",
    "ptr %out",
    "i64 %asked",
)


def print_source(program: Program, vectors: int, alone: bool = False) -> str:
    """The text of a network for groups of so many ``vectors`` of lanes: the function ``run``.

    With ``alone`` all lanes of a group are the same one. However many lanes are ``asked`` for, all are computed.

    It takes ``columns`` (samples, columns), ``index`` and ``local`` (samples, lookups), ``turn_at`` (turns + 1,),
    ``turn_columns`` (turns, columns), ``tables`` (segments, 4, lanes), the workspace ``w`` (rows, lanes), ``measured``
    and ``weight`` (samples,), ``out`` (samples, lanes). It fills ``out``; where that is null it adds weight *
    (force - measured)^2 to the last row of ``w`` instead.
    """
    a, passes = Assembly(), Passes.of(program)
    bases = [a.address("%w", LANES * number) for number in range(vectors)]
    width, across = LANES * vectors, len(program.columns)
    a.do("%turn = alloca i64")
    a.do("store i64 0, ptr %turn")
    storing = a.new("icmp ne ptr %out, null")
    with a.loop(0, "%samples") as k:
        if passes.turn:
            with a.repeat(lambda: _turns_at(a, k)):
                number = a.new("load i64, ptr %turn")
                arrays = Arrays(a.address("%turn_columns", a.product(number, across)), bases)
                _correct(a, passes, arrays, program, alone)
                Pass(a, passes.turn, arrays, alone).write()
                a.do(f"store i64 {a.new(f'add i64 {number}, 1')}, ptr %turn")
        looked = a.product(k, len(program.lookups))
        arrays = Arrays(
            a.address("%columns", a.product(k, across)),
            bases,
            index=a.address("%index", looked, "i64"),
            local=a.address("%local", looked),
        )
        _correct(a, passes, arrays, program, alone)
        step = Pass(a, passes.step, arrays, alone)
        step.write()
        force = step.number(program.force)
        with a.when(storing):
            place = a.address("%out", a.product(k, width))
            a.store(force, [a.address(place, LANES * number) for number in range(vectors)])
        with a.when(a.new("icmp eq ptr %out, null")):
            _score(step, force, score_row(program), k)
    a.do("ret void")
    return whole("run", ARGUMENTS, a)


def whole(name: str, arguments: Sequence[str], a: Assembly) -> str:
    """A text with one function."""
    return "\n".join([library_functions(), a.function(f"void @{name}({', '.join(arguments)})"), ATTRIBUTES])


def _turns_at(a: Assembly, k: str) -> str:
    # the list of turning points ends with one that is never reached
    number = a.new("load i64, ptr %turn")
    return a.new(f"icmp eq i64 {a.scalar('%turn_at', number, 'i64')}, {k}")


def _correct(a: Assembly, passes: Passes, arrays: Arrays, program: Program, alone: bool) -> None:
    if passes.correct is None:
        return
    due = [
        a.new(f"fcmp une double {a.scalar(arrays.columns, passes.correct.columns[event.serial])}, 0.0")
        for event in program.events
    ]
    some = due[0]
    for other in due[1:]:
        some = a.new(f"or i1 {some}, {other}")
    with a.when(some):
        Pass(a, passes.correct, arrays, alone).write()


def _score(step: Pass, force: Bundle, row: int, k: str) -> None:
    a, count = step.assembly, len(force.names)
    miss = force - a.spread(a.scalar("%measured", k), count)
    weighed = miss * a.spread(a.scalar("%weight", k), count)
    step.store(row, weighed.times_plus(miss, step.load(row)))
