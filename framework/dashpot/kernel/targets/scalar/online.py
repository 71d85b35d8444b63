"""A network with two ends, sample by sample: the function ``advance(s, dt, p)`` on the memory of ``Online``.

It does what the kernel for whole records does. What that knows of a record beforehand, this finds at every sample: the
turning points of the cubic path since the last one, the followers of the drive, the places in the tables.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from dashpot.expr.node import Node, symbols_of, walk
from dashpot.kernel.ir.layout import Layout, Passes
from dashpot.kernel.ir.online import BEGUN, DT, INPUTS, Online
from dashpot.kernel.targets.scalar.code import MEMORY, Arguments, Code
from dashpot.kernel.targets.scalar.functions import write_functions, write_tables, write_tabulate
from dashpot.kernel.targets.scalar.graph import Writer, truth
from dashpot.kernel.targets.scalar.prepare import write_prepare

STILL = {"old": "xo", "new": "x", "velocity_old": "vo", "velocity_new": "v", "acceleration": "a"}
PATH = {"old": "xo", "new": "x", "velocity_old": "wo", "velocity_new": "w", "acceleration": "wa"}
SAMPLE = {
    **{f"still.{key}": name for key, name in STILL.items()},
    **{f"path.{key}": name for key, name in PATH.items()},
    "monotone.old": "since",
    "monotone.new": "x",
    "dt": "dt",
}
TURN = {"monotone.old": "since", "monotone.new": "x", "dt": "dt"}
TURNED: Arguments = [("array", "s"), ("number", "dt"), ("number", "since"), ("number", "x")]
Leaf = Callable[[Node], str | None]


def write_parallel(code: Code, online: Online) -> None:
    """All functions of a network with two ends."""
    write_common(code, online)
    passes = Passes.of(online.program)
    correct = _write_correct(code, online, passes)
    if passes.turn:
        _write_turn(code, online, passes, correct)
        _write_turns(code)
    with code.function("nothing", "advance", MEMORY, "The step to the inputs: fills the outputs."):
        with code.when(f"s[{DT}] != dt"):
            code.do("prepare(s, dt, p)")
        _read_motion(code, online, bool(passes.turn))
        _correct(code, online, passes, SAMPLE, correct)
        _step(code, online, passes.step)


def write_common(code: Code, online: Online) -> None:
    """Functions, tables, and what is made of the parameters."""
    nodes = walk([*_roots(online), *online.program.constants])
    write_functions(code, {node.operation for node in nodes})
    if online.knots:
        code.write("")
        code.numbers("knots", online.knots)
        write_tables(code, {node.payload[1] for node in nodes if node.operation in ("table", "lookup")})
        write_tabulate(code)
    write_prepare(code, online)


def storing(code: Code, online: Online, moved: Mapping[str, Node], leaf: Leaf, together: bool = False) -> None:
    """New values at some places of the memory; long functions ``together`` where that pays, at every sample."""

    def look_up(node: Node, argument: str) -> str:
        curve, order = node.payload
        shelf = online.shelves[curve]
        place = ", ".join(map(code.index, (online.tables, shelf.base, shelf.count)))
        return f"table{order}(s, {place}, {argument})"

    writer = Writer(code, moved.values(), leaf, look_up)
    if together:
        writer.compute_together()
    writer.store(moved)


def _roots(online: Online) -> list[Node]:
    program = online.program
    if online.system:
        return [node for layout in online.system.passes.values() for node in layout.updates.values()]
    laws = [program.followers[name] for name in online.followers]
    return [program.force, *program.updates.values(), *program.corrections.values(), *program.events, *laws]


def _leaf(code: Code, online: Online, layout: Layout, motion: Mapping[str, str]) -> Leaf:
    start = online.courses[0]
    known = {**motion, **_following(online, motion)}

    def leaf(node: Node) -> str | None:
        if node.operation == "constant":
            return code.number(node.payload)
        if node.serial in layout.constants:
            return truth(node, f"s[{start + layout.constants[node.serial]}]")
        if node.serial in layout.columns and not symbols_of(node) <= {*known}:
            return code.number(0.0)  # a column that is not known at a turning point
        if node.operation != "symbol":
            return None
        return known[node.payload] if node.payload in known else f"s[{start + layout.states[node.payload]}]"

    return leaf


def _moved(online: Online, layout: Layout) -> dict[str, Node]:
    return {f"s[{online.courses[0] + layout.states[name]}]": node for name, node in layout.updates.items()}


def _write_correct(code: Code, online: Online, passes: Passes) -> str:
    """The function of the corrections that samples and turning points share; none where they differ."""
    if not passes.turn or passes.correct is None:
        return ""
    texts = []
    for motion in (SAMPLE, TURN):
        first, code.count = len(code.lines), 0
        with code.function("nothing", "correct", TURNED, "What comes before the step where the direction changes."):
            storing(code, online, _moved(online, passes.correct), _leaf(code, online, passes.correct, motion))
        texts.append(code.lines[first:])
        del code.lines[first:]
    read = {name for node in passes.correct.updates.values() for name in symbols_of(node)}
    if texts[0] != texts[1] or "monotone.old" not in read:
        return ""
    code.lines += texts[1]
    return "correct(s, dt, since, x)"


def _correct(code: Code, online: Online, passes: Passes, motion: Mapping[str, str], call: str) -> None:
    if passes.correct is None:
        return
    known = {*motion, *_following(online, motion)}
    due = [event for event in online.program.events if symbols_of(event) <= known]
    if not due:
        return
    leaf = _leaf(code, online, passes.correct, motion)
    writer = Writer(code, due, leaf)
    condition = " | ".join(f"({writer.value(event)})" for event in due)
    with code.when(condition):
        if call:
            code.do(call)
        else:
            storing(code, online, _moved(online, passes.correct), leaf)


def _follow(code: Code, online: Online, motion: Mapping[str, str], layout: Layout) -> None:
    laws = {place: online.program.followers[name] for name, place in _following(online, motion).items()}
    storing(code, online, laws, _leaf(code, online, layout, motion))


def _following(online: Online, motion: Mapping[str, str]) -> dict[str, str]:
    # the followers whose laws can be told from this motion
    return {
        name: f"s[{online.following + k}]"
        for k, name in enumerate(online.followers)
        if symbols_of(online.program.followers[name]) <= set(motion)
    }


def _write_turn(code: Code, online: Online, passes: Passes, correct: str) -> None:
    with code.function("nothing", "turn", TURNED, "At a turning point only memories without rates move."):
        assert passes.turn is not None
        _correct(code, online, passes, TURN, correct)
        storing(code, online, _moved(online, passes.turn), _leaf(code, online, passes.turn, TURN), together=True)
        _follow(code, online, TURN, passes.turn)


def _write_turns(code: Code) -> None:
    _write_turn_at(code)
    arguments: Arguments = [
        ("array", "s"),
        ("number", "dt"),
        ("number", "xo"),
        ("number", "x"),
        ("number", "vo"),
        ("number", "v"),
    ]
    about = "Turns wherever the cubic path does since the last sample; answers where it last did."
    with code.function("number", "turns", arguments, about):
        code.let("since", "xo")
        code.let("rise", "(1.0 / dt) * (x - xo)")  # the factor is the same at every sample
        code.let("c", "3.0 * (vo + v) - 6.0 * rise")
        code.let("b", "v - vo - c")
        code.let("middle", "vo + 0.5 * b")
        for name in ("free", "root", "q", "first", "second"):
            code.let(name, "0.0")
        # the velocity lies between its control points: as long as these have one sign it turns nowhere
        with code.when("(vo * middle <= 0.0) | (middle * v <= 0.0)"):
            code.set("free", "b * b - 4.0 * vo * c")
            with code.when("free > 0.0"):
                _write_roots(code)
        code.answer("since")


def _write_turn_at(code: Code) -> None:
    path: Arguments = [("number", name) for name in ("since", "xo", "vo", "b", "c", "u")]
    about = "Turns where the cubic path is at u if that lies in the step; answers where it last turned."
    with code.function("number", "turn_at", [("array", "s"), ("number", "dt"), *path], about):
        code.let("there", "since")
        with code.when("(u > 0.0) & (u < 1.0)"):
            code.set("there", "xo + dt * u * (vo + u * (b / 2.0 + u * c / 3.0))")
            code.do("turn(s, dt, since, there)")
        code.answer("there")


def _write_roots(code: Code) -> None:
    """The roots of vo + b u + c u^2 between 0 and 1, the earlier one first."""
    code.set("root", "sqrt(free)")
    with code.when("b < 0.0"):
        code.set("root", "-root")
    code.set("q", "-0.5 * (b + root)")
    code.set("first", "-1.0")
    with code.when("c != 0.0"):
        code.set("first", "q / c")
    code.set("second", "vo / q")
    with code.when("second < first"):
        code.set("root", "first")
        code.set("first", "second")
        code.set("second", "root")
    with code.when("first != second"):
        for root in ("first", "second"):
            code.set("since", f"turn_at(s, dt, since, xo, vo, b, c, {root})")


def _read_motion(code: Code, online: Online, turning: bool) -> None:
    begin = {"x": INPUTS, "v": INPUTS + 1, "a": INPUTS + 2, "xo": online.before, "vo": online.before + 1}
    read = {SAMPLE[name] for root in _roots(online) for name in symbols_of(root) if name in SAMPLE}
    needed = {"x", "v"} | read | ({"xo", "vo"} if turning else set())
    needed |= {source for name, source in (("since", "xo"), ("wo", "vo"), ("wa", "a")) if name in needed}
    for name, place in begin.items():
        if name in needed:
            code.let(name, f"s[{place}]")
    for name, source in (("w", "v"), ("wo", "vo"), ("wa", "a"), ("since", "xo")):
        if name in needed:
            code.let(name, source)
    with code.when(f"s[{BEGUN}] == 0.0"):
        # a branch with memory has not moved when the record begins
        for name, value in (("xo", "x"), ("vo", "v"), ("since", "x"), ("w", "0.0"), ("wo", "0.0"), ("wa", "0.0")):
            if name in needed:
                code.set(name, value)
        code.set(f"s[{BEGUN}]", "1.0")
    if turning:
        with code.otherwise():
            turns = "turns(s, dt, xo, x, vo, v)"
            if "since" in needed:
                code.set("since", turns)
            else:
                code.do(turns)


def _step(code: Code, online: Online, layout: Layout) -> None:
    moved = {f"s[{online.outputs}]": online.program.force, **_moved(online, layout)}
    storing(code, online, moved, _leaf(code, online, layout, SAMPLE), together=True)
    _follow(code, online, SAMPLE, layout)
    for number, name in enumerate(("x", "v")):
        code.set(f"s[{online.before + number}]", name)
