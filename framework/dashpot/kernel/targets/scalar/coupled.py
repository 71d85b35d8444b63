"""A network with unknown nodes, sample by sample: ``advance(s, dt, p)`` on the memory of ``Online``.

Between two samples the driven nodes follow the quintic through their positions, velocities and accelerations, loads go
straight. The memory holds a workspace for the long steps and one for the short ones, as ``SystemProgram`` says.
"""

from __future__ import annotations

from collections.abc import Callable

from dashpot.expr.node import Node
from dashpot.kernel.ir.layout import Layout
from dashpot.kernel.ir.online import BEGUN, DT, INPUTS, MOTION, SPAN, STATUS, STEPS, Online
from dashpot.kernel.ir.system import (
    FARTHEST,
    MOST_CORRECTIONS,
    MOST_PLACES,
    MOST_STATIC_STEPS,
    MOST_STEPS,
    THIRD,
    TOLERANCE,
    UNBALANCED,
    UNSOLVED,
    SystemProgram,
)
from dashpot.kernel.targets.scalar.code import MEMORY, Arguments, Code
from dashpot.kernel.targets.scalar.graph import truth
from dashpot.kernel.targets.scalar.high_order import EULER, give_others, write_high_order
from dashpot.kernel.targets.scalar.motion import give, write_motion
from dashpot.kernel.targets.scalar.online import storing, write_common

COURSE: Arguments = [("array", "s"), ("count", "w")]
PARTS = (2, 4)  # of a sample, for long steps and for short ones
SAME = 1e-6  # share of a step by which one may differ that is the same: differences of times are rounded


def write_coupled(code: Code, online: Online) -> None:
    """All functions of a network with unknown nodes."""
    assert online.system is not None
    write_common(code, online)
    for name, layout in online.system.passes.items():
        with code.function("nothing", f"{name}_", COURSE, f"Pass '{name}' on the workspace that begins at w."):
            storing(code, online, _moved(layout), _leaf(code, online, layout))
    _write_newton(code, online.system, "settle", MOST_STATIC_STEPS, UNBALANCED)
    _write_newton(code, online.system, "launch", MOST_PLACES)
    _write_newton(code, online.system, "improve", MOST_STEPS)
    _write_newton(code, online.system, "search", MOST_PLACES, UNSOLVED)
    if online.system.kept:
        _write_newton(code, online.system, "correct", MOST_CORRECTIONS)
    write_motion(code, online)
    _write_rules(code, online)
    _write_course(code, online)
    _write_begin(code, online)
    if online.high_order:
        write_high_order(code, online)
    with code.function("nothing", "advance", MEMORY, "The step to the inputs: fills the outputs."):
        with code.when(f"s[{DT}] != dt"):
            if online.high_order:
                with code.when(f"(fabs(s[{DT}] - dt) > {SAME} * dt) & (s[{STEPS}] > 0.0)"):  # those taken were others
                    code.set(f"s[{STEPS}]", "0.0")
            code.do("prepare(s, dt, p)")
        with code.when(f"s[{BEGUN}] == 0.0"):
            _begin(code, online)
        with code.otherwise():
            _go_on(code, online)
            code.set(f"s[{BEGUN}]", "2.0")
        _answer(code, online)


def _go_on(code: Code, online: Online) -> None:
    if not online.high_order:
        _write_courses(code, online)
        return
    with code.when(f"s[{STEPS}] >= 0.0"):
        code.do("high_order(s, dt)")
    with code.when(f"s[{STEPS}] < 0.0"):
        _write_courses(code, online)


def _write_courses(code: Code, online: Online) -> None:
    for start, parts in zip(online.courses, PARTS, strict=True):
        code.do(f"course(s, {code.index(start)}, {code.index(parts)}, dt)")


def _moved(layout: Layout) -> dict[str, Node]:
    return {f"s[w + {layout.states[name]}]": node for name, node in layout.updates.items()}


def _leaf(code: Code, online: Online, layout: Layout) -> Callable[[Node], str | None]:
    known = {name: f"s[{online.motion + number}]" for number, name in enumerate(online.known)}

    def leaf(node: Node) -> str | None:
        if node.operation == "constant":
            return code.number(node.payload)
        if node.serial in layout.constants:
            return truth(node, f"s[w + {layout.constants[node.serial]}]")
        if node.operation != "symbol":
            return None
        return known[node.payload] if node.payload in known else f"s[w + {layout.states[node.payload]}]"

    return leaf


def _write_newton(code: Code, system: SystemProgram, name: str, most: int, failure: int | None = None) -> None:
    done = f"s[w + {system.row(system.done)}]"
    with code.function("nothing", name, COURSE, "Newton's steps until they are short."):
        code.let("left", str(most), "count")
        with code.repeat(f"(left > 0) & ({done} == 0.0)"):
            code.do(f"{name}_(s, w)")
            code.set("left", "left - 1")
        if failure is not None:
            with code.when(f"{done} == 0.0"):
                code.set(f"s[{STATUS}]", f"{failure}.0")


def _write_course(code: Code, online: Online) -> None:
    arguments: Arguments = [*COURSE, ("count", "parts"), ("number", "dt")]
    with code.function("nothing", "course", arguments, "All steps from one sample to the next."):
        code.let("h", "dt / parts")
        give(code, online, "dt", "h")
        with code.loop("j", 0, "parts"):
            code.do("move(s, j / (1.0 * parts), (j + 1) / (1.0 * parts), dt)")
            code.let("number", "j % 2", "count")
            with code.when(f"(j == 0) & (s[{BEGUN}] == 1.0)"):
                code.set("number", f"{EULER}")
            code.do("rule(s, number, h)")
            for name in ("predict_", "improve", "search", "commit_"):
                code.do(f"{name}(s, w)")


def _write_rules(code: Code, online: Online) -> None:
    """Those of ``kernel.scheme``: trapezoidal, backward differences, Euler's for the very first step."""
    rules = (("2.0", "-2.0", "0.0", "-1.0"), ("1.5", "-2.0", "0.5", "0.0"), ("1.0", "-1.0", "0.0", "0.0"))
    arguments: Arguments = [("array", "s"), ("count", "number"), ("number", "h")]
    with code.function("nothing", "rule", arguments, "The rule of a step of h seconds."):
        for number, (slope, now, before, swing) in enumerate(rules):
            with code.when(f"number == {number}"):
                for key, value in (("slope", slope), ("now", now), ("before", before)):
                    give(code, online, f"rule.{key}", f"{value} / h")
                give(code, online, "rule.swing", swing)
                if online.high_order:
                    give_others(code, online, f"{slope} / h", "0.0", "1.0")


def _write_begin(code: Code, online: Online) -> None:
    arguments: Arguments = [*COURSE, ("number", "dt")]
    with code.function("nothing", "begin", arguments, "The first sample."):
        for name, value in (("slope", "1.0 / dt"), ("now", "0.0"), ("before", "0.0"), ("swing", "0.0")):
            give(code, online, f"rule.{name}", value)
        if online.high_order:
            give_others(code, online, "0.0", "0.0", "0.0")
        give(code, online, "dt", "dt")
        for name in ("start_", "settle", "rest_", "launch", "set_off_"):
            code.do(f"{name}(s, w)")


def _begin(code: Code, online: Online) -> None:
    give(code, online, "newton.tolerance", f"{TOLERANCE} * s[{SPAN}]")
    give(code, online, "newton.farthest", f"{FARTHEST} * s[{SPAN}]")
    with code.loop("k", 0, online.inputs):
        code.set(f"s[{online.before} + k]", f"s[{INPUTS} + k]")
    code.do("move(s, 1.0, 1.0, dt)")
    long, short = map(code.index, online.courses)
    code.do(f"begin(s, {long}, dt)")
    if online.high_order:
        code.do(f"try_high_order(s, dt / {PARTS[0]}.0)")
    code.do(f"begin(s, {short}, dt)")
    code.set(f"s[{BEGUN}]", "1.0")


def _answer(code: Code, online: Online) -> None:
    assert online.system is not None
    long, short = online.courses
    rows = [online.system.row(name) for name in (*online.system.forces, *online.system.places)]
    best = [f"s[{short + row}] + {THIRD!r} * (s[{short + row}] - s[{long + row}])" for row in rows]
    if online.high_order:
        with code.when(f"s[{STEPS}] >= 0.0"):
            _write_answers(code, online, [f"s[{long + row}]" for row in rows])
        with code.otherwise():
            _write_answers(code, online, best)
    else:
        _write_answers(code, online, best)
    for number, joint in enumerate(online.free):
        if joint in online.mounts:
            place = f"s[{online.outputs + len(online.driven) + number}]"
            moved = INPUTS + len(MOTION) * online.driven.index(online.mounts[joint])
            code.set(place, f"{place} + s[{moved}]")
    with code.loop("k", 0, online.inputs):
        code.set(f"s[{online.before} + k]", f"s[{INPUTS} + k]")


def _write_answers(code: Code, online: Online, values: list[str]) -> None:
    for number, value in enumerate(values):
        code.set(f"s[{online.outputs + number}]", value)
