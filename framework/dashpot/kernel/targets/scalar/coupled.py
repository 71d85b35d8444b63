"""A network with unknown nodes, sample by sample: ``advance(s, dt, p)`` on the memory of ``Online``.

Between two samples the driven nodes follow the quintic through their positions, velocities and accelerations, loads go
straight. The memory holds a workspace for the long steps and one for the short ones, as ``SystemProgram`` says.
"""

from __future__ import annotations

from collections.abc import Callable

from dashpot.expr.node import Node
from dashpot.kernel.ir.layout import Layout
from dashpot.kernel.ir.online import BEGUN, DT, INPUTS, MOTION, SPAN, STATUS, Online
from dashpot.kernel.ir.system import (
    FARTHEST,
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
from dashpot.kernel.targets.scalar.online import storing, write_common

COURSE: Arguments = [("array", "s"), ("count", "w")]
PARTS = (2, 4)  # of a sample, for long steps and for short ones


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
    _write_path(code)
    _write_move(code, online)
    _write_course(code, online)
    with code.function("nothing", "advance", MEMORY, "The step to the inputs: fills the outputs."):
        with code.when(f"s[{DT}] != dt"):
            code.do("prepare(s, dt, p)")
        with code.when(f"s[{BEGUN}] == 0.0"):
            _begin(code, online)
        with code.otherwise():
            for start, parts in zip(online.courses, PARTS, strict=True):
                code.do(f"course(s, {code.index(start)}, {code.index(parts)}, dt)")
            code.set(f"s[{BEGUN}]", "2.0")
        _answer(code, online)


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


def _write_path(code: Code) -> None:
    """The quintic and its derivatives at a share u of the step; ``i`` and ``o`` are where the motion stands."""
    arguments: Arguments = [
        ("array", "s"),
        ("count", "o"),
        ("count", "i"),
        ("number", "u"),
        ("number", "dt"),
        ("count", "order"),
    ]
    with code.function("number", "path", arguments, "Place, velocity or acceleration between two samples."):
        code.let("far", "s[i] - s[o] - dt * (s[o + 1] + 0.5 * dt * s[o + 2])")
        code.let("fast", "dt * (s[i + 1] - s[o + 1] - dt * s[o + 2])")
        code.let("bent", "0.5 * dt * dt * (s[i + 2] - s[o + 2])")
        code.let("c3", "10.0 * far - 4.0 * fast + bent")
        code.let("c4", "-15.0 * far + 7.0 * fast - 2.0 * bent")
        code.let("c5", "6.0 * far - 3.0 * fast + bent")
        with code.when("u == 1.0"):
            code.answer("s[i + order]")
        with code.when("order == 0"):
            code.answer("s[o] + u * (dt * s[o + 1] + u * (0.5 * dt * dt * s[o + 2] + u * (c3 + u * (c4 + u * c5))))")
        with code.when("order == 1"):
            rest = "u * (dt * dt * s[o + 2] + u * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5)))"
            code.answer(f"(dt * s[o + 1] + {rest}) / dt")
        code.answer("(dt * dt * s[o + 2] + u * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5))) / (dt * dt)")


def _write_move(code: Code, online: Online) -> None:
    arguments: Arguments = [("array", "s"), ("number", "before"), ("number", "now"), ("number", "dt")]
    with code.function("nothing", "move", arguments, "The motion within a step, between two shares of a sample."):
        for number, joint in enumerate(online.driven):
            places = f"s, {online.before + len(MOTION) * number}, {INPUTS + len(MOTION) * number}"
            moved = {
                "old": ("before", 0),
                "new": ("now", 0),
                "velocity_old": ("before", 1),
                "velocity_new": ("now", 1),
                "acceleration": ("now", 2),
            }
            for key, (share, order) in moved.items():
                _give(code, online, f"node:{joint}.{key}", f"path({places}, {share}, dt, {order})")
        for number, joint in enumerate(online.loaded, len(MOTION) * len(online.driven)):
            old, new = f"s[{online.before + number}]", f"s[{INPUTS + number}]"
            _give(code, online, f"node:{joint}.load", f"{old} + now * ({new} - {old})")


def _give(code: Code, online: Online, name: str, value: str) -> None:
    code.set(f"s[{online.motion + online.known.index(name)}]", value)


def _write_course(code: Code, online: Online) -> None:
    """The rules are those of ``kernel.scheme``."""
    arguments: Arguments = [("array", "s"), ("count", "w"), ("count", "parts"), ("number", "dt")]
    with code.function("nothing", "course", arguments, "All steps from one sample to the next."):
        code.let("h", "dt / parts")
        _give(code, online, "dt", "h")
        with code.loop("j", 0, "parts"):
            code.do("move(s, j / (1.0 * parts), (j + 1) / (1.0 * parts), dt)")
            code.let("rule", "j % 2", "count")
            with code.when(f"(j == 0) & (s[{BEGUN}] == 1.0)"):
                code.set("rule", "2")
            _write_rule(code, online)
            code.do("predict_(s, w)")
            code.do("improve(s, w)")
            code.do("search(s, w)")
            code.do("commit_(s, w)")


def _write_rule(code: Code, online: Online) -> None:
    # trapezoidal, backward differences, and Euler's for the very first step
    rules = (("2.0", "-2.0", "0.0", "-1.0"), ("1.5", "-2.0", "0.5", "0.0"), ("1.0", "-1.0", "0.0", "0.0"))
    for number, (slope, now, before, swing) in enumerate(rules):
        with code.when(f"rule == {number}"):
            for key, value in (("slope", slope), ("now", now), ("before", before)):
                _give(code, online, f"rule.{key}", f"{value} / h")
            _give(code, online, "rule.swing", swing)
            if online.system and online.system.turns:
                _give(code, online, "rule.pull", f"{slope} / h")


def _begin(code: Code, online: Online) -> None:
    assert online.system is not None
    for name, value in (("slope", "1.0 / dt"), ("now", "0.0"), ("before", "0.0"), ("swing", "0.0")):
        _give(code, online, f"rule.{name}", value)
    _give(code, online, "dt", "dt")
    _give(code, online, "newton.tolerance", f"{TOLERANCE} * s[{SPAN}]")
    _give(code, online, "newton.farthest", f"{FARTHEST} * s[{SPAN}]")
    with code.loop("k", 0, online.inputs):
        code.set(f"s[{online.before} + k]", f"s[{INPUTS} + k]")
    code.do("move(s, 1.0, 1.0, dt)")
    for start in online.courses:
        for name in ("start_", "settle", "rest_", "launch", "set_off_"):
            code.do(f"{name}(s, {code.index(start)})")
    code.set(f"s[{BEGUN}]", "1.0")


def _answer(code: Code, online: Online) -> None:
    assert online.system is not None
    long, short = online.courses
    for number, name in enumerate((*online.system.forces, *online.system.places)):
        row = online.system.row(name)
        value = f"s[{short + row}] + {THIRD!r} * (s[{short + row}] - s[{long + row}])"
        code.set(f"s[{online.outputs + number}]", value)
    for number, joint in enumerate(online.free):
        if joint in online.mounts:
            place = f"s[{online.outputs + len(online.driven) + number}]"
            moved = INPUTS + len(MOTION) * online.driven.index(online.mounts[joint])
            code.set(place, f"{place} + s[{moved}]")
    with code.loop("k", 0, online.inputs):
        code.set(f"s[{online.before} + k]", f"s[{INPUTS} + k]")
